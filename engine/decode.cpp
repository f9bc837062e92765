// Decoding, stage by stage.
#include <algorithm>
#include <iterator>

#include "engine/decode_pipeline.h"
#include "engine/folp_file.h"
#include "engine/mesh_sinks.h"
#include "engine/ordered_mesh.h"
#include "engine/run_guarded.h"
#include "folprom/folprom.h"
#include "io/formats/mesh_writer.h"

namespace folprom {
namespace {

/// Number of layers that the options ask for, of those that are there.
size_t LayersFor(const FolpFile& file, const DecodeOptions& options) {
  const io::FileTable& table = file.table();
  size_t present = file.container().complete_layers();
  if (present == 0) {
    throw Failure(ErrorKind::kCorrupt,
                  file.container().name() + ": the file is cut before the end of its first layer");
  }
  auto last_that = [&](auto fits) {
    size_t count = 1;
    while (count < present && fits(count)) ++count;
    return count;
  };
  if (options.layers > 0) return std::min<size_t>(options.layers, present);
  if (options.bits_per_vertex > 0) {
    double budget = options.bits_per_vertex * static_cast<double>(table.vertices) / 8;
    return last_that([&](size_t layer) {
      return static_cast<double>(file.container().LayerEnd(layer)) <= budget;
    });
  }
  if (options.max_vertices > 0) {
    return last_that(
        [&](size_t layer) { return table.layers[layer].vertices <= options.max_vertices; });
  }
  if (options.max_error > 0) {
    for (size_t layer = 0; layer < present; ++layer) {
      if (static_cast<double>(table.layers[layer].error_bound) <= options.max_error)
        return layer + 1;
    }
  }
  return present;
}

void CheckOptions(const DecodeOptions& options) {
  int bounds = (options.bits_per_vertex > 0) + (options.max_error > 0) +
               (options.max_vertices > 0) + (options.layers > 0);
  if (bounds > 1) {
    throw Failure(ErrorKind::kUsage,
                  "only one of rate, error, vertices and layers can bound a decoding");
  }
  for (int i = 0; options.use_region && i < 3; ++i) {
    if (!(options.region_lo[i] <= options.region_hi[i])) {
      throw Failure(ErrorKind::kUsage, "the region's lower corner lies above its upper corner");
    }
  }
}

DecodeSelection SelectionFor(const FolpFile& file, const DecodeOptions& options) {
  DecodeSelection selection;
  selection.layers = LayersFor(file, options);
  const io::FileTable& table = file.table();
  if (options.use_region) {
    double lo[3], hi[3];
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = (options.region_lo[i] - table.origin[i]) / table.unit;
      hi[i] = (options.region_hi[i] - table.origin[i]) / table.unit;
    }
    selection.wanted = SubtreesInBox(table, selection.layers, lo, hi);
  } else {
    selection.wanted = AllSubtrees(table);
  }
  return selection;
}

Extent ExtentOf(const DecodeOptions& options) {
  const bool has_bound = options.bits_per_vertex > 0 || options.max_error > 0 ||
                         options.max_vertices > 0 || options.layers > 0;
  return has_bound || options.use_region ? Extent::kPart : Extent::kAll;
}

class DecodeJob {
 public:
  DecodeJob(const std::string& input, const std::string& output, const DecodeOptions& options,
            parallel::Runner& runner, parallel::Progress& progress)
      : output_(output),
        options_(options),
        runner_(runner),
        progress_(progress),
        file_(input, ExtentOf(options)) {
    CheckOptions(options);
    file_.CheckLimits(options.limits);
    io::OutputFormat(output).value();
    selection_ = SelectionFor(file_, options);
  }

  /// Failure kInput where the file has been written meanwhile.
  void CheckUnchanged() const { file_.CheckUnchanged(); }

  DecodeReport Run() {
    const io::FileTable& table = file_.table();
    DecodeReport report;
    report.layers = selection_.layers;
    report.layers_total = file_.container().layers_total();
    report.complete = report.layers == report.layers_total && !options_.use_region;
    report.error_bound = static_cast<double>(table.layers[selection_.layers - 1].error_bound);
    size_t present = file_.container().complete_layers();
    if (present < report.layers_total) {
      report.warnings.push_back("the file is cut: " + std::to_string(present) + " of " +
                                std::to_string(report.layers_total) + " layers are whole");
    }
    if (report.complete && table.HasSections()) {
      if (HasWholeSections(file_.container())) {
        AddSectionBytes(&report);
      } else {
        report.warnings.push_back(
            "the file is cut: the scan's order, polygons and attributes of faces are not there, "
            "decoded are triangles in the order of the file");
      }
    } else if (!table.face_schema.empty()) {
      report.warnings.push_back("attributes of faces come back with the whole mesh only");
    }
    if (options_.use_region) {
      DecodeRegion(&report);
    } else if (report.complete && HasWholeSections(file_.container())) {
      DecodeOrdered(&report);
    } else if (report.complete && table.is_soup) {
      DecodeSoup(&report);
    } else {
      DecodeAll(&report);
    }
    report.bytes_read = BytesOf(file_.container(), selection_.layers, decoded_);
    return report;
  }

 private:
  /// shape: the counts; the rest is of the file.
  std::unique_ptr<io::MeshWriter> MakeWriter(io::MeshShape shape) const {
    shape.coordinate_type = static_cast<ScalarType>(file_.table().coordinate_type);
    shape.schema = file_.table().schema;
    shape.remarks = file_.table().remarks;
    return io::MeshWriter::Create(output_, shape, options_.overwrite).value();
  }
  void Commit(io::MeshWriter& writer, DecodeReport* report) const {
    CheckUnchanged();
    writer.Commit().value();
    std::ranges::copy(writer.Warnings(), std::back_inserter(report->warnings));
  }
  void Decode(MeshSink& sink) {
    decoded_ =
        DecodeInto(file_.container(), file_.parameters(), selection_, options_.limits.memory_bytes,
                   options_.temporary_folder, runner_, progress_, sink);
  }

