#include "engine/verify_scan.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/encode_job.h"
#include "engine/match_sink.h"
#include "engine/mesh_sinks.h"
#include "engine/verify_decoding.h"
#include "engine/verify_sections.h"
#include "engine/verify_values.h"
#include "engine/weld/soup.h"

namespace folprom {
namespace {

/// Compares a decoded file with a scan. The encoder's order of the scan proposes which decoded
/// vertex each original became; that it is one to one, near enough and carries the faces over is
/// then checked without trust in the encoder.
class Comparison {
 public:
  Comparison(const FolpFile& file, const std::string& original, const DecodeOptions& options,
             parallel::Runner& runner, parallel::Progress& progress)
      : file_(file),
        options_(options),
        runner_(runner),
        progress_(progress),
        job_(original, OptionsFor(file, options), runner, progress) {}

  /// Failure kInput where the scan has been written meanwhile.
  void CheckUnchanged() const { job_.source().CheckUnchanged().value(); }

  void Run(VerifyReport* report) {
    if (file_.table().is_soup && !IsSoup(job_.source())) {
      report->reason = "the file is of a soup, the scan is none";
      return;
    }
    if (NeedsWeld()) {
      job_.WeldScan(std::make_unique<io::SpillDirectory>(options_.temporary_folder));
    }
    report->welded = job_.welded() != nullptr && !file_.table().is_soup;
    if (!AreCountsAlike(report) || !AreExtrasAlike(report)) return;
    if (IsInOrder()) {
      RunInOrder(report);
    } else {
      RunByMatch(report);
    }
  }

 private:
  static EncodeOptions OptionsFor(const FolpFile& file, const DecodeOptions& options) {
    EncodeOptions encode;
    encode.codec = file.parameters().settings;
    encode.exact = file.lattice().exact.has_value();
    // They decide no order, but what of sections is to be compared goes by the places along the
    // curve.
    encode.attributes = !file.table().face_schema.empty();
    encode.limits = options.limits;
    encode.temporary_folder = options.temporary_folder;
    return encode;
  }

  bool IsInOrder() const { return file_.table().Section(io::SectionKind::kOrder).has_value(); }

  /// Is the file of fewer vertices than the scan because those of equal coordinates are one in it.
  bool NeedsWeld() const {
    const io::FileTable& table = file_.table();
    if (table.is_soup) return !IsInOrder();
    return job_.source().vertex_count() > table.vertices &&
           job_.source().triangle_count() == table.faces && table.schema.attributes.empty();
  }

  bool AreCountsAlike(VerifyReport* report) const {
    const io::FileTable& table = file_.table();
    const io::MeshSource& source = job_.source();
    // In order the corners of a soup are compared as they stand.
    const uint64_t vertices = IsInOrder() ? table.OutputVertices() : table.vertices;
    if (source.vertex_count() == vertices && source.triangle_count() == table.faces) return true;
    report->reason = "the scan has " + std::to_string(source.vertex_count()) + " vertices and " +
                     std::to_string(source.triangle_count()) + " faces, the file " +
                     std::to_string(vertices) + " and " + std::to_string(table.faces);
    return false;
  }

  /// What the file keeps beside positions and faces, by name and type.
  bool AreExtrasAlike(VerifyReport* report) const {
    const io::FileTable& table = file_.table();
    const io::MeshSource& source = job_.source();
    if (!table.schema.attributes.empty() && table.schema != source.vertex_schema()) {
      report->reason = "the vertices of scan and file have other attributes";
    } else if (!table.face_schema.empty() && table.face_schema != source.face_schema()) {
      report->reason = "the faces of scan and file have other attributes";
    } else if (!table.remarks.empty() && table.remarks != source.remarks()) {
      report->reason = "the comments of scan and file differ";
    }
    return report->reason.empty();
  }

  /// Element by element: the order itself tells which vertex is which.
  void RunInOrder(VerifyReport* report) {
    DigestSink digest(file_.lattice());
    OrderedMesh ordered(file_.container(), file_.lattice(), job_.spill(),
                        options_.limits.memory_bytes);
    DecodeWhole(file_, options_, runner_, progress_, digest, &ordered);
    if (!IsDigestOf(file_, digest.digest(), report)) return;
    CompareInOrder(file_, ordered, job_.source(), progress_, report);
  }

