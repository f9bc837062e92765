// Errors that a caller can act on: one kind per exit code, one sentence per error.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace folprom {

/// Kind of fault. The value is the exit code of the program.
enum class ErrorKind : int {
  kUsage = 2,         ///< the call itself is wrong
  kInput = 3,         ///< input missing, unreadable or of an unsupported form
  kCorrupt = 4,       ///< encoded data contradict themselves
  kOutput = 5,        ///< output or disk
  kLimit = 6,         ///< a limit on size or memory would be exceeded
  kInternal = 70,     ///< a bug in folprom
  kInterrupted = 130  ///< cancelled by the caller
};

/// What went wrong: kind, and a message that names the file, the place and the reason.
struct Error {
  ErrorKind kind = ErrorKind::kInternal;
  std::string message;
};

/// Carries an Error through code that cannot return one. Never leaves the public functions that
/// return a Result.
class Failure : public std::runtime_error {
 public:
  explicit Failure(Error error) : std::runtime_error(error.message), error_(std::move(error)) {}
  Failure(ErrorKind kind, std::string message) : Failure(Error{kind, std::move(message)}) {}
  const Error& error() const { return error_; }

 private:
  Error error_;
};

/// A value or an Error. `value()` throws Failure when there is an error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: implicit by design
  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return std::get<1>(state_); }
  T& value() & {
    if (!ok()) throw Failure(error());
    return std::get<0>(state_);
  }
  T&& value() && {
    if (!ok()) throw Failure(error());
    return std::get<0>(std::move(state_));
  }
  T* operator->() { return &value(); }
  T& operator*() & { return value(); }

 private:
  std::variant<T, Error> state_;
};

/// Success or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT: implicit by design
  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const { return error_; }
  void value() const {
    if (!ok_) throw Failure(error_);
  }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace folprom
