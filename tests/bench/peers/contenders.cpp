#include "tests/bench/peers/contenders.h"

#include <spdlog/fmt/fmt.h>

#include <limits>

#include "folprom/result.h"

namespace folprom::peers {
namespace {

class Builder {
 public:
  Builder(const std::string& scan, const ScanSize& size, const std::string& folder)
      : scan_(scan), size_(size), folder_(folder) {}

  void AddFolprom(const ContenderOptions& options, const FolpromSetting& setting, int bits,
                  bool one_thread) {
    Contender& c = Add("folprom", bits, "folp");
    if (!setting.name.empty()) c.name += " " + setting.name;
    c.encode = {options.folprom,      "encode", scan_, "-o", c.file, "--bits",
                std::to_string(bits), "-f",     "-q"};
    c.decode = {options.folprom, "decode", c.file, "-o", c.mesh, "-f", "-q"};
    if (!setting.config.empty()) {
      c.encode.insert(c.encode.end(), {"--config", setting.config});
    }
    if (one_thread) {
      c.name += ", 1 thread";
      c.encode.insert(c.encode.end(), {"-T", "1"});
      c.decode.insert(c.decode.end(), {"-T", "1"});
    }
  }

  void AddDraco(int level, int bits) {
    Contender& c = Add(fmt::format("Draco -cl {}", level), bits, "drc");
    c.encode = {"draco_encoder",      "-i", scan_, "-o", c.file, "-qp", std::to_string(bits), "-cl",
                std::to_string(level)};
    c.decode = {"draco_decoder", "-i", c.file, "-o", c.mesh};
  }

  // Decodes to a raw CTM: as PLY its program writes text only, which would be measured too.
  void AddOpenCtm(int bits) {
    Contender& c = Add(bits > 0 ? "OpenCTM MG2" : "OpenCTM MG1", bits, "ctm");
    const std::string raw = c.mesh + ".ctm";
    c.encode = {"ctmconv", scan_, c.file, "--method", bits > 0 ? "MG2" : "MG1", "--level", "9"};
    if (bits > 0) {
      c.encode.insert(c.encode.end(), {"--vprec", fmt::format("{:.9e}", Step(bits))});
    }
    c.decode = {"ctmconv", c.file, raw, "--method", "RAW"};
    c.convert = {"ctmconv", raw, c.mesh};
  }

  void AddMeshoptimizer(int bits) {
    Contender& c = Add("meshoptimizer + zstd", bits, "mesh.zst");
    c.encode = {PEER_MESHOPT_ZSTD, "encode", scan_, c.file, std::to_string(bits)};
    c.decode = {PEER_MESHOPT_ZSTD, "decode", c.file, c.mesh};
  }

  void AddXz() {
    Contender& c = Add("xz", 0, "ply.xz");
    c.encode = {"xz", "--keep", "--stdout", scan_};
    c.decode = {"xz", "--decompress", "--stdout", c.file};
    c.encode_output = c.file;
    c.decode_output = c.mesh;
  }

  std::vector<Contender> Take() { return std::move(contenders_); }

 private:
  double Step(int bits) const { return size_.longest_side / ((1 << bits) - 1); }

  Contender& Add(const std::string& name, int bits, const char* suffix) {
    // Positions go through floats, some programs compute in them too.
    const double rounding = 4 * std::numeric_limits<float>::epsilon() * size_.largest_coordinate;
    Contender c;
    c.name = name;
    c.bits = bits;
    c.tolerance = (bits > 0 ? Step(bits) / 2 : 0) + rounding;
    c.file = fmt::format("{}/{}.{}", folder_, contenders_.size(), suffix);
    c.mesh = fmt::format("{}/{}.ply", folder_, contenders_.size());
    contenders_.push_back(std::move(c));
    return contenders_.back();
  }

  const std::string& scan_;
  const ScanSize& size_;
  const std::string& folder_;
  std::vector<Contender> contenders_;
};

}  // namespace

std::vector<Contender> MakeContenders(const std::string& scan, const ScanSize& size,
                                      const std::string& folder, const ContenderOptions& options) {
  Builder builder(scan, size, folder);
  for (const int bits : options.bits) {
    for (const FolpromSetting& setting : options.settings) {
      builder.AddFolprom(options, setting, bits, false);
    }
    builder.AddFolprom(options, options.settings.front(), bits, true);
    for (const int level : {10, 7}) builder.AddDraco(level, bits);
    builder.AddMeshoptimizer(bits);
    builder.AddOpenCtm(bits);
  }
  builder.AddOpenCtm(0);
  builder.AddXz();
  return builder.Take();
}

void CheckPrograms() {
  std::string missing;
  for (const char* program : {"draco_encoder", "draco_decoder", "ctmconv", "xz"}) {
    if (!OnPath(program)) missing += std::string(" ") + program;
  }
  if (!missing.empty()) {
    throw Failure(ErrorKind::kUsage,
                  "not installed:" + missing + "; see apps/install_dependencies.sh bench");
  }
}

}  // namespace folprom::peers
