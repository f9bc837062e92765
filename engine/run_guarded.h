// The border between exceptions inside the engine and Results outside.
#pragma once

#include <new>
#include <utility>

#include "folprom/result.h"
#include "parallel/progress.h"

namespace folprom {

/// Calls work() and turns what it throws into an Error.
template <class T, class Work>
Result<T> RunGuarded(Work work) {
  try {
    return work();
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const parallel::Cancelled&) {
    return Error{ErrorKind::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::kLimit, "out of memory"};
  }
}

}  // namespace folprom
