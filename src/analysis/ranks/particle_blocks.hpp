#pragma once

#include <algorithm>
#include <cstddef>

#include "base/types.hpp"

namespace perilink {

/// Particles in blocks of a fixed size: sums over blocks do not depend on the number of threads.
class ParticleBlocks {
 public:
  /// \param width  components of the motion of a particle
  /// \param size   particles of a block; only the last block may have fewer
  ParticleBlocks(Index particles, int width, Index size = 256)
      : particles_(particles), width_(width), size_(size) {}

  Index count() const { return (particles_ + size_ - 1) / size_; }
  Index of(Index particle) const { return particle / size_; }
  Index begin(Index block) const { return block * size_; }
  Index end(Index block) const { return std::min(particles_, begin(block) + size_); }

  /// Components of the particles of a block: [first_slot, last_slot).
  std::size_t first_slot(Index block) const {
    return static_cast<std::size_t>(begin(block)) * width_;
  }
  std::size_t last_slot(Index block) const { return static_cast<std::size_t>(end(block)) * width_; }

  /// As many threads as are wanted and have something to do.
  int threads(int wanted) const {
    return std::min<Index>(wanted, std::max<Index>(1, count() / blocks_per_thread));
  }

  /// visit(slot) for every component of every particle of a block.
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
