// A text file that a program writes parts of.
#pragma once

#include <string>

namespace folprom::peers {

/// Replaces what stands between the lines `<!-- begin NAME -->` and `<!-- end NAME -->` of the
/// file. Throws Failure kInput where the file or one of the lines is missing, kOutput.
void ReplaceMarked(const std::string& path, const std::string& name, const std::string& text);

/// Throws Failure kInput as ReplaceMarked would.
void CheckMarked(const std::string& path, const std::string& name);

}  // namespace folprom::peers
