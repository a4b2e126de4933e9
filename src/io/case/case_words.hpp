#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "discretization/lattices/lattice.hpp"
#include "material/elasticity.hpp"
#include "material/lattice_rules.hpp"
#include "material/mass_scaling.hpp"
#include "material/micromodulus.hpp"
#include "material/model_code_bond.hpp"
#include "material/softening.hpp"
#include "material/strain.hpp"
#include "material/strength/random_field.hpp"
#include "solver/factor_route.hpp"
#include "solver/linear_solver.hpp"

/// \file The words of case and study files: axes, reserved names, and a table of words for every
///     enumeration.

namespace perilink {

inline constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};

/// Rotations of the particles of micropolar bodies: "rotation" in two dimensions (about z); "rx",
/// "ry", "rz" in three.
inline constexpr std::array<const char*, 3> rotation_names = {"rx", "ry", "rz"};
inline const char* rotation_name(int dim, std::size_t axis) {
  return dim == 2 ? "rotation" : rotation_names[axis];
}

/// Returns the key of a displacement along an axis (0 to 2) or of a rotation about one (3 to 5).
inline const char* motion_name(int dim, std::size_t component) {
  return component < 3 ? axis_names[component] : rotation_name(dim, component - 3);
}

/// Regions that every case has: the particles and facets of the surface, and the whole body.
inline constexpr const char* surface_region = "surface";
inline constexpr const char* body_region = "body";

/// Discretisation of a body.
enum class BodyMethod { bonds, linear_elements };

/// Material model of a body of bonds.
enum class BodyModel {
  bond_based,
  micropolar,
  lattice,    ///< state-based particles on a lattice
  particles,  ///< state-based particles at any positions
};

/// Measure of a crack's fracture energy.
enum class CriticalStretch { dissipated, lattice, continuum };

enum class AnalysisType { damage, elastic, explicit_, relaxation };

/// Control of the steps of a quasistatic analysis.
enum class LoadControl { events, steps };

/// Bond between the nodes of a bar and the solid.
enum class RebarBond {
  perfect,     ///< no slip
  linear,      ///< constant stiffness up to a strength, then constant bond stress
  model_code,  ///< ModelCodeBond
  curve,       ///< points of the curve
  concrete,    ///< bonds like those between particles of the solid
};

/// Ends of a bar that do not slip.
enum class Hooks { none, from, to, both };

/// Treatment of a body with free rigid-body modes.
enum class RigidBodyModes { refuse, pin };

/// Keys of [body] that a study can refine.
enum class Refinement { spacing, columns, mesh, mesh_size };

/// Numbers of a run that a study can measure.
enum class Quantity {
  strain_energy,
  peak_load,
  peak_displacement,
  first_peak_load,
  first_peak_displacement,
  smoothed_peak_load,
  initial_stiffness,
  dissipated_energy,
};

/// Reference of the error of a quantity.
enum class Reference {
  finest,        ///< the finest member of the same combination
  extrapolated,  ///< the limit extrapolated from the three finest members
  number,        ///< a given number, without a word
};

/// Treatment of a rigid motion before displacements are compared.
enum class RigidMotion { kept, removed };

template <class... Word>
constexpr std::array<std::string_view, sizeof...(Word)> words(Word... word) {
  return {word...};
}

/// Returns the words of an enumeration in the order of its enumerators. The last enumerators may
/// have no word.
constexpr auto words_of(Problem) {
  return words("plane_stress", "plane_strain", "three_dimensional", "shell", "beam");
}
constexpr auto words_of(BodyMethod) { return words("bonds", "linear_elements"); }
constexpr auto words_of(BodyModel) {
  return words("bond_based", "micropolar", "lattice", "particles");
}
constexpr auto words_of(Pattern) {
  return words("rectangular", "hexagonal", "cubic", "face_centred", "unstructured");
}
constexpr auto words_of(Surface) { return words("none", "ghost", "energy", "calibrated"); }
constexpr auto words_of(Constants) { return words("lattice", "continuum"); }
constexpr auto words_of(CriticalStretch) { return words("dissipated", "lattice", "continuum"); }
constexpr auto words_of(Softening) {
  return words("brittle", "linear", "bilinear", "exponential", "points", "concrete");
}
constexpr auto words_of(VaryingProperty) {
  return words("tensile_strength", "fracture_energy", "youngs_modulus");
}
constexpr auto words_of(Distribution) { return words("normal", "lognormal", "weibull"); }
constexpr auto words_of(LatticeRules) { return words("consistent", "2018", "2017"); }
constexpr auto words_of(AnalysisType) {
  return words("damage", "elastic", "explicit", "relaxation");
}
constexpr auto words_of(LoadControl) { return words("events", "steps"); }
constexpr auto words_of(RebarBond) {
  return words("perfect", "linear", "model_code", "curve", "concrete");
}
constexpr auto words_of(Hooks) { return words("none", "from", "to", "both"); }
constexpr auto words_of(BondFailure) {
  return words("pull_out", "splitting", "splitting_stirrups");
}
constexpr auto words_of(BondConditions) { return words("good", "other"); }
constexpr auto words_of(RigidBodyModes) { return words("refuse", "pin"); }
constexpr auto words_of(FactorRoute) { return words("in_place", "cholmod_updown", "refactorize"); }
constexpr auto words_of(LinearSolver) { return words("auto", "direct", "iterative"); }
constexpr auto words_of(MassScaling) { return words("volume", "uniform"); }
constexpr auto words_of(Strain) { return words("small", "green"); }
constexpr auto words_of(Refinement) { return words("spacing", "columns", "mesh", "mesh_size"); }
constexpr auto words_of(Quantity) {
  return words("strain_energy", "peak_load", "peak_displacement", "first_peak_load",
               "first_peak_displacement", "smoothed_peak_load", "initial_stiffness",
               "dissipated_energy");
}
constexpr auto words_of(Reference) { return words("finest", "extrapolated"); }
constexpr auto words_of(RigidMotion) { return words("kept", "removed"); }

template <class Enumeration>
std::string_view word_of(Enumeration value) {
  return words_of(value)[static_cast<std::size_t>(value)];
}

/// Whether the file of a mesh is a geometry that has to be meshed: .geo, .step, .stp or .brep, in
/// upper or lower case.
bool is_geometry(std::string_view path);

/// Whether a geometry is a script of gmsh (.geo).
bool is_gmsh_script(std::string_view path);

/// Whether a pattern is two-dimensional.
bool is_flat(Pattern pattern);

}  // namespace perilink
