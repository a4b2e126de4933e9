#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace perilink {

/// Message buffer: plain values and lists as bytes for another process of this program. Values are
/// read in the order in which they were written.
class Parcel {
 public:
  Parcel() = default;
  explicit Parcel(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  /// Empties the buffer and keeps its memory.
  void clear() {
    bytes_.clear();
    next_ = 0;
  }

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof(T));
  }
  template <class T>
  void put(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(values.size());
    put_bytes(values.data(), values.size() * sizeof(T));
  }

  /// Writes values without their number; the receiver must read as many.
  template <class T>
  void put_values(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(values.data(), values.size_bytes());
  }

  template <class T>
  T get() {
    T value;
    get_bytes(&value, sizeof(T));
    return value;
  }
  template <class T>
  void get(T& value) {
    value = get<T>();
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(get<std::size_t>());
    get_bytes(values.data(), values.size() * sizeof(T));
  }

  template <class T>
  void get_values(std::span<T> values) {
    get_bytes(values.data(), values.size_bytes());
  }

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  void put_bytes(const void* from, std::size_t count) {
    if (count == 0) return;
    bytes_.resize(bytes_.size() + count);
    std::memcpy(bytes_.data() + bytes_.size() - count, from, count);
  }
  void get_bytes(void* to, std::size_t count) {
    if (count == 0) return;
    std::memcpy(to, bytes_.data() + next_, count);
    next_ += count;
  }

  std::vector<std::byte> bytes_;
  std::size_t next_ = 0;
};

}  // namespace perilink
