#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace perilink {

/// Vectors that are taken through a body at once, number after number side by side, so that the
/// bonds are read once for all. With 32 of them those of neighbouring particles leave the cache.
inline constexpr int block_width = 16;

/// Memory that begins where a line of the cache does. The operator new that aligns would ask for
/// more than a piece that it gave back has, and memory would grow with every vector.
template <class Number>
struct LineAllocator {
  using value_type = Number;
  static constexpr std::size_t line = 64;

  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>& /*other*/) {}
  Number* allocate(std::size_t count) {
    auto* whole = static_cast<unsigned char*>(::operator new(count * sizeof(Number) + line));
    const std::size_t skipped = line - reinterpret_cast<std::uintptr_t>(whole) % line;
    whole[skipped - 1] = static_cast<unsigned char>(skipped);
    return reinterpret_cast<Number*>(whole + skipped);
  }
  void deallocate(Number* numbers, std::size_t /*count*/) {
    auto* begin = reinterpret_cast<unsigned char*>(numbers);
    ::operator delete(begin - *(begin - 1));
  }
  bool operator==(const LineAllocator& /*other*/) const { return true; }
};

/// Blocks of vectors, shape (n, block_width): a row that reached across two lines would take twice
/// as long to load.
template <class Number>
using BlockVector = std::vector<Number, LineAllocator<Number>>;

}  // namespace perilink
