// Plain values as bytes of a temporary file of this machine, and back with every read checked.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "folprom/result.h"

namespace folprom {

class RecordWriter {
 public:
  template <class T>
  void Put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    PutBytes(&value, sizeof value);
  }
  /// T has no padding.
  template <class T>
  void PutAll(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    Put(uint64_t{values.size()});
    PutBytes(values.data(), values.size_bytes());
  }
  template <class T>
  void PutAll(const std::vector<T>& values) {
    PutAll(std::span<const T>(values));
  }
  void PutFlags(const std::vector<bool>& flags) {
    PutAll(std::vector<uint8_t>(flags.begin(), flags.end()));
  }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  void PutBytes(const void* from, size_t size) {
    const size_t end = bytes_.size();
    bytes_.resize(end + size);
    if (size > 0) std::memcpy(bytes_.data() + end, from, size);
  }
  std::vector<uint8_t> bytes_;
};

/// Throws Failure kOutput where the bytes end too early.
class RecordReader {
 public:
  explicit RecordReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  T Take() {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    T value;
    std::memcpy(&value, TakeBytes(sizeof value).data(), sizeof value);
    return value;
  }
  template <class T>
  void Take(T* value) {
    *value = Take<T>();
  }
  template <class T>
  void TakeAll(std::vector<T>* values) {
    const auto count = Take<uint64_t>();
    if (count > bytes_.size() / sizeof(T)) ThrowCut();
    values->resize(count);
    if (count > 0)
      std::memcpy(values->data(), TakeBytes(count * sizeof(T)).data(), count * sizeof(T));
  }
  void TakeFlags(std::vector<bool>* flags) {
    std::vector<uint8_t> bytes;
    TakeAll(&bytes);
    flags->assign(bytes.begin(), bytes.end());
  }

 private:
  [[noreturn]] static void ThrowCut() {
    throw Failure(ErrorKind::kOutput, "a temporary record ends too early");
  }
  std::span<const uint8_t> TakeBytes(size_t size) {
    if (size > bytes_.size()) ThrowCut();
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  std::span<const uint8_t> bytes_;
};

}  // namespace folprom
