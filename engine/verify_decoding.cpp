#include "engine/verify_decoding.h"

namespace folprom {
namespace {

/// Gives each part to both.
class TwoSinks final : public MeshSink {
 public:
  TwoSinks(MeshSink& first, MeshSink* second) : first_(first), second_(second) {}
  void AddSubtree(const SubtreePart& part) override {
    first_.AddSubtree(part);
    if (second_ != nullptr) second_->AddSubtree(part);
  }
  void AddSeam(std::span<const SeamFace> faces) override {
    first_.AddSeam(faces);
    if (second_ != nullptr) second_->AddSeam(faces);
  }

 private:
  MeshSink& first_;
  MeshSink* second_;
};

}  // namespace

void DecodeWhole(const FolpFile& file, const DecodeOptions& options, parallel::Runner& runner,
                 parallel::Progress& progress, MeshSink& first, MeshSink* second) {
  TwoSinks both(first, second);
  const DecodeSelection everything{file.table().layers.size(), AllSubtrees(file.table())};
  DecodeInto(file.container(), file.parameters(), everything, options.limits.memory_bytes,
             options.temporary_folder, runner, progress, both);
}

bool IsDigestOf(const FolpFile& file, const io::MeshDigest& decoded, VerifyReport* report) {
  if (decoded == file.table().digest) return true;
  report->reason = "the decoded mesh differs from the digest in the file";
  return false;
}

}  // namespace folprom
