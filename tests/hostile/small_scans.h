// A small scan of every format and form, to be damaged.
#pragma once

#include <string>
#include <vector>

namespace folprom::hostile {

struct SmallScan {
  std::string name;  ///< with the ending of its format
  std::string bytes;
  bool is_text = true;
};

/// A few vertices and faces each, with what else the format may hold. Those of PLY are seeds of the
/// fuzz target.
std::vector<SmallScan> SmallScans();

}  // namespace folprom::hostile
