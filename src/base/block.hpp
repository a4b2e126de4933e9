#pragma once

namespace perilink {

/// Vectors that are taken through a body at once, number after number side by side: reading the
/// bonds then counts for nothing.
inline constexpr int block_width = 32;

}  // namespace perilink
