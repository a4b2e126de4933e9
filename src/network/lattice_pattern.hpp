#pragma once

#include <vector>

#include "base/csr.hpp"
#include "discretization/lattices/lattice_grid.hpp"
#include "network/network.hpp"

namespace perilink {

/// The bonds of a box of a lattice, however large, by those of a smaller one: bonds at places that
/// lie alike under the faces are alike, as calibration makes them (calibration/bond_orbits.hpp).
/// So a process can make the bonds of any part of the box by itself.
struct LatticePattern {
  LatticeGrid grid;              ///< the box
  LatticeGrid small;             ///< the smaller one
  std::array<Index, 3> reach{};  ///< farthest that bonds go along each axis [steps]
  std::array<Index, 3> depth{};  ///< under a face from which on all places are alike [steps]
  /// Particles and trusses of the smaller box.
  Network sample;

  /// The place in the sample that lies like a point of the box.
  GridPoint place(const GridPoint& point) const;
  /// How many bonds the box has.
  double num_bonds() const;
};

/// A pattern without its sample, whose bonds the caller makes. Depths are three times the reach:
/// as far as calibrated bonds tell places apart.
LatticePattern pattern_of(const LatticeGrid& grid, double horizon);

/// Whether a sample can stand for a box: it is in one piece, no particle of it is loose, it has
/// nothing but trusses, and where these were calibrated, those that lie alike are alike.
bool can_repeat(const Network& sample);

/// Bonds that have an end in a window, as the box has them.
class PatternBonds {
 public:
  explicit PatternBonds(const LatticePattern& pattern);

  /// Those whose first end is in the window alone.
  template <class Visit>
  void for_each_first(const GridWindow& window, Visit visit) const {
    pattern_.grid.for_each(window, [&](const GridPoint& p) {
      for_each_of(p, [&](const GridPoint& other, Index element, bool comes_first) {
        if (comes_first) visit(p, other, element);
      });
    });
  }

  /// Calls visit(first, second, element): points of the box, the first of which comes first in it,
  /// and the element of the sample that is like the bond. At first bonds whose first end is in the
  /// window, in their order, then the others.
  template <class Visit>
  void for_each(const GridWindow& window, Visit visit) const {
    for_each_first(window, visit);
    pattern_.grid.for_each(window, [&](const GridPoint& p) {
      for_each_of(p, [&](const GridPoint& other, Index, bool comes_first) {
        if (comes_first || window.contains(other)) return;
        visit(other, p, element_between(other, p));
      });
    });
  }

 private:
  template <class Visit>
  void for_each_of(const GridPoint& point, Visit visit) const {
    const GridPoint like = pattern_.place(point);
    const Index own = pattern_.small.number(pattern_.small.all(), like);
    for (const Index e : families_.row(own)) {
      GridPoint other = points_[pattern_.sample.bonds.other_end(e, own)];
      for (int a = 0; a < 3; ++a) other[a] += point[a] - like[a];
      visit(other, e, pattern_.sample.bonds.first[e] == own);
    }
  }
  Index element_between(const GridPoint& first, const GridPoint& second) const;

  const LatticePattern& pattern_;
  Csr families_;                   // bonds of each particle of the sample
  std::vector<GridPoint> points_;  // where these are
};

}  // namespace perilink
