// A job file that explains itself.
#pragma once

#include <string>

namespace folprom::batch {

/// A job file with every key: its meaning, unit, range and default, from the table that reads it.
/// Keys that the example does not set stand as comments, "#key = default".
std::string ExampleText();

}  // namespace folprom::batch
