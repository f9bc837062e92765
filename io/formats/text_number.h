// Numbers of text files.
#pragma once

#include <cstdint>
#include <string_view>

namespace folprom::io {

/// The whole word as an integer, with or without a plus sign; false where it is none.
bool ParseInteger(std::string_view word, int64_t* value);

/// The whole word as the nearest value of the type, with or without a plus sign; false where it is
/// no number. Too large or too small is infinity or zero. "nan" and "inf" are numbers.
bool ParseReal(std::string_view word, float* value);
bool ParseReal(std::string_view word, double* value);

/// Does float32 hold this decimal: is the float nearest to it, written with as many digits, the
/// same decimal again. True of whatever a program wrote from a float, with any number of digits;
/// false of "0.123456789", which no float is written as. `value`: the word as double.
bool IsFloat32Decimal(std::string_view word, double value);

}  // namespace folprom::io
