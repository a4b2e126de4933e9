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

/// \file Bonds that lie alike in a box. Mirrored in the middle planes of the box, turned where its
/// axes are alike, and moved along its faces away from the edges, a lattice is the same again; so
/// may its calibrated stiffnesses be.

namespace perilink {

/// A box filled with one lattice.
struct LatticeBox {
  Vector3 lower{};               ///< [length]
  Vector3 step{};                ///< one step of the lattice along each axis [length]
  std::array<Index, 3> count{};  ///< steps along each axis; third in the plane: none
};

/// The box in space, or the strip of one row of cells in the plane, that a body fills; none where
/// it is something else.
std::optional<LatticeBox> lattice_box(const Body& body);

/// Classes of bonds that lie alike.
struct BondOrbits {
  /// Number of each bond as it looks from its first and from its second end: equal for ends that
  /// one of the symmetries maps on each other. no_index: not free.
  std::vector<std::array<Index, 2>> views;
  Index num_views = 0;
  /// A particle for each kind of place where free bonds end, ascending.
  std::vector<Index> representatives;

  /// Number of the class of a bond.
  Index of_bond(Index bond) const { return std::min(views[bond][0], views[bond][1]); }
};

/// Depths under the faces tell bonds apart up to twice the reach of the bonds (in steps), and
/// particles, all of whose bonds have to lie alike, up to three times: no less far than the strip
/// goes whose bonds may change. Along axes that are too short for this only mirrored places are
/// alike.
/// \param free  bonds whose stiffness may change
BondOrbits find_orbits(const LatticeBox& box, const Particles& particles, const Bonds& bonds,
                       std::span<const std::uint8_t> free);

/// The bonds that end at the representatives.
struct OrbitSample : BondSample {
  BondOrbits orbits;
};

OrbitSample sample_orbits(const BondOrbits& orbits, Index num_particles, const Bonds& bonds,
                          std::span<const std::uint8_t> free, const BondStiffness& stiffness);

/// Gives all bonds of a class the stiffness that the sample found for it.
/// \param sampled    stiffness of the bonds of the sample
/// \param stiffness  for the whole body, unchanged where the sample lacks a class
/// \return whether it has all
bool spread(const OrbitSample& sample, const BondStiffness& sampled, const BondOrbits& orbits,
            BondStiffness& stiffness);

}  // namespace perilink