  void RunByMatch(VerifyReport* report) {
    job_.UseResolution({file_.lattice(), file_.table().tolerance});
    job_.Partition();
    job_.EncodeSubtrees(true, "match");
    MatchSink sink(file_.lattice(), job_.spill());
    std::optional<OrderedMesh> ordered;
    if (file_.table().HasSections()) {
      ordered.emplace(file_.container(), file_.lattice(), job_.spill(),
                      options_.limits.memory_bytes);
    }
    DecodeWhole(file_, options_, runner_, progress_, sink, ordered ? &*ordered : nullptr);
    if (!IsDigestOf(file_, sink.digest.digest(), report) || !AreSubtreesAlike(sink, report)) return;
    first_vertex_ = sink.base;
    order_ = job_.MapOrder();
    sink.Finish();
    decoded_ = sink.MapPositions();
    attributes_ = sink.MapAttributes();
    if (!IsOneToOne(report)) return;
    ComparePositions(report);
    if (report->reason.empty()) CompareAttributes(report);
    if (report->reason.empty()) CompareFaces(sink.face_sum, report);
    if (report->reason.empty() && ordered) CompareSections(*ordered, report);
  }

  /// Both with the subtrees of the table, so that one index finds a vertex in scan and mesh.
  bool AreSubtreesAlike(const MatchSink& sink, VerifyReport* report) const {
    const io::FileTable& table = file_.table();
    size_t count = table.vertices == 0 ? 0 : job_.scan().subtree_count();
    bool alike = count == table.subtrees.size();
    uint64_t vertices = 0;
    for (size_t s = 0; alike && s < count; ++s) {
      alike =
          job_.scan().summary(s).vertices == table.subtrees[s].vertices && sink.base[s] == vertices;
      vertices += table.subtrees[s].vertices;
    }
    if (!alike || sink.digest.vertices() != table.vertices) {
      report->reason = "the scan falls into other subtrees than the file: it is not the same scan";
      return false;
    }
    return true;
  }

  bool IsOneToOne(VerifyReport* report) const {
    for (size_t s = 0; s < first_vertex_.size(); ++s) {
      const uint32_t count = file_.table().subtrees[s].vertices;
      std::vector<bool> taken(count, false);
      for (uint32_t vertex : io::MappedArray<uint32_t>(order_).subspan(first_vertex_[s], count)) {
        if (vertex >= count || taken[vertex]) {
          report->reason = "the vertices of scan and file do not match one to one";
          return false;
        }
        taken[vertex] = true;
      }
    }
    return true;
  }

  void DropResident() const {
    order_.DropResident();
    decoded_.DropResident();
    attributes_.DropResident();
    job_.source().DropResident();
  }

  /// Number, in the decoded mesh, of the vertex that one of job_.source() became.
  uint64_t FinalVertex(const VertexRef& ref) const {
    const uint64_t first = first_vertex_[ref.subtree];
    return first + io::MappedArray<uint32_t>(order_)[first + ref.local];
  }

  /// Of the scan as it is in its file: that it was welded rightly is not taken on trust.
  void ComparePositions(VerifyReport* report) {
    const io::MeshSource& source = job_.original();
    size_t blocks = source.vertex_block_count();
    std::vector<CoordinateCheck> checks(blocks, CoordinateCheck(file_));
    progress_.StartStage("compare vertices", blocks);
    runner_.ForEach(blocks, [&](size_t b) {
      std::vector<double> xyz;
      source.ReadVertexBlock(b, &xyz).value();
      uint64_t first = source.vertex_block_begin(b);
      for (size_t i = 0; i < xyz.size() / 3; ++i) {
        const uint64_t vertex = job_.welded() ? job_.welded()->NumberOf(first + i) : first + i;
        const VertexRef& ref = job_.scan().vertex_map()[vertex];
        const ExactPosition& p = io::MappedArray<ExactPosition>(decoded_)[FinalVertex(ref)];
        for (size_t axis = 0; axis < 3; ++axis) {
          checks[b].Add(p[axis], xyz[3 * i + axis]);
        }
      }
      if (b % 64 == 63) DropResident();
      progress_.Advance(1);
    });
    bool same_bits = true;
    for (const CoordinateCheck& check : checks) {
      report->max_position_error = std::max(report->max_position_error, check.largest_error);
      same_bits &= check.same_bits;
    }
    CoordinateCheck::Judge(file_, same_bits, report);
  }

