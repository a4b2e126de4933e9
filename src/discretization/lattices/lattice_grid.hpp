#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Lattice point, in steps from the lower corner of its box.
using GridPoint = std::array<Index, 3>;

/// Box of points, including its faces.
struct GridWindow {
  GridPoint first{}, last{};
};

/// Box filled with one rectangular, cubic or face-centred lattice. Positions and numbers of its
/// particles are computed, not stored. The numbers are as in make_body(): x runs fastest.
struct LatticeGrid {
  int dim = 3;
  Vector3 lower{}, upper{};      ///< corners [length]
  Vector3 step{};                ///< between points along each axis [length]
  double spacing = 0.0;          ///< Lattice::spacing
  std::array<Index, 3> count{};  ///< steps along each axis; zero along z in the plane
  bool alternate = false;        ///< face-centred: every other point carries a particle

  GridWindow all() const { return {{}, count}; }
  /// Returns the number of the window's particles before a point.
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

/// Returns a grid with exactly the particles of a body; empty if the body is no such grid.
std::optional<LatticeGrid> grid_of(const Body& body);

/// Returns a body of one material on a grid with the given lattice.
/// \param thickness  in the plane [length]
Body body_of(const LatticeGrid& grid, const Lattice& lattice, double thickness);

}  // namespace perilink
