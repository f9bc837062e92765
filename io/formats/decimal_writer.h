// Coordinates as the shortest decimals that give them back.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Writes the coordinates of one file so that its reader chooses the same type and gets the same
/// values. A NaN keeps its sign and loses its payload.
class DecimalWriter {
 public:
  explicit DecimalWriter(ScalarType type) : is_double_(type == ScalarType::kFloat64) {}

  /// Valid until the next call.
  std::string_view Text(double value);
  /// NaNs so far that text does not give back.
  uint64_t payloads_lost() const { return payloads_lost_; }

 private:
  template <class T>
  std::string_view Shortest(T value);
  std::string_view Double(double value);
  void CountPayload(uint64_t bits);

  bool is_double_;
  // The type is that of the whole file: one decimal that float32 does not hold tells it.
  bool tells_double_ = false;
  uint64_t payloads_lost_ = 0;
  char text_[64];
};

}  // namespace folprom::io
