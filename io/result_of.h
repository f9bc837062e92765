// The border between Failures inside and Results outside.
#pragma once

#include <type_traits>

#include "folprom/result.h"

namespace folprom::io {

/// What work() gives, or the Error of the Failure that it throws.
template <class Work>
Result<std::invoke_result_t<Work>> ResultOf(Work work) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      return {};
    } else {
      return work();
    }
  } catch (const Failure& failure) {
    return failure.error();
  }
}

}  // namespace folprom::io
