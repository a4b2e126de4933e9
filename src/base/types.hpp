#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// \file
/// The index type and the small fixed-size vectors that every module shares.

namespace perilink {

/// Number of a particle, bond or unknown. 32 bits hold every case that fits in the memory of one
/// machine and keep the bond tables, which are read once per event, half as large.
using Index = std::int32_t;

/// Marks "no such particle, bond or unknown".
inline constexpr Index no_index = -1;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Position or displacement; two-dimensional bodies leave the third component zero.
using Vector3 = std::array<double, 3>;

}  // namespace perilink