  void DecodeAll(DecodeReport* report) {
    const io::LayerRecord& layer = file_.table().layers[selection_.layers - 1];
    auto writer = MakeWriter({layer.vertices, layer.faces});
    FileSink sink(file_.lattice(), layer, file_.container().name(), *writer);
    Decode(sink);
    report->vertices = sink.vertices();
    report->faces = sink.faces();
    sink.CheckComplete();
    Commit(*writer, report);
  }

  /// Faces in the order of the file, each with vertices of its own.
  void DecodeSoup(DecodeReport* report) {
    const io::LayerRecord& layer = file_.table().layers[selection_.layers - 1];
    auto writer = MakeWriter({file_.table().OutputVertices(), layer.faces});
    SoupSink sink(file_.lattice(), layer, file_.container().name(), *writer);
    Decode(sink);
    sink.CheckComplete();
    report->vertices = file_.table().OutputVertices();
    report->faces = layer.faces;
    Commit(*writer, report);
  }

  void AddSectionBytes(DecodeReport* report) const {
    for (const auto& section : file_.table().sections) {
      if (section) report->bytes_read += section->bytes;
    }
  }

  /// As the scan had it.
  void DecodeOrdered(DecodeReport* report) {
    const io::FileTable& table = file_.table();
    io::SpillDirectory spill(options_.temporary_folder);
    OrderedMesh mesh(file_.container(), file_.lattice(), spill, options_.limits.memory_bytes);
    Decode(mesh);
    progress_.StartStage("order", table.vertices + table.faces);
    mesh.Finish();
    io::MeshShape shape{table.OutputVertices(), table.polygons};
    shape.triangles = table.faces;
    shape.largest_face = table.largest_face;
    shape.face_schema = table.face_schema;
    auto writer = MakeWriter(shape);
    if (table.is_soup) {
      WriteSoup(mesh, *writer);
    } else {
      WriteVertices(mesh, *writer);
      WriteFaces(mesh, *writer);
    }
    report->vertices = table.OutputVertices();
    report->faces = table.polygons;
    Commit(*writer, report);
  }

  void WriteVertices(OrderedMesh& mesh, io::MeshWriter& writer) {
    constexpr size_t kBlock = 65536;
    const uint64_t vertices = file_.table().vertices;
    std::vector<double> xyz;
    std::vector<uint8_t> attributes;
    for (uint64_t begin = 0; begin < vertices; begin += kBlock) {
      progress_.ThrowIfCancelled();
      const auto count = static_cast<size_t>(std::min<uint64_t>(kBlock, vertices - begin));
      mesh.ReadVertices(begin, count, &xyz, &attributes);
      writer.AppendVertices(xyz, attributes).value();
      progress_.Advance(count);
    }
  }

  void WriteSoup(OrderedMesh& mesh, io::MeshWriter& writer) {
    FaceChunk chunk;
    std::vector<double> xyz;
    uint64_t faces = 0;
    while (mesh.ReadFaces(&chunk)) {
      progress_.ThrowIfCancelled();
      mesh.ReadCorners(chunk.triangles, &xyz);
      writer.AppendVertices(xyz).value();
      writer.AppendFaces(SoupFaces(faces, chunk.triangles.size())).value();
      faces += chunk.triangles.size();
      progress_.Advance(chunk.triangles.size());
    }
  }

  void WriteFaces(OrderedMesh& mesh, io::MeshWriter& writer) {
    FaceChunk chunk;
    std::vector<io::Triangle> triangles;
    while (mesh.ReadFaces(&chunk)) {
      progress_.ThrowIfCancelled();
      triangles.clear();
      for (const Face& f : chunk.triangles) triangles.push_back({f[0], f[1], f[2]});
      if (chunk.joins.empty()) {
        writer.AppendFaces(triangles, chunk.rows).value();
      } else {
        writer.AppendPolygons(triangles, chunk.joins, chunk.rows).value();
      }
      progress_.Advance(triangles.size());
    }
  }

  void DecodeRegion(DecodeReport* report) {
    io::SpillDirectory spill(options_.temporary_folder);
    std::array<double, 3> lo, hi;
    std::copy_n(options_.region_lo, 3, lo.begin());
    std::copy_n(options_.region_hi, 3, hi.begin());
    RegionSink sink(file_.lattice(), lo, hi, file_.table().schema.Stride(), spill);
    Decode(sink);
    report->vertices = sink.vertices();
    report->faces = sink.faces();
    if (sink.vertices() == 0) {
      report->warnings.push_back("no vertex lies in the region; folprom info tells the mesh's box");
    }
    auto writer = MakeWriter({sink.vertices(), sink.faces()});
    sink.WriteTo(*writer);
    Commit(*writer, report);
  }

  std::string output_;
  DecodeOptions options_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  FolpFile file_;
  DecodeSelection selection_;
  DecodedSegments decoded_;
};

}  // namespace

Result<DecodeReport> DecodeFile(const std::string& input, const std::string& output,
                                const DecodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress) {
  return RunGuarded<DecodeReport>([&] {
    DecodeJob job(input, output, options, runner, progress);
    try {
      return job.Run();
    } catch (const Failure&) {
      job.CheckUnchanged();
      throw;
    }
  });
}

}  // namespace folprom
