#include "tests/bench/peers/marked_file.h"

#include "folprom/result.h"
#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {
namespace {

struct Marked {
  std::string text;  ///< of the file
  size_t begin = 0;  ///< of what is between the marks
  size_t end = 0;
};

Marked Read(const std::string& path, const std::string& name) {
  const std::vector<uint8_t> bytes = ReadBytes(path);
  Marked marked{std::string(bytes.begin(), bytes.end()), 0, 0};
  const std::string first = "<!-- begin " + name + " -->\n", last = "<!-- end " + name + " -->";
  const size_t at = marked.text.find(first);
  marked.end = at == std::string::npos ? at : marked.text.find(last, at);
  if (marked.end == std::string::npos) {
    throw Failure(ErrorKind::kInput,
                  path + ": no lines " + first.substr(0, first.size() - 1) + " and " + last);
  }
  marked.begin = at + first.size();
  return marked;
}

}  // namespace

void ReplaceMarked(const std::string& path, const std::string& name, const std::string& text) {
  Marked marked = Read(path, name);
  marked.text.replace(marked.begin, marked.end - marked.begin, text);
  WriteBytes(path, {marked.text.begin(), marked.text.end()});
}

void CheckMarked(const std::string& path, const std::string& name) { Read(path, name); }

}  // namespace folprom::peers
