#include "engine/attribute_bits.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace folprom {

Result<std::vector<AttributeBits>> ParseAttributeBits(const std::vector<std::string>& texts) {
  std::vector<AttributeBits> all;
  for (const std::string& text : texts) {
    const size_t equals = std::min(text.rfind('='), text.size());
    AttributeBits one{text.substr(0, equals), 0};
    const char* const end = text.data() + text.size();
    if (equals < text.size()) {
      const auto result = std::from_chars(text.data() + equals + 1, end, one.bits);
      if (result.ec != std::errc() || result.ptr != end) one.bits = 0;
    }
    if (one.name.empty() || one.bits < 1 || one.bits > 24) {
      return Error{ErrorKind::kUsage,
                   "attribute_bits is \"" + text + "\", must be NAME=N with N in 1 .. 24"};
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace folprom
