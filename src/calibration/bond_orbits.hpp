#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "calibration/bond_equations.hpp"
#include "calibration/bond_sample.hpp"
#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/particles.hpp"

/// \file Symmetry-equivalent bonds in a box. The symmetries are reflections in the middle planes,
///     exchanges of equivalent axes, and translations along the faces away from the edges. The
///     calibrated stiffnesses may have the symmetries of the lattice.

namespace perilink {

/// A box filled with one lattice.
struct LatticeBox {
  Vector3 lower{};               ///< [length]
  Vector3 step{};                ///< one step of the lattice along each axis [length]
  std::array<Index, 3> count{};  ///< steps along each axis; the third is not used in the plane
};

/// Returns the box in space, or the strip of one row of cells in the plane, that a body fills;
/// std::nullopt for other shapes.
std::optional<LatticeBox> lattice_box(const Body& body);

/// Equivalence classes of bonds.
struct BondOrbits {
  /// Class of each bond as seen from its first and from its second end: equal for ends that a
  /// symmetry maps on each other. no_index: not free.
  std::vector<std::array<Index, 2>> views;
  Index num_views = 0;
  /// One particle per equivalence class of particles at free bonds, ascending.
  std::vector<Index> representatives;

  /// Returns the class of a bond.
  Index of_bond(Index bond) const { return std::min(views[bond][0], views[bond][1]); }
};

/// Finds the equivalence classes. Depth under a face distinguishes bonds up to twice the reach of
/// the bonds (in steps), and particles up to three times. This covers the strip of free bonds.
/// Along axes that are too short for this, only reflections are used.
/// \param free  bonds whose stiffness may change
BondOrbits find_orbits(const LatticeBox& box, const Particles& particles, const Bonds& bonds,
                       std::span<const std::uint8_t> free);

/// Bonds that end at the representatives.
struct OrbitSample : BondSample {
  BondOrbits orbits;
};

OrbitSample sample_orbits(const BondOrbits& orbits, Index num_particles, const Bonds& bonds,
                          std::span<const std::uint8_t> free, const BondStiffness& stiffness);

/// Sets the stiffness of all bonds of each class to the result of the sample.
/// \param sampled    stiffness of the bonds of the sample
/// \param stiffness  for the whole body, unchanged where the sample lacks a class
/// \return whether the sample has all classes
bool spread(const OrbitSample& sample, const BondStiffness& sampled, const BondOrbits& orbits,
            BondStiffness& stiffness);

}  // namespace perilink
