#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "calibration/bond_equations.hpp"
#include "discretization/bonds.hpp"

namespace perilink {

/// Some bonds of a body, in the order of the body, with the data for their calibration.
struct BondSample {
  std::vector<Index> numbers;  ///< their numbers in the body
  Bonds bonds;
  BondStiffness stiffness;
  std::vector<std::uint8_t> free;  ///< whether each bond may change its stiffness

  /// Copies the stiffness found for the sample to the body.
  void put_back(const BondStiffness& found, BondStiffness& body) const;
};

/// Marks the particles at the ends of marked bonds.
std::vector<std::uint8_t> mark_ends(const Bonds& bonds, std::span<const std::uint8_t> marked,
                                    Index num_particles);

/// Returns the bonds that end at marked particles.
/// \param marked     per particle
/// \param free       per bond
/// \param stiffness  per bond
BondSample sample_bonds(std::span<const std::uint8_t> marked, const Bonds& bonds,
                        std::span<const std::uint8_t> free, const BondStiffness& stiffness);

}  // namespace perilink
