#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "calibration/isotropic_weights.hpp"
#include "discretization/lattices/lattice.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Isotropic stiffness of the bonds inside a lattice, for each material, by the vector between
/// their ends.
class LatticeNeighbourhoods {
 public:
  /// \throws std::invalid_argument where the horizon holds too few neighbours for an isotropic
  ///     solid
  LatticeNeighbourhoods(const Body& body, const NetworkInput& input);

  Index size() const { return static_cast<Index>(neighbourhood_.offsets.size()); }
  std::span<const Vector3> offsets() const { return neighbourhood_.offsets; }

  /// Number of the neighbour that a bond leads to, no_index where the lattice has none there (close
  /// pairs at the sides of hexagonal bodies).
  Index find(std::span<const double> direction, double length) const;

  const NeighbourhoodStiffness& stiffness(Index material) const { return stiffness_[material]; }

  /// 1/2 sum k xi^2 of a particle of the material, axial [force length].
  double modulus(Index material) const { return modulus_[material]; }

 private:
  std::array<long, 3> key(const Vector3& vector) const;

  Lattice lattice_;
  InteriorNeighbourhood neighbourhood_;
  std::map<std::array<long, 3>, Index> numbers_;
  std::vector<NeighbourhoodStiffness> stiffness_;
  std::vector<double> modulus_;
};

}  // namespace perilink
