// Where in a scan file something is, and its text in messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace folprom::io {

/// A place between two values.
struct FilePosition {
  uint64_t offset = 0;  ///< in bytes from the start of the file
  uint64_t line = 0;    ///< number of that line, the first being 1; text files only
};

/// Text of a file for a message: at most 60 characters, and none that would garble a terminal.
inline std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.substr(0, 60)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > 60 ? "...\"" : "\"");
}

}  // namespace folprom::io
