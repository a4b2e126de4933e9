#pragma once

#include <cstdint>
#include <vector>

#include "analysis/quasistatic/ranks/body_part.hpp"
#include "base/parcel.hpp"
#include "network/lattice_pattern.hpp"

namespace perilink {

/// What a rank has to be told of a box of a lattice to make its part by itself.
struct PatternShare {
  LatticePattern pattern;
  std::vector<GridWindow> windows;  ///< particles that each rank owns
  Index particles_of_box = 0;       ///< at most, of the coarse space
  int width = 2;                    ///< components of the motion of a particle
  /// Whether they are held, in the window and around it, shape (particles, width).
  std::vector<std::uint8_t> held;
  std::vector<Index> materials;  ///< per particle there
  /// Springs at its own particles, shape (own, width) [force/length]; empty: there are none.
  std::vector<double> springs;

  void pack(Parcel& parcel) const;
  static PatternShare unpack(Parcel& parcel);
};

/// Particles and unknowns of the windows.
/// \param unknowns  those of the whole body
Partition share_out(const LatticeGrid& grid, const std::vector<GridWindow>& windows,
                    const Unknowns& unknowns);

/// \param places  particles and springs of the whole body
PatternShare share_of(const LatticePattern& pattern, const std::vector<GridWindow>& windows,
                      const Network& places, const Unknowns& unknowns, Index particles_of_box,
                      int rank);

/// Makes particles and bonds, halves what it owns into boxes, splits these along cracks and adds up
/// what all boxes resist.
/// Collective. \throws NotPositiveDefinite on all ranks
BodyPart make_part(Ranks& ranks, const PatternShare& share);

}  // namespace perilink
