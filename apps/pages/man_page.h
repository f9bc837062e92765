// Manual pages in troff, for man(1).
#pragma once

#include <string>

#include "apps/pages/command.h"

namespace folprom::pages {

struct ManEdition {
  std::string version;
  std::string date;  ///< "2026-01-31", or empty where unknown
};

/// folprom(1).
std::string ManPage(const Command& program, const ManEdition& edition);
/// folprom-<verb>(1).
std::string VerbManPage(const Command& program, const Command& verb, const ManEdition& edition);

}  // namespace folprom::pages
