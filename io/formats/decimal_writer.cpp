#include "io/formats/decimal_writer.h"

#include <bit>
#include <charconv>

#include "folprom/float_bits.h"
#include "io/formats/text_number.h"

namespace folprom::io {

std::string_view DecimalWriter::Text(double value) {
  if (value != value) CountPayload(std::bit_cast<uint64_t>(value));
  return is_double_ ? Double(value) : Shortest(std::bit_cast<float>(NarrowToFloatBits(value)));
}

template <class T>
std::string_view DecimalWriter::Shortest(T value) {
  const auto result = std::to_chars(text_, text_ + sizeof text_, value);
  return {text_, static_cast<size_t>(result.ptr - text_)};
}

std::string_view DecimalWriter::Double(double value) {
  const std::string_view shortest = Shortest(value);
  if (tells_double_ || value != value || static_cast<double>(static_cast<float>(value)) == value) {
    return shortest;
  }
  tells_double_ = true;
  if (!IsFloat32Decimal(shortest, value)) return shortest;
  // "0.1" would be read as a float: more digits than any double needs are those of no float.
  const auto result =
      std::to_chars(text_, text_ + sizeof text_, value, std::chars_format::scientific, 17);
  return {text_, static_cast<size_t>(result.ptr - text_)};
}

void DecimalWriter::CountPayload(uint64_t bits) {
  constexpr uint64_t kQuiet = uint64_t{0x7ff8} << 48;
  payloads_lost_ += (bits & ~(uint64_t{1} << 63)) != kQuiet;
}

}  // namespace folprom::io
