#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "calibration/isotropic_weights.hpp"
#include "discretization/lattices/lattice.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Isotropic stiffness of the interior bonds of a lattice, per material and vector between the
/// ends.
class LatticeNeighbourhoods {
 public:
  /// \throws std::invalid_argument if the horizon has too few neighbours for an isotropic solid
  LatticeNeighbourhoods(const Body& body, const NetworkInput& input);

  Index size() const { return static_cast<Index>(neighbourhood_.offsets.size()); }
  std::span<const Vector3> offsets() const { return neighbourhood_.offsets; }

  /// Returns the number of the neighbour at a vector, or no_index without one. Close pairs at the
  /// sides of hexagonal bodies are an example.
  Index find(std::span<const double> direction, double length) const;

  const NeighbourhoodStiffness& stiffness(Index material) const { return stiffness_[material]; }

  /// Returns 1/2 sum k xi^2 of a particle of the material, axial [force length].
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
