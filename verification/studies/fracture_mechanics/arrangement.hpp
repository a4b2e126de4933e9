#pragma once

#include <string>

/// \file
/// Particles of a rectangle: on a lattice of the case file, on a turned lattice, or a cloud.

namespace perilink::verification {

/// How the particles of a specimen lie.
struct Arrangement {
  enum class Kind {
    lattice,       ///< a pattern of the case file, along the axes
    turned,        ///< a mesh whose vertices are those of a turned lattice
    particle_set,  ///< a mesh of gmsh
    unstructured,  ///< the pattern of the case file
  };
  Kind kind = Kind::lattice;
  bool hexagonal = false;
  double degrees = 0.0;  ///< by which a lattice is turned
  int algorithm = 5;     ///< meshes a cloud: gmsh's 1 MeshAdapt, 5 Delaunay, 6 Frontal
  int sample = 0;  ///< plates are larger by so many fifths of two spacings: other meshes; a seed
};

/// "hexagonal turned 15", for tables.
std::string name_of(const Arrangement& arrangement);

/// Distance of the rows of a lattice over the spacing.
double row_of(const Arrangement& arrangement);

/// Keys of [body] for the rectangle [0, width] x [0, height] . A
/// mesh is written into temporary_folder() and is read by build_model().
std::string body_keys(const Arrangement& arrangement, double spacing, double horizon_ratio,
                      double width, double height);

/// Folder of this process, which the program removes at its end.
std::string temporary_folder();

}  // namespace perilink::verification
