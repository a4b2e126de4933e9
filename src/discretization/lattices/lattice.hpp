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

/// Arrangement of the particles.
enum class Pattern {
  rectangular,
  hexagonal,
  cubic,
  face_centred,
  irregular,  ///< vertices of a mesh
};

/// What is done about the missing bonds at a surface.
enum class Surface {
  none,        ///< conforming lattice: particles on the boundary, nothing corrected
  ghost,       ///< Peri2D: cell-centred particles and a ghost layer bonded at half stiffness
  energy,      ///< bonds scaled so that each particle stores the energy of the continuum
  calibrated,  ///< bonds that pass the linear patch test, boundary included
};

/// Spacing of a lattice along the axes. The hexagonal pattern's rows lie sqrt(3)/2 of the column
/// spacing apart (a little more or less where the rows must end on the boundary); the face-centred
/// pattern's spacing is the distance of nearest neighbours, its cube sqrt(2) times as long.
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

/// Where the particles of a body come from.
struct LatticeInput {
  Pattern pattern = Pattern::rectangular;
  Surface surface = Surface::none;
  double spacing = 0.0;         ///< wanted; a conforming lattice adapts it to the body [length]
  double horizon = 0.0;         ///< margin of the ghost layer [length]
  double thickness = 1.0;       ///< two-dimensional bodies only [length]
  std::vector<Box> solid;       ///< the body is the union of these boxes
  std::vector<Index> material;  ///< per box; where boxes overlap the last one counts
  /// Whether these differ in stiffness: faces of boxes are joints then, in which rows should lie.
  bool unlike_materials = false;
  double boundary_tolerance = 1e-6;  ///< for "inside a box", in spacings
};

/// A named part of a mesh (physical group).
struct Group {
  std::string name;
  std::vector<Index> particles;  ///< ascending
  std::vector<Index> facets;     ///< those on the surface that belong to the group, ascending
  /// Groups of points and of lines: points [length], shape (points, 3), and the ends of lines,
  /// shape (lines, 2).
  std::vector<double> line_points = {};
  std::vector<Index> lines = {};
  /// An end of a line that is no edge of the body: a curve for bars alone.
  std::optional<Vector3> loose = {};
  /// Groups of lines, in space of triangles: the sides of cells that they are, by their corners,
  /// shape (sides, dim).
  std::vector<Index> sides = {};
  std::vector<Index> cells = {};  ///< groups of cells: their numbers in Body::cells, ascending
};

/// A part of a beam with one section and one material.
struct BeamSpan {
  Index first = 0, last = 0;  ///< its particles, ends included
  Index material = 0;
  double height = 0.0;  ///< size of the section in the plane [length]
};

/// Particles and the lattice or the mesh that they belong to.
struct Body {
  /// With a mesh: pattern irregular, step zero, spacing and cell volume are means.
  Lattice lattice;
  Particles particles;
  Facets facets;              ///< surface and faces between materials; empty with ghosts
  Simplices cells;            ///< meshes only
  std::vector<Group> groups;  ///< meshes only
  /// Meshes only, per cell: nonzero where it is an ordinary finite element without bonds; empty:
  /// nowhere. The lattice is then that of the others.
  std::vector<std::uint8_t> tied = {};
  std::vector<BeamSpan> spans = {};  ///< beams only, in the order of their particles
};

/// Family of a particle far from every surface.
InteriorNeighbourhood interior_neighbourhood(const Lattice& lattice, double horizon);

/// Radius of the particles that Peri2D's horizon level 0–8 encloses, in spacings
/// (Gerstle, Sau & Silling 2005, Fig. 5).
/// \throws std::invalid_argument for a pattern without levels or a level outside 0–8
double horizon_of_level(Pattern pattern, int level);

}  // namespace perilink
