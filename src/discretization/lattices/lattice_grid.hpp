#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// A point of a lattice, in steps from the lower corner of its box.
using GridPoint = std::array<Index, 3>;

/// A box of points, those on its faces included.
struct GridWindow {
  GridPoint first{}, last{};
};

/// A box filled with one rectangular, cubic or face-centred lattice: all its particles, from a few
/// numbers. They are numbered as make_body() does it: x runs fastest.
struct LatticeGrid {
  int dim = 3;
  Vector3 lower{}, upper{};      ///< corners [length]
  Vector3 step{};                ///< between points along each axis [length]
  double spacing = 0.0;          ///< Lattice::spacing
  std::array<Index, 3> count{};  ///< steps along each axis; third in the plane: none
  bool alternate = false;        ///< face-centred: every other point carries a particle

  GridWindow all() const { return {{}, count}; }
  /// How many particles of a window come before a point of it.
  Index number(const GridWindow& window, const GridPoint& point) const;
  Index size(const GridWindow& window) const {
    return number(window, {window.first[0], window.first[1], window.last[2] + 1});
  }
  Vector3 position(const GridPoint& point) const;
  /// Calls visit(point) for the particles of a window in their order.
  template <class Visit>
  void for_each(const GridWindow& window, Visit visit) const {
    GridPoint p;
    for (p[2] = window.first[2]; p[2] <= window.last[2]; ++p[2]) {
      for (p[1] = window.first[1]; p[1] <= window.last[1]; ++p[1]) {
        for (p[0] = window.first[0]; p[0] <= window.last[0]; ++p[0]) {
          if (!alternate || (p[0] + p[1] + p[2]) % 2 == 0) visit(p);
        }
      }
    }
  }
};

/// The grid whose particles are those of a body, one for one; none where it is something else.
std::optional<LatticeGrid> grid_of(const Body& body);

/// A body of one material on the same lattice that fills another grid.
/// \param thickness  in the plane [length]
Body body_of(const LatticeGrid& grid, const Lattice& lattice, double thickness);

}  // namespace perilink
