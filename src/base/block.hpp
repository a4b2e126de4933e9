#pragma once

namespace perilink {

/// Vectors that are taken through a body at once, number after number side by side, so that the
/// bonds are read once for all. With 32 of them those of neighbouring particles leave the cache.
inline constexpr int block_width = 16;

}  // namespace perilink
