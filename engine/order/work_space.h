// Memory for arrays as long as the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/types.h"

namespace folprom {

/// Gives out arrays of zeros that live as long as it does.
class WorkSpace {
 public:
  virtual ~WorkSpace() = default;
  virtual std::span<uint32_t> Words(size_t count) = 0;
  /// To be called after so many steps that each touch a few places of the arrays.
  virtual void Stepped(size_t /*steps*/) {}

  std::span<Face> Faces(size_t count) {
    return {reinterpret_cast<Face*>(Words(3 * count).data()), count};
  }
  std::span<Int3> Positions(size_t count) {
    return {reinterpret_cast<Int3*>(Words(3 * count).data()), count};
  }
};

class HeapSpace final : public WorkSpace {
 public:
  std::span<uint32_t> Words(size_t count) override { return arrays_.emplace_back(count, 0u); }

 private:
  std::vector<std::vector<uint32_t>> arrays_;
};

}  // namespace folprom
