// The coders for which every promise holds.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "folprom/settings.h"

namespace folprom::support {

/// The coder of the paper: vertex sets split top-down, offsets in a local frame. All else as it is
/// by default.
inline CodecSettings LloydSettings() {
  CodecSettings settings;
  settings.hierarchy = Hierarchy::kLloyd;
  settings.offsets = Offsets::kCylindrical;
  return settings;
}

/// Light models, all else as it is by default.
inline CodecSettings LightSettings() {
  CodecSettings settings;
  settings.models = Models::kLight;
  return settings;
}

/// The parameter of a test that holds for either coder.
struct Coder {
  std::string name;
  CodecSettings settings;
};
inline void PrintTo(const Coder& coder, std::ostream* out) { *out << coder.name; }

inline auto EveryCoder() {
  return ::testing::Values(Coder{"Quadric", {}}, Coder{"Lloyd", LloydSettings()});
}
inline std::string NameOfCoder(const ::testing::TestParamInfo<Coder>& info) {
  return info.param.name;
}

}  // namespace folprom::support
