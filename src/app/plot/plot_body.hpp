#pragma once

#include <array>
#include <utility>
#include <vector>

#include "app/plot/svg.hpp"
#include "base/csr.hpp"
#include "base/types.hpp"
#include "io/fields/vtu.hpp"

/// \file
/// A body as it is drawn: the contents of a field file, deformed and projected on the page.

namespace perilink {

/// Two ends of a bond or bar segment.
using Ends = std::pair<Index, Index>;

/// What a field file says about the body.
struct PlotBody {
  int dim = 2;
  double spacing = 1.0;
  std::vector<Vector3> positions;      ///< reference [length]
  std::vector<Vector3> displacements;  ///< [length]
  std::vector<double> damage;
  /// About the distance to the nearest particles [length]; less at surfaces, where particles have
  /// half a cell or less.
  std::vector<double> sizes;
  std::vector<double> openings;  ///< per broken bond [length]; empty: not in the file
  bool is_mid_surface = false;   ///< a plate or shell in space
  std::vector<double> stress;    ///< von Mises [force/length^2]; of elastic analyses, else empty;
                                 ///< of sheets without damage the size of the displacement [length]
  std::vector<int> kind;         ///< 0 solid, 1 ghost, 2 rebar, 3 anchor
  std::vector<Ends> broken_bonds;
  std::vector<Ends> segments;
  std::vector<double> bar_stress;  ///< per segment [force/length^2]; empty: not in the file
  /// Corners of finite elements that carry particles, one after the other round the element; in the
  /// plane.
  Csr elements;

  Index size() const { return static_cast<Index>(positions.size()); }
  /// Whether every bond of a solid particle is broken: a crumb, whose displacement means nothing.
  bool is_loose(Index i) const { return kind[i] == 0 && damage[i] > 0.999; }
};

/// \throws FileError naming the array that is missing
PlotBody read_body(const VtuGrid& grid, const std::string& path);

/// Factor on the displacements that makes the largest about 8 % of the size of the body; 1, 2 or 5
/// times a power of ten.
double automatic_scale(const PlotBody& body);

/// Deformed positions, with displacements times `scale`.
std::vector<Vector3> deformed_positions(const PlotBody& body, double scale);

/// Whether the solid particles stand on a square or cubic lattice of the spacing along the axes.
bool on_square_lattice(const PlotBody& body);

/// Orthographic view of points: (right, up, toward the viewer). Two-dimensional bodies as they are,
/// three-dimensional ones from above at an angle.
Vector3 view(const Vector3& point, int dim);

}  // namespace perilink
