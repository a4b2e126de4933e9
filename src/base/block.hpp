#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace perilink {

/// Number of vectors in a block. A block stores the vectors' entries side by side, so that one pass
/// over the bonds serves all. With 32 vectors, the entries of neighbouring particles leave the
/// cache.
inline constexpr int block_width = 16;

/// Allocator of memory aligned to cache lines. It stores the shift in the byte before the aligned
/// address. The aligned operator new requests more than a freed block holds, so memory would grow
/// with every vector.
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

/// Blocks of vectors, shape (n, block_width). The alignment keeps a row within one cache line; a
/// row across two lines takes twice as long to load.
template <class Number>
using BlockVector = std::vector<Number, LineAllocator<Number>>;

}  // namespace perilink