  void CompareSections(OrderedMesh& decoded, VerifyReport* report) {
    CheckSections(decoded);
    const io::FileTable& table = file_.table();
    const auto& polygons = table.Section(io::SectionKind::kPolygons);
    const auto& values = table.Section(io::SectionKind::kFaceValues);
    if (polygons && job_.source().notes().polygons_triangulated == 0) {
      report->reason = "the file has polygons, the scan has none";
      return;
    }
    const io::MappedFile curve = job_.MapCurve();
    const auto number_of = [&](uint64_t vertex) {
      const VertexRef& ref = job_.scan().vertex_map()[vertex];
      const uint64_t first = first_vertex_[ref.subtree];
      return static_cast<uint32_t>(first + io::MappedArray<uint32_t>(curve)[first + ref.local]);
    };
    if (polygons && DigestOfPolygons(job_.source(), number_of) != polygons->digest) {
      report->reason = "the polygons of scan and file differ";
    } else if (values && DigestOfFaceValues(job_.source(), number_of) != values->digest) {
      report->reason = "an attribute of a face differs from that of the scan in its bits";
    }
    report->face_attributes = table.face_schema.attributes.size();
  }

  void CompareAttributes(VerifyReport* report) {
    const io::VertexSchema& schema = file_.table().schema;
    CountAttributes(file_.table(), report);
    if (schema.attributes.empty()) return;
    const io::MeshSource& source = job_.source();
    const size_t blocks = source.vertex_block_count(), stride = schema.Stride();
    std::atomic<bool> same = true;
    progress_.StartStage("compare attributes", blocks);
    runner_.ForEach(blocks, [&](size_t b) {
      std::vector<uint8_t> values;
      source.ReadVertexAttributes(b, &values).value();
      const uint64_t first = source.vertex_block_begin(b);
      for (size_t i = 0; i < values.size() / stride; ++i) {
        const uint64_t vertex = FinalVertex(job_.scan().vertex_map()[first + i]);
        const auto decoded = attributes_.bytes().subspan(vertex * stride, stride);
        const auto wanted = std::span<const uint8_t>(values).subspan(i * stride, stride);
        if (!AreValuesAlike(file_.table(), decoded, wanted)) same = false;
      }
      if (b % 64 == 63) DropResident();
      progress_.Advance(1);
    });
    if (!same) report->reason = AttributesDiffer(file_.table());
  }

  void CompareFaces(uint64_t face_sum, VerifyReport* report) {
    const io::MeshSource& source = job_.source();
    std::atomic<uint64_t> sum{0};
    size_t blocks = source.triangle_block_count();
    progress_.StartStage("compare faces", blocks);
    runner_.ForEach(blocks, [&](size_t b) {
      std::vector<io::Triangle> triangles;
      source.ReadTriangleBlock(b, &triangles).value();
      uint64_t part = 0;
      for (const io::Triangle& t : triangles) {
        std::array<uint64_t, 3> face;
        for (size_t i = 0; i < 3; ++i) {
          face[i] = FinalVertex(job_.scan().vertex_map()[t[i]]);
        }
        part += HashFace(face);
      }
      sum += part;
      if (b % 64 == 63) DropResident();
      progress_.Advance(1);
    });
    if (sum != face_sum) report->reason = "the faces of scan and file differ";
  }

  const FolpFile& file_;
  const DecodeOptions& options_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  EncodeJob job_;
  // One file each for all subtrees: a process may map 65,530.
  io::MappedFile order_, decoded_, attributes_;
  std::vector<uint64_t> first_vertex_;  ///< of each subtree
};

}  // namespace

void CompareWithScan(const FolpFile& file, const std::string& original,
                     const DecodeOptions& options, parallel::Runner& runner,
                     parallel::Progress& progress, VerifyReport* report) {
  Comparison comparison(file, original, options, runner, progress);
  comparison.Run(report);
  comparison.CheckUnchanged();
}

}  // namespace folprom
