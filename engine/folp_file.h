// A .folp file on disk, mapped and opened.
#pragma once

#include <string>

#include "engine/codec/layer_reader.h"
#include "engine/mesh/lattice.h"
#include "io/container/reader.h"
#include "io/files/mapped_file.h"
#include "io/files/sparse_access.h"
#include "io/limit_check.h"

namespace folprom {

/// Which part of the file will be read.
enum class Extent { kAll, kPart };

/// Throws Failure; messages of a damaged table name the file.
class FolpFile {
 public:
  explicit FolpFile(const std::string& path, Extent extent = Extent::kAll)
      : file_(Map(path, extent)),
        container_(io::ContainerReader::Open(file_.bytes(), path).value()),
        parameters_(Parameters(path)) {}

  const io::ContainerReader& container() const { return container_; }
  const io::FileTable& table() const { return container_.table(); }
  const CodecParameters& parameters() const { return parameters_; }
  uint64_t bytes_present() const { return file_.bytes().size(); }
  /// Failure kInput where it has been written since it was opened.
  void CheckUnchanged() const { file_.CheckUnchanged(); }
  /// Failure kLimit where the whole mesh has more than that.
  void CheckLimits(const Limits& limits) const {
    io::CheckLimit(container_.name(), table().OutputVertices(), limits.vertices, "vertices");
    io::CheckLimit(container_.name(), table().faces, limits.faces, "faces");
  }
  Lattice lattice() const { return LatticeOf(table(), parameters_); }

 private:
  static io::MappedFile Map(const std::string& path, Extent extent) {
    io::MappedFile file = io::MappedFile::Open(path).value();
    if (extent == Extent::kPart) io::ExpectSparseAccess(file);
    return file;
  }
  CodecParameters Parameters(const std::string& path) const {
    try {
      return ParametersOf(table(), container_.layers_total());
    } catch (const Failure& failure) {
      throw Failure(failure.error().kind, path + ": " + failure.error().message);
    }
  }
  io::MappedFile file_;
  io::ContainerReader container_;
  CodecParameters parameters_;
};

}  // namespace folprom
