#include "support.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace folprom::io::testing {

namespace fs = std::filesystem;

void WriteFile(const std::string& path, std::string_view bytes) {
  fs::remove(path);  // some file systems sync a file that is truncated and written anew
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string FileContent(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

FileSizeLimit::FileSizeLimit(uint64_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  old_limit_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

FileSizeLimit::~FileSizeLimit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = old_limit_;
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

Result<std::unique_ptr<MeshSource>> OpenBytes(const TemporaryFolder& folder, std::string_view bytes,
                                              const std::string& name) {
  WriteFile(folder.File(name), bytes);
  return MeshSource::Open(folder.File(name));
}

Result<Mesh> AllBlocks(const MeshSource& source) {
  Mesh mesh;
  std::vector<double> xyz;
  for (size_t block = 0; block < source.vertex_block_count(); ++block) {
    if (Result<void> read = source.ReadVertexBlock(block, &xyz); !read) return read.error();
    EXPECT_EQ(source.vertex_block_begin(block), mesh.xyz.size() / 3);
    EXPECT_LE(xyz.size(), 3u * 65536u);
    mesh.xyz.insert(mesh.xyz.end(), xyz.begin(), xyz.end());
  }
  std::vector<Triangle> triangles;
  for (size_t block = 0; block < source.triangle_block_count(); ++block) {
    if (Result<void> read = source.ReadTriangleBlock(block, &triangles); !read) return read.error();
    EXPECT_LE(triangles.size(), 65536u);
    EXPECT_FALSE(triangles.empty());
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  }
  EXPECT_EQ(source.vertex_count(), mesh.xyz.size() / 3);
  EXPECT_EQ(source.vertex_block_begin(source.vertex_block_count()), source.vertex_count());
  EXPECT_EQ(source.triangle_count(), mesh.triangles.size());
  return mesh;
}

Result<Mesh> MeshOf(std::string_view bytes, const std::string& name) {
  const TemporaryFolder folder;
  Result<std::unique_ptr<MeshSource>> source = OpenBytes(folder, bytes, name);
  if (!source) return source.error();
  return AllBlocks(**source);
}

std::string InputErrorOf(std::string_view bytes, const std::string& name) {
  const Result<Mesh> mesh = MeshOf(bytes, name);
  if (mesh.ok() || mesh.error().kind != ErrorKind::kInput) return "";
  return mesh.error().message;
}

std::string RandomDecimal(support::Random& random, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, random.Between(-1000, 1000));
  return text;
}

std::string SharedData() {
  const char* variable = std::getenv("FOLPROM_SHARED");
  const std::string shared =
      variable != nullptr ? variable : std::string(FOLPROM_SOURCE_DIR) + "/../shared";
  return fs::is_directory(shared + "/data") ? shared + "/data/" : "";
}

}  // namespace folprom::io::testing
