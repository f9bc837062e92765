// What a shell offers after the tab key.
#pragma once

#include <string>

#include "apps/pages/command.h"

namespace folprom::pages {

std::string BashCompletion(const Command& program);
std::string ZshCompletion(const Command& program);

}  // namespace folprom::pages
