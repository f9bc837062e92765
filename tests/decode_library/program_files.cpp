#include "tests/decode_library/program_files.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace folprom::decode_library {
namespace {

std::vector<uint8_t> Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::vector<uint8_t>(std::istreambuf_iterator<char>(file), {});
}

template <class T>
T Take(const uint8_t** cursor) {
  T value;
  std::memcpy(&value, *cursor, sizeof value);
  *cursor += sizeof value;
  return value;
}

/// The number after `key` in a PLY header.
size_t CountOf(const std::string& header, const std::string& key) {
  return std::stoull(header.substr(header.find(key) + key.size()));
}

}  // namespace

std::string OutputOf(const std::vector<std::string>& command) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  close(ends[1]);
  std::string output;
  std::array<char, 65536> buffer;
  for (ssize_t got; (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    output.append(buffer.data(), static_cast<size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(command[0] + " fails");
  return output;
}

ProgramFiles::ProgramFiles() {
  OutputOf({FOLPROM_PROGRAM, "synth", "--vertices", "20000", "-o", File("scan.ply"), "-q"});
  OutputOf({FOLPROM_PROGRAM, "encode", File("scan.ply"), "-o", File("scan.folp"),
            "--subtree-vertices", "3000", "-q"});
}

std::vector<uint8_t> ProgramFiles::FolpBytes() const { return Content(File("scan.folp")); }

DecodedMesh ProgramFiles::DecodedByProgram(size_t layers) const {
  OutputOf({FOLPROM_PROGRAM, "decode", File("scan.folp"), "-o", File("lod.ply"), "-f", "--layers",
            std::to_string(layers), "-q"});
  const std::vector<uint8_t> bytes = Content(File("lod.ply"));
  const std::string end = "end_header\n";
  const std::string text(bytes.begin(), bytes.end());
  const std::string header = text.substr(0, text.find(end) + end.size());
  const bool is_double = header.find("property double x") != std::string::npos;
  DecodedMesh mesh;
  mesh.positions.resize(CountOf(header, "element vertex "));
  mesh.faces.resize(CountOf(header, "element face "));
  const uint8_t* cursor = bytes.data() + header.size();
  for (auto& position : mesh.positions) {
    for (double& value : position) {
      value = is_double ? Take<double>(&cursor) : static_cast<double>(Take<float>(&cursor));
    }
  }
  for (auto& face : mesh.faces) {
    if (Take<uint8_t>(&cursor) != 3) throw std::runtime_error("a face is no triangle");
    for (uint64_t& index : face) index = Take<uint32_t>(&cursor);
  }
  return mesh;
}

}  // namespace folprom::decode_library
