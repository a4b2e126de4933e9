#pragma once

#include <vector>

#include "base/csr.hpp"
#include "discretization/cuts/cracks.hpp"
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
  /// Particles and bonds of the smaller box, which has no cracks.
  Network sample;
  std::vector<Crack> cracks;  ///< that cut bonds of the box
  double num_cut = 0.0;       ///< how many they cut

  /// The place in the sample that lies like a point of the box.
  GridPoint place(const GridPoint& point) const;
  /// How many bonds the box has.
  double num_bonds() const;
};

/// A pattern without its sample, whose bonds the caller makes. Depths are three times the reach:
/// as far as calibrated bonds tell places apart.
LatticePattern pattern_of(const LatticeGrid& grid, double horizon);

/// Whether a sample can stand for a box: it is in one piece, no particle of it is loose, it has
/// nothing but bonds, some turn each particle where they carry moments, and where they were
/// calibrated, those that lie alike are alike.
bool can_repeat(const Network& sample);

/// Cuts the bonds of the box that cross cracks; looks only at those around them.
/// \param by_crack  how many each of them cuts
/// \return whether the box stays in one piece and no particle of it is loose
bool cut_bonds(LatticePattern& pattern, const std::vector<Crack>& cracks,
               std::vector<Index>& by_crack);

/// Bonds that have an end in a window, as the box has them.
class PatternBonds {
 public:
  explicit PatternBonds(const LatticePattern& pattern);

  /// Those whose first end is in the window alone, before cracks cut any.
  template <class Visit>
  void for_each_first(const GridWindow& window, Visit visit) const {
    pattern_.grid.for_each(window, [&](const GridPoint& p) {
      for_each_of(p, [&](const GridPoint& other, Index element, bool comes_first) {
        if (comes_first) visit(p, other, element);
      });
    });
  }

  /// Calls visit(first, second, element) for bonds that no crack cuts: points of the box in their
  /// order, and the element of the sample that is like the bond. At first bonds whose first end is
  /// in the window, in their order, then the others.
  template <class Visit>
  void for_each(const GridWindow& window, Visit visit) const {
    for_each_before(window, [&](const GridPoint& first, const GridPoint& second, Index element) {
      if (!is_cut(first, second)) visit(first, second, element);
    });
  }
  /// The same before cracks cut bonds.
  template <class Visit>
  void for_each_before(const GridWindow& window, Visit visit) const {
    for_each_first(window, visit);
    pattern_.grid.for_each(window, [&](const GridPoint& p) {
      for_each_of(p, [&](const GridPoint& other, Index, bool comes_first) {
        if (comes_first || window.contains(other)) return;
        visit(other, p, element_between(other, p));
      });
    });
  }
  /// \param first  end that comes first
  /// \param count  see CrackCutter::cuts()
  bool is_cut(const GridPoint& first, const GridPoint& second, std::span<Index> count = {}) const {
    if (pattern_.cracks.empty()) return false;
    return cutter_.cuts(pattern_.grid.position(first), pattern_.grid.position(second), count);
  }
  /// Whether too few bonds are left at a point to hold and, where they carry moments, to turn it.
  bool is_loose(const GridPoint& point) const;
  /// Around all cracks, as far as bonds reach.
  GridWindow around_cracks() const;

 private:
  template <class Visit>
  void for_each_of(const GridPoint& point, Visit visit) const {
    const GridPoint like = pattern_.place(point);
    const Index own = pattern_.small.number(pattern_.small.all(), like);
    for (const Index e : neighbourhoods_.row(own)) {
      GridPoint other = points_[pattern_.sample.bonds.other_end(e, own)];
      for (int a = 0; a < 3; ++a) other[a] += point[a] - like[a];
      visit(other, e, pattern_.sample.bonds.first[e] == own);
    }
  }
  Index element_between(const GridPoint& first, const GridPoint& second) const;

  const LatticePattern& pattern_;
  Csr neighbourhoods_;             // bonds of each particle of the sample
  std::vector<GridPoint> points_;  // where these are
  CrackCutter cutter_;
};

}  // namespace perilink
