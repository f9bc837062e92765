#include "apps/folprom/report.h"

#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <iterator>

#include "folprom/result.h"

namespace folprom::cli {

void Print(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    throw Failure(ErrorKind::kOutput, "standard output: cannot be written");
  }
}

void PrintJson(const Json& object) {
  // A name or message need not be valid UTF-8.
  Print(object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json DistanceJson(const DistanceStatistics& statistics, double diagonal) {
  const auto relative = [&](double x) { return diagonal > 0 ? Json(x / diagonal) : Json(nullptr); };
  return {{"mean", statistics.mean},
          {"rms", statistics.rms},
          {"max", statistics.max},
          {"mean_relative", relative(statistics.mean)},
          {"rms_relative", relative(statistics.rms)},
          {"max_relative", relative(statistics.max)}};
}

Json AttributesJson(std::span<const AttributeInfo> attributes, uint64_t vertices) {
  Json list = Json::array();
  for (const AttributeInfo& attribute : attributes) {
    const Json bits =
        vertices > 0 ? Json(attribute.bits / static_cast<double>(vertices)) : Json(nullptr);
    list.push_back({{"name", attribute.name},
                    {"type", NameOf(attribute.type)},
                    {"bits_per_vertex", bits},
                    {"step", attribute.step > 0 ? Json(attribute.step) : Json(nullptr)}});
  }
  return list;
}

Json FaceAttributesJson(std::span<const FaceAttributeInfo> attributes) {
  Json list = Json::array();
  for (const FaceAttributeInfo& attribute : attributes) {
    list.push_back({{"name", attribute.name},
                    {"type", NameOf(attribute.type)},
                    {"per_corner", attribute.per_corner}});
  }
  return list;
}

std::string Printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  }
  return text;
}

std::string Grouped(uint64_t number) {
  std::string text = std::to_string(number);
  for (size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

std::string BytesShort(uint64_t bytes) {
  static constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  auto value = static_cast<double>(bytes);
  size_t unit = 0;
  while (value >= 1024 && unit + 1 < std::size(kUnits)) {
    value /= 1024;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

}  // namespace folprom::cli
