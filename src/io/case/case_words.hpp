#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "discretization/lattices/lattice.hpp"

/// \file
/// How the case file spells the axes and the enumerations of the discretization.

namespace perilink {

inline constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};

/// Rotations of the particles of micropolar bodies: "rotation" in two dimensions, where they turn
/// about z; "rx", "ry", "rz" in three.
inline constexpr std::array<const char*, 3> rotation_names = {"rx", "ry", "rz"};
inline const char* rotation_name(int dim, std::size_t axis) {
  return dim == 2 ? "rotation" : rotation_names[axis];
}

/// Key of a displacement along an axis (0 to 2) or of a rotation about one (3 to 5).
inline const char* motion_name(int dim, std::size_t component) {
  return component < 3 ? axis_names[component] : rotation_name(dim, component - 3);
}

/// Regions that every case has besides its own: the particles and facets of the surface, and all of
/// the body.
inline constexpr const char* surface_region = "surface";
inline constexpr const char* body_region = "body";

const std::vector<std::string_view>& pattern_words();
const std::vector<std::string_view>& surface_words();
const std::vector<std::string_view>& method_words();

std::string_view word_of(Pattern pattern);
std::string_view word_of(Surface surface);

/// \param word  one of pattern_words()
Pattern pattern_of(std::string_view word);
/// \param word  one of surface_words()
Surface surface_of(std::string_view word);

/// Whether the file of a mesh is a geometry that has to be meshed, by its name: .geo, .step, .stp
/// or .brep in letters of either case.
bool is_geometry(std::string_view path);

/// Whether a geometry is a script of gmsh (.geo).
bool is_gmsh_script(std::string_view path);

/// Whether a pattern fills a plane and not space.
bool is_flat(Pattern pattern);

}  // namespace perilink
