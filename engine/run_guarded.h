// The border between exceptions inside the engine and Results outside.
#pragma once

#include <exception>
#include <new>
#include <utility>

#include "folprom/result.h"
#include "parallel/progress.h"

namespace folprom {

/// Calls work() and turns what it throws into an Error: kInternal where nothing else fits.
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
  } catch (const std::exception& error) {
    return Error{ErrorKind::kInternal, error.what()};
  }
}

}  // namespace folprom
