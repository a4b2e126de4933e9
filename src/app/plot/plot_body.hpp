#pragma once

#include <array>
#include <utility>
#include <vector>

#include "app/plot/svg.hpp"
#include "base/csr.hpp"
#include "base/types.hpp"
#include "io/fields/vtu.hpp"

/// \file
/// Contents of a field file for drawing: deformed and projected on the page.

namespace perilink {

/// Two ends of a bond or bar segment.
using Ends = std::pair<Index, Index>;

/// Body in a field file.
struct PlotBody {
  int dim = 2;
  double spacing = 1.0;
  std::vector<Vector3> positions;      ///< reference [length]
  std::vector<Vector3> displacements;  ///< [length]
  std::vector<double> damage;
  /// Approximate distance to the nearest particles [length]; smaller at surfaces, where particles
  /// have half a cell or less.
  std::vector<double> sizes;
  std::vector<double> openings;  ///< per broken bond [length]; empty: not in the file
  bool is_mid_surface = false;   ///< a plate or shell in space
  std::vector<double> stress;    ///< von Mises [force/length^2]; of elastic analyses, else empty;
                                 ///< undamaged mid-surfaces: norm of displacement [length]
  std::vector<int> kind;         ///< 0 solid, 1 ghost, 2 rebar, 3 embedded point
  std::vector<Ends> broken_bonds;
  std::vector<Index> broken_at;  ///< per broken bond, number of its break, from 1; 0: unknown
  std::vector<Ends> segments;
  std::vector<double> bar_stress;  ///< per segment [force/length^2]; empty: not in the file
  std::vector<int> held;           ///< sum of 1, 2, 4 for held components; empty: none in the file
  /// Forces and displacements applied; empty: none.
  std::vector<Vector3> forces, moves;
  /// Corners of finite elements that constrain particles, in order round each element; two
  /// dimensions only.
  Csr elements;

  Index size() const { return static_cast<Index>(positions.size()); }
  /// Whether every bond of a solid particle is broken; its displacement then has no meaning.
  bool is_loose(Index i) const { return kind[i] == 0 && damage[i] > 0.999; }
};

/// Reads a body. \throws FileError naming the array that is missing
PlotBody read_body(const VtuGrid& grid, const std::string& path);

/// Returns the von Mises stress of the components xx, yy, zz, xy, yz, xz.
double von_mises(const double* stress);

/// Returns a factor on displacements that draws the largest at about 8 % of the size of the body.
/// It is 1, 2 or 5 times a power of ten.
double automatic_scale(const PlotBody& body);

/// Returns deformed positions with displacements times `scale`.
std::vector<Vector3> deformed_positions(const PlotBody& body, double scale);

/// Whether the solid particles form a square or cubic lattice along the axes.
bool on_square_lattice(const PlotBody& body);

/// Projects a point orthographically to (right, up, toward the viewer). Two-dimensional bodies stay
/// as they are, three-dimensional ones are seen obliquely from above.
Vector3 view(const Vector3& point, int dim);

}  // namespace perilink
