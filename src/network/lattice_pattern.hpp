#pragma once

#include <vector>

#include "base/csr.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/lattices/lattice_grid.hpp"
#include "network/network.hpp"

namespace perilink {

/// Describes the bonds of a large lattice box by a smaller template box. Bonds at equivalent places
/// under the faces are symmetry-equivalent after calibration (calibration/bond_orbits.hpp). So each
/// process can generate the bonds of any part of the box.
struct LatticePattern {
  LatticeGrid grid;              ///< the box
  LatticeGrid small;             ///< template box
  std::array<Index, 3> reach{};  ///< largest extent of a bond along each axis [steps]
  std::array<Index, 3> depth{};  ///< under a face, from which all places are equivalent [steps]
  /// Particles and bonds of the template box, without cracks.
  Network sample;
  std::vector<Crack> cracks;  ///< cracks that cut bonds of the box
  double num_cut = 0.0;       ///< number of cut bonds

  /// Returns the template place equivalent to a point of the box.
  GridPoint place(const GridPoint& point) const;
  /// Returns the number of bonds of the box.
  double num_bonds() const;
};

/// Returns a pattern without its template network, which the caller builds. Depths are three times
/// the reach, as far as calibrated bonds differ between places.
LatticePattern pattern_of(const LatticeGrid& grid, double horizon);

/// Returns whether a template can represent a box. It must be in one piece, without loose
/// particles, and have only bonds. Where bonds carry moments, some must turn each particle.
/// Calibrated bonds must preserve symmetry.
bool can_repeat(const Network& sample);

/// Cuts the bonds of the box that cross cracks; only bonds near cracks are tested.
/// \param by_crack  number of bonds that each crack cuts
/// \return whether the box stays in one piece without loose particles
bool cut_bonds(LatticePattern& pattern, const std::vector<Crack>& cracks,
               std::vector<Index>& by_crack);

/// Bonds of the box with an end in a window.
class PatternBonds {
 public:
  explicit PatternBonds(const LatticePattern& pattern);

  /// Calls visit(first, second, element) for bonds with their first end in the window, before
  /// cracks cut any.
  template <class Visit>
  void for_each_first(const GridWindow& window, Visit visit) const {
    pattern_.grid.for_each(window, [&](const GridPoint& p) {
      for_each_of(p, [&](const GridPoint& other, Index element, bool comes_first) {
        if (comes_first) visit(p, other, element);
      });
    });
  }

  /// Calls visit(first, second, element) for bonds that no crack cuts: points of the box in their
  /// order, and the equivalent element of the template. Bonds with their first end in the window
  /// come first, in order.
  template <class Visit>
  void for_each(const GridWindow& window, Visit visit) const {
    for_each_before(window, [&](const GridPoint& first, const GridPoint& second, Index element) {
      if (!is_cut(first, second)) visit(first, second, element);
    });
  }
  /// Calls visit(first, second, element) as for_each() does, before cracks cut bonds.
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
  /// Returns whether a crack cuts the bond between two points.
  /// \param first  end that comes first
  /// \param count  see CrackCutter::cuts()
  bool is_cut(const GridPoint& first, const GridPoint& second, std::span<Index> count = {}) const {
    if (pattern_.cracks.empty()) return false;
    return cutter_.cuts(pattern_.grid.position(first), pattern_.grid.position(second), count);
  }
  /// Returns whether the remaining bonds at a point are too few to hold it and, where bonds carry
  /// moments, to turn it.
  bool is_loose(const GridPoint& point) const;
  /// Returns the window around all cracks within the reach of bonds.
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
  Csr neighbourhoods_;             // bonds of each template particle
  std::vector<GridPoint> points_;  // points of the template particles
  CrackCutter cutter_;
};

}  // namespace perilink
