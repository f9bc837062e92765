#include "tests/support/files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fs = std::filesystem;

namespace folprom::support {
namespace {

std::string SharedFolder() {
  const char* variable = std::getenv("FOLPROM_SHARED");
  return (variable != nullptr ? variable : std::string(FOLPROM_SOURCE_DIR) + "/../shared") +
         "/data/";
}

}  // namespace

std::vector<uint8_t> FileBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void WriteBytes(const std::string& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string SharedFile(const std::string& name) {
  std::string path = SharedFolder() + name;
  return fs::is_regular_file(path) ? path : "";
}

std::vector<std::string> SharedScans() {
  std::vector<std::string> names;
  for (const std::string folder : {"scans", "hard"}) {
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(SharedFolder() + folder, missing)) {
      if (entry.path().extension() == ".ply") {
        names.push_back(folder + "/" + entry.path().filename().string());
      }
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace folprom::support
