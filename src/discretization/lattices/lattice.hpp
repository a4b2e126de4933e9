#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"
#include "discretization/region.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Pattern of the particles.
enum class Pattern {
  rectangular,
  hexagonal,
  cubic,
  face_centred,
  irregular,  ///< vertices of a mesh
};

/// Correction of missing bonds at a surface.
enum class Surface {
  none,        ///< conforming lattice: particles on the boundary, no correction
  ghost,       ///< Peri2D: cell-centred particles and a ghost layer bonded at half stiffness
  energy,      ///< each particle's bonds are scaled to the strain energy of the continuum
  calibrated,  ///< bonds pass the linear patch test, boundary included
};

/// Spacing of a lattice along the axes. Rows of the hexagonal pattern are about sqrt(3)/2 of the
/// column spacing apart; the height adapts so that rows end on the boundary. The spacing of the
/// face-centred pattern is the distance of nearest neighbours; its cube is sqrt(2) times as long.
struct Lattice {
  Pattern pattern = Pattern::rectangular;
  Surface surface = Surface::none;
  int dim = 2;
  double spacing = 0.0;      ///< between neighbouring columns [length]
  Vector3 step{};            ///< distance of neighbouring columns, rows and layers [length]
  double cell_volume = 0.0;  ///< volume of an interior particle [length^3]
};

/// Vectors from an interior particle to all its neighbours within the horizon.
struct InteriorNeighbourhood {
  int dim = 2;
  std::vector<Vector3> offsets;  ///< [length]
};

/// Geometry and lattice of a body.
struct LatticeInput {
  Pattern pattern = Pattern::rectangular;
  Surface surface = Surface::none;
  double spacing = 0.0;         ///< wanted; a conforming lattice adapts it [length]
  double horizon = 0.0;         ///< margin of the ghost layer [length]
  double thickness = 1.0;       ///< two-dimensional bodies only [length]
  std::vector<Box> solid;       ///< the body is the union of these boxes
  std::vector<Index> material;  ///< per box; the last box counts where boxes overlap
  /// Whether the materials differ in stiffness. Faces of boxes are then joints, which need rows.
  bool unlike_materials = false;
  double boundary_tolerance = 1e-6;  ///< tolerance of "inside a box" [spacings]
};

/// Named part of a mesh (physical group).
struct Group {
  std::string name;
  std::vector<Index> particles;  ///< ascending
  std::vector<Index> facets;     ///< surface facets of the group, ascending
  /// Groups of points and lines: points [length], shape (points, 3), and the ends of the lines,
  /// shape (lines, 2).
  std::vector<double> line_points = {};
  std::vector<Index> lines = {};
  /// Corner of an element that is not a side of a cell. Such curves are valid for bars and, in the
  /// plane, for cracks.
  std::optional<Vector3> loose = {};
  /// Groups of lines (2D) or triangles (3D): corners of their cell sides, shape (sides, dim).
  std::vector<Index> sides = {};
  std::vector<Index> cells = {};  ///< groups of cells: numbers in Body::cells, ascending
};

/// Part of a beam with one section and one material.
struct BeamSpan {
  Index first = 0, last = 0;  ///< range of particles, ends included
  Index material = 0;
  double height = 0.0;  ///< height of the section in the plane [length]
};

/// Particles of a body with their lattice or mesh.
struct Body {
  /// With a mesh: pattern irregular, step zero, mean spacing and cell volume.
  Lattice lattice;
  Particles particles;
  Facets facets;              ///< surface and faces between materials; empty with ghosts
  Simplices cells;            ///< meshes only
  std::vector<Group> groups;  ///< meshes only
  /// Meshes only, per cell: nonzero for a tied finite element, which has no bonds; empty: no tied
  /// elements. `lattice` describes the other cells.
  std::vector<std::uint8_t> tied = {};
  std::vector<BeamSpan> spans = {};  ///< beams only, in the order of their particles
};

/// Returns the neighbourhood of a particle far from every surface.
InteriorNeighbourhood interior_neighbourhood(const Lattice& lattice, double horizon);

/// Returns the radius of Peri2D's horizon level 0–8 [spacings] (Gerstle, Sau & Silling 2005, Fig.
/// 5).
/// \throws std::invalid_argument for a pattern without levels or a level outside 0–8
double horizon_of_level(Pattern pattern, int level);

}  // namespace perilink
