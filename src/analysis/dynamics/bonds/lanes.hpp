#pragma once

#include <cstddef>
#include <cstdint>

/// \file
/// Eight numbers at once, by the vectors that GCC and Clang know on every processor.

namespace perilink {

inline constexpr int num_lanes = 8;

using Lanes [[gnu::vector_size(64)]] = double;
using LaneWords [[gnu::vector_size(64)]] = std::int64_t;

/// The same anywhere in memory.
using LanesInMemory [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;

inline void load(const double* from, Lanes& to) {
  to = *reinterpret_cast<const LanesInMemory*>(from);
}

/// Zeros in lanes whose bit is not set.
inline void keep_lanes(std::uint8_t bits, Lanes& values) {
  constexpr LaneWords bit = {1, 2, 4, 8, 16, 32, 64, 128};
  const LaneWords kept = (LaneWords{} + std::int64_t{bits}) & bit;
  values = kept != 0 ? values : Lanes{};
}

inline void keep_larger(const Lanes& values, Lanes& largest) {
  largest = values > largest ? values : largest;
}

/// Vectors of `Dim` components one after the other in memory, to one Lanes per component.
template <int Dim>
inline void load_vectors(const double* from, Lanes* to) {
  static_assert(1 <= Dim && Dim <= 3);
  if constexpr (Dim == 1) {
    load(from, to[0]);
    return;
  }
  Lanes a, b;
  load(from, a);
  load(from + num_lanes, b);
  if constexpr (Dim == 2) {
    to[0] = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    to[1] = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
  } else if constexpr (Dim == 3) {
    Lanes c;
    load(from + 2 * num_lanes, c);
    const Lanes x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
    const Lanes y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
    const Lanes z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
    to[0] = __builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13);
    to[1] = __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14);
    to[2] = __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15);
  }
}

}  // namespace perilink
