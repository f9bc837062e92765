// Is what comes back what went in: by the digest in the file, or vertex by vertex with the scan.
#include <algorithm>
#include <atomic>
#include <optional>

#include "engine/decode_pipeline.h"
#include "engine/encode_job.h"
#include "engine/folp_file.h"
#include "engine/mesh_sinks.h"
#include "engine/run_guarded.h"
#include "engine/verify_sections.h"
#include "engine/weld/soup.h"
#include "folprom/folprom.h"
#include "io/container/checksum.h"

namespace folprom {
namespace {

DecodeSelection Everything(const FolpFile& file) {
  return {file.table().layers.size(), AllSubtrees(file.table())};
}

/// Hash of a face by the indices of its vertices, the same for every rotation.
uint64_t HashFace(std::array<uint64_t, 3> face) {
  std::array<uint64_t, 3> best = face;
  for (int i = 0; i < 2; ++i) {
    face = {face[1], face[2], face[0]};
    best = std::min(best, face);
  }
  return io::XxHash64({reinterpret_cast<const uint8_t*>(best.data()), sizeof best});
}

/// Spills decoded positions, model units, and attributes, and sums the faces by their decoded
/// vertex indices.
class MatchSink final : public MeshSink {
 public:
  MatchSink(const Lattice& lattice, const io::SpillDirectory& spill)
      : digest(lattice), lattice_(lattice), streams_(spill, "decoded", 2, uint64_t{1} << 20) {}
  void AddSubtree(const SubtreePart& part) override {
    digest.AddSubtree(part);
    std::vector<ExactPosition> xyz(part.positions.size());
    for (size_t v = 0; v < xyz.size(); ++v) xyz[v] = part.Position(lattice_, v);
    streams_.Append(0, xyz.data(), xyz.size() * sizeof(ExactPosition));
    streams_.Append(1, part.attributes.data(), part.attributes.size());
    base.push_back(vertices_);
    border_.emplace_back(part.border_vertices.begin(), part.border_vertices.end());
    for (const Face& f : part.faces) {
      face_sum += HashFace({vertices_ + f[0], vertices_ + f[1], vertices_ + f[2]});
    }
    vertices_ += part.positions.size();
  }
  void AddSeam(std::span<const SeamFace> faces) override {
    digest.AddSeam(faces);
    auto index = [&](const BorderRef& r) { return base[r.subtree] + border_[r.subtree][r.border]; };
    for (const SeamFace& f : faces) face_sum += HashFace({index(f[0]), index(f[1]), index(f[2])});
  }

  /// No part after it.
  void Finish() { streams_.Finish(); }
  /// All of them, in the order of the decoded mesh.
  io::MappedFile MapPositions() { return streams_.Map(0); }
  io::MappedFile MapAttributes() { return streams_.Map(1); }

  DigestSink digest;
  std::vector<uint64_t> base;  ///< per subtree: its first vertex
  uint64_t face_sum = 0;

 private:
  Lattice lattice_;
  io::SpillStreams streams_;  ///< 0: positions, 1: attributes
  uint64_t vertices_ = 0;
  std::vector<std::vector<uint32_t>> border_;
};

/// Compares a decoded file with a scan. The encoder's order of the scan proposes which decoded
/// vertex each original became; that it is one to one, near enough and carries the faces over is
/// then checked without trust in the encoder.
class Comparison {
 public:
  Comparison(const FolpFile& file, const std::string& original, const DecodeOptions& options,
             parallel::Runner& runner, parallel::Progress& progress)
      : file_(file),
        runner_(runner),
        progress_(progress),
        job_(original, OptionsFor(file, options), runner, progress) {}

  /// Failure kInput where the scan has been written meanwhile.
  void CheckUnchanged() const { job_.source().CheckUnchanged().value(); }

