#pragma once

#include <algorithm>
#include <cstddef>

#include "base/types.hpp"

namespace perilink {

/// Blocks of particles of a fixed size. Sums over blocks do not depend on the number of threads.
class ParticleBlocks {
 public:
  /// \param width  components of the motion of a particle
  /// \param size   particles of a block; the last block may have fewer
  ParticleBlocks(Index particles, int width, Index size = 256)
      : particles_(particles), width_(width), size_(size) {}

  Index count() const { return (particles_ + size_ - 1) / size_; }
  Index of(Index particle) const { return particle / size_; }
  Index begin(Index block) const { return block * size_; }
  Index end(Index block) const { return std::min(particles_, begin(block) + size_); }

  /// First component of the particles of a block; last_slot() is one past the last component.
  std::size_t first_slot(Index block) const {
    return static_cast<std::size_t>(begin(block)) * width_;
  }
  std::size_t last_slot(Index block) const { return static_cast<std::size_t>(end(block)) * width_; }

  /// Returns the number of threads to use: at most `wanted`, and one per four blocks.
  int threads(int wanted) const {
    return std::min<Index>(wanted, std::max<Index>(1, count() / blocks_per_thread));
  }

  /// Calls visit(slot) for every component of every particle of a block.
  template <class Visit>
  void for_slots(Index block, Visit visit) const {
    for (std::size_t slot = first_slot(block); slot < last_slot(block); ++slot) visit(slot);
  }

 private:
  static constexpr Index blocks_per_thread = 4;

  Index particles_;
  int width_;
  Index size_;
};

}  // namespace perilink
