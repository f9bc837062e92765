#include "tests/support/codec.h"

#include <filesystem>
#include <memory>

#include "parallel/progress.h"
#include "tests/support/files.h"

namespace folprom::support {
namespace {

// The files of tests have many small subtrees.
constexpr uint64_t kModelBytes = uint64_t{8} << 30;

std::string FolderOf(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

/// The given runner or a serial one of its own.
class SomeRunner {
 public:
  explicit SomeRunner(parallel::Runner* given) : runner_(given) {
    if (given != nullptr) return;
    own_ = parallel::MakeSerialRunner();
    runner_ = own_.get();
  }
  parallel::Runner& operator*() { return *runner_; }

 private:
  std::unique_ptr<parallel::Runner> own_;
  parallel::Runner* runner_;
};

}  // namespace

EncodeReport Encode(const std::string& scan, const std::string& folp, EncodeOptions options,
                    parallel::Runner* runner) {
  options.temporary_folder = FolderOf(folp);
  parallel::Progress progress;
  return EncodeFile(scan, folp, options, *SomeRunner(runner), progress).value();
}

DecodeReport Decode(const std::string& folp, const std::string& ply, DecodeOptions options,
                    parallel::Runner* runner) {
  options.temporary_folder = FolderOf(ply);
  parallel::Progress progress;
  return DecodeFile(folp, ply, options, *SomeRunner(runner), progress).value();
}

VerifyReport Verify(const std::string& folp, const std::string& original,
                    parallel::Runner* runner) {
  DecodeOptions options;
  options.temporary_folder = FolderOf(folp);
  parallel::Progress progress;
  return VerifyFile(folp, original, options, *SomeRunner(runner), progress).value();
}

std::vector<Mesh> EveryLod(const std::string& folp) {
  std::vector<uint8_t> bytes = FileBytes(folp);
  MemoryDecoder decoder = MemoryDecoder::Open(bytes, kModelBytes).value();
  std::vector<Mesh> lods;
  while (lods.size() < decoder.layer_count()) {
    decoder.DecodeNextLayer().value();
    lods.push_back(decoder.Mesh());
  }
  return lods;
}

Mesh LodOf(const std::string& folp, size_t layers) {
  std::vector<uint8_t> bytes = FileBytes(folp);
  MemoryDecoder decoder = MemoryDecoder::Open(bytes, kModelBytes).value();
  if (layers == 0) layers = decoder.layer_count();
  for (size_t i = 0; i < layers; ++i) decoder.DecodeNextLayer().value();
  return decoder.Mesh();
}

}  // namespace folprom::support
