#pragma once

#include <vector>

#include "base/csr.hpp"
#include "discretization/lattices/lattice_grid.hpp"
#include "network/network.hpp"

namespace perilink {

/// Bonds of a large box of a lattice, given by those of a smaller template box. Bonds at the same
/// distance from the faces are equal (calibration/bond_orbits.hpp).
struct LatticePattern {
  LatticeGrid grid;              ///< the box
  LatticeGrid small;             ///< template box
  std::array<Index, 3> reach{};  ///< largest extent of a bond along each axis [steps]
  std::array<Index, 3> depth{};  ///< under a face, from which all places are equivalent [steps]
  /// Particles and bonds of the template box, without cracks.
  Network sample;

  /// Returns the template place equivalent to a point of the box.
  GridPoint place(const GridPoint& point) const;
  /// Returns the number of bonds of the box.
  double num_bonds() const;
};

/// Returns a pattern without its template network, which the caller builds. Depths are three times
/// the reach, as far as calibrated bonds differ between places.
LatticePattern pattern_of(const LatticeGrid& grid, double horizon);

/// The bonds of the box.
class PatternBonds {
 public:
  explicit PatternBonds(const LatticePattern& pattern);

  /// Calls visit(first, second, element) for every bond in the order of the first ends: points of
  /// the box, and the element of the sample that is like the bond.
  template <class Visit>
  void for_each(Visit visit) const {
    pattern_.grid.for_each(pattern_.grid.all(), [&](const GridPoint& p) {
      const GridPoint like = pattern_.place(p);
      const Index own = pattern_.small.number(pattern_.small.all(), like);
      for (const Index e : neighbourhoods_.row(own)) {
        if (pattern_.sample.bonds.first[e] != own) continue;
        GridPoint other = points_[pattern_.sample.bonds.second[e]];
        for (int a = 0; a < 3; ++a) other[a] += p[a] - like[a];
        visit(p, other, e);
      }
    });
  }

 private:
  const LatticePattern& pattern_;
  Csr neighbourhoods_;             // bonds of each particle of the sample
  std::vector<GridPoint> points_;  // where these are
};

}  // namespace perilink
