// The rate-distortion curve of a scan: encode once, then decode and compare at each rate.
#include <algorithm>
#include <utility>

#include "engine/measure/compare.h"
#include "engine/run_guarded.h"
#include "folprom/folprom.h"
#include "io/spill/spill.h"

namespace folprom {
namespace {

class RateJob {
 public:
  RateJob(const std::string& scan, const EncodeOptions& options, uint64_t samples,
          parallel::Runner& runner, parallel::Progress& progress)
      : scan_(scan),
        options_(options),
        samples_(samples),
        runner_(runner),
        progress_(progress),
        folder_(options.temporary_folder),
        encoded_(folder_.File("scan.folp")) {}

  RateCurve Run(std::span<const double> rates) {
    const EncodeReport report = EncodeFile(scan_, encoded_, options_, runner_, progress_).value();
    RateCurve curve{report.vertices, report.faces, report.bytes, {}, report.warnings};
    const FileInfo info = ReadInfo(encoded_, options_.limits).value();
    measure::Original original(Mesh(scan_), scan_, runner_, progress_);
    for (const double rate : rates) {
      RatePoint point = Decoded(rate);
      point.bytes = info.layers[point.layers - 1].end_byte;
      point.bits_per_vertex = info.layers[point.layers - 1].bits_per_vertex;
      // Rates between the same two layers give the same mesh.
      const auto same = std::find_if(curve.points.begin(), curve.points.end(),
                                     [&](const auto& p) { return p.layers == point.layers; });
      point.comparison = same != curve.points.end() ? same->comparison : Compared(&original);
      curve.points.push_back(point);
    }
    return curve;
  }

 private:
  RatePoint Decoded(double rate) const {
    DecodeOptions options;
    options.bits_per_vertex = rate;
    options.limits = options_.limits;
    options.temporary_folder = options_.temporary_folder;
    options.overwrite = true;
    const DecodeReport report =
        DecodeFile(encoded_, Decoding(), options, runner_, progress_).value();
    RatePoint point;
    point.requested = rate;
    point.layers = report.layers;
    point.vertices = report.vertices;
    point.faces = report.faces;
    return point;
  }

  Comparison Compared(measure::Original* original) const {
    const uint64_t samples =
        samples_ > 0 ? samples_ : measure::DefaultSamples(original->face_count());
    return original->Against(Mesh(Decoding()), scan_, samples);
  }

  measure::TriangleMesh Mesh(const std::string& path) const {
    measure::ReadOptions read;
    read.decode.limits = options_.limits;
    return measure::ReadMesh(path, read, runner_, progress_);
  }

  std::string Decoding() const { return folder_.File("decoded.ply"); }

  const std::string scan_;
  const EncodeOptions options_;
  const uint64_t samples_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  const io::SpillDirectory folder_;
  const std::string encoded_;
};

}  // namespace

Result<RateCurve> MeasureRates(const std::string& scan, const EncodeOptions& options,
                               std::span<const double> rates, uint64_t samples,
                               parallel::Runner& runner, parallel::Progress& progress) {
  return RunGuarded<RateCurve>(
      [&] { return RateJob(scan, options, samples, runner, progress).Run(rates); });
}

}  // namespace folprom
