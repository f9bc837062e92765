#include "apps/folprom/markup.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace folprom::cli {
namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";  // U+FFFD

std::string ValidUtf8(std::string_view text) {
  using nlohmann::json;
  const std::string quoted = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(quoted).get<std::string>();
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : ValidUtf8(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default: {
        const auto byte = static_cast<unsigned char>(c);
        const bool control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
        if (control) {
          escaped += kReplacement;
        } else {
          escaped += c;
        }
      }
    }
  }
  return escaped;
}

std::string PngAddress(std::span<const uint8_t> png) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string address = "data:image/png;base64,";
  address.reserve(address.size() + (png.size() + 2) / 3 * 4);
  for (size_t i = 0; i < png.size(); i += 3) {
    const size_t bytes = std::min<size_t>(3, png.size() - i);
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j) group = group << 8 | (j < bytes ? png[i + j] : 0U);
    for (size_t digit = 0; digit < 4; ++digit) {
      address += digit <= bytes ? kDigits[group >> (18 - 6 * digit) & 63U] : '=';
    }
  }
  return address;
}

}  // namespace folprom::cli
