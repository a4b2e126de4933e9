#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// \file
/// Index type and small vectors of fixed size that all modules share.

namespace perilink {

/// Number of a particle, bond or unknown. 32 bits suffice for every case that fits in one machine's
/// memory. They halve the bond tables, which are read once per event.
using Index = std::int32_t;

/// Marks "no such particle, bond or unknown".
inline constexpr Index no_index = -1;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Position or displacement; the third component is zero in two-dimensional bodies.
using Vector3 = std::array<double, 3>;

}  // namespace perilink