  void Run(uint64_t memory_bytes, const std::string& temporary_folder, VerifyReport* report) {
    const io::FileTable& table = file_.table();
    if (table.is_soup && !IsSoup(job_.source())) {
      report->reason = "the file is of a soup, the scan is none";
      return;
    }
    const bool in_order = table.Section(io::SectionKind::kOrder).has_value();
    if (NeedsWeld(in_order)) {
      job_.WeldScan(std::make_unique<io::SpillDirectory>(temporary_folder));
    }
    report->welded = job_.welded() != nullptr && !table.is_soup;
    // In order the corners of a soup are compared as they stand.
    const uint64_t vertices = in_order ? table.OutputVertices() : table.vertices;
    if (job_.source().vertex_count() != vertices || job_.source().triangle_count() != table.faces) {
      report->reason = "the scan has " + std::to_string(job_.source().vertex_count()) +
                       " vertices and " + std::to_string(job_.source().triangle_count()) +
                       " faces, the file " + std::to_string(vertices) + " and " +
                       std::to_string(table.faces);
      return;
    }
    if (!AreExtrasAlike(report)) return;
    if (in_order) {
      RunInOrder(memory_bytes, temporary_folder, report);
      return;
    }
    job_.UseResolution({file_.lattice(), table.tolerance});
    job_.Partition();
    job_.EncodeSubtrees(true, "match");
    MatchSink sink(file_.lattice(), job_.spill());
    std::optional<OrderedMesh> ordered;
    if (table.HasSections()) {
      ordered.emplace(file_.container(), file_.lattice(), job_.spill(), memory_bytes);
    }
    TwoSinks both(sink, ordered ? &*ordered : nullptr);
    DecodeInto(file_.container(), file_.parameters(), Everything(file_), memory_bytes,
               temporary_folder, runner_, progress_, both);
    if (sink.digest.digest() != table.digest) {
      report->reason = "the decoded mesh differs from the digest in the file";
      return;
    }
    if (!AreSubtreesAlike(sink, report)) return;
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

  /// Is the file of fewer vertices than the scan because those of equal coordinates are one in it.
  bool NeedsWeld(bool in_order) const {
    const io::FileTable& table = file_.table();
    if (table.is_soup) return !in_order;
    return job_.source().vertex_count() > table.vertices &&
           job_.source().triangle_count() == table.faces && table.schema.attributes.empty();
  }

  /// Element by element: the order itself tells which vertex is which.
  void RunInOrder(uint64_t memory_bytes, const std::string& temporary_folder,
                  VerifyReport* report) {
    DigestSink digest(file_.lattice());
    OrderedMesh ordered(file_.container(), file_.lattice(), job_.spill(), memory_bytes);
    TwoSinks both(digest, &ordered);
    DecodeInto(file_.container(), file_.parameters(), Everything(file_), memory_bytes,
               temporary_folder, runner_, progress_, both);
    if (digest.digest() != file_.table().digest) {
      report->reason = "the decoded mesh differs from the digest in the file";
      return;
    }
    CompareInOrder(file_, ordered, job_.source(), progress_, report);
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
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  EncodeJob job_;
  // One file each for all subtrees: a process may map 65,530.
  io::MappedFile order_, decoded_, attributes_;
  std::vector<uint64_t> first_vertex_;  ///< of each subtree
};

void CompareDigest(const FolpFile& file, const DecodeOptions& options, parallel::Runner& runner,
                   parallel::Progress& progress, VerifyReport* report) {
  const io::FileTable& table = file.table();
  DigestSink sink(file.lattice());
  std::optional<io::SpillDirectory> spill;
  std::optional<OrderedMesh> ordered;
  if (table.HasSections()) {
    spill.emplace(options.temporary_folder);
    ordered.emplace(file.container(), file.lattice(), *spill, options.limits.memory_bytes);
  }
  TwoSinks both(sink, ordered ? &*ordered : nullptr);
  DecodeInto(file.container(), file.parameters(), Everything(file), options.limits.memory_bytes,
             options.temporary_folder, runner, progress, both);
  if (sink.vertices() != table.vertices || sink.faces() != table.faces) {
    report->reason = "decoded counts differ from those of the table";
  } else if (sink.digest() != table.digest) {
    report->reason = "the decoded mesh differs from the digest in the file";
  } else if (ordered) {
    CheckSections(*ordered);
  }
}

}  // namespace

Result<VerifyReport> VerifyFile(const std::string& input, const std::string& original,
                                const DecodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress) {
  return RunGuarded<VerifyReport>([&] {
    const FolpFile file(input);
    file.CheckLimits(options.limits);
    VerifyReport report;
    report.vertices = file.table().vertices;
    report.faces = file.table().faces;
    report.tolerance = file.table().tolerance;
    report.against = !original.empty();
    report.order_kept = file.table().Section(io::SectionKind::kOrder).has_value();
    size_t present = file.container().complete_layers(), all = file.container().layers_total();
    if (present < all) {
      report.reason = "the file is cut: " + std::to_string(present) + " of " + std::to_string(all) +
                      " layers are whole";
    } else if (file.table().HasSections() && !HasWholeSections(file.container())) {
      report.reason =
          "the file is cut: the scan's order, polygons and attributes of faces are not there";
    } else if (original.empty()) {
      CompareDigest(file, options, runner, progress, &report);
    } else {
      Comparison comparison(file, original, options, runner, progress);
      comparison.Run(options.limits.memory_bytes, options.temporary_folder, &report);
      comparison.CheckUnchanged();
    }
    file.CheckUnchanged();
    report.lossless = report.reason.empty();
    return report;
  });
}

}  // namespace folprom
