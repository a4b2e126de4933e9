#include "network/lattice_neighbourhoods.hpp"

#include <cmath>

namespace perilink {

LatticeNeighbourhoods::LatticeNeighbourhoods(const Body& body, const NetworkInput& input)
    : lattice_(body.lattice), neighbourhood_(interior_neighbourhood(body.lattice, input.horizon)) {
  for (std::size_t k = 0; k < neighbourhood_.offsets.size(); ++k) {
    numbers_[key(neighbourhood_.offsets[k])] = static_cast<Index>(k);
  }
  const double volume = lattice_.cell_volume;
  for (const SolidMaterial& material : input.materials) {
    const MicropolarModuli moduli = moduli_of(body, input, material);
    NeighbourhoodStiffness stiffness;
    for (const Vector3& offset : neighbourhood_.offsets) {
      const double length = std::hypot(offset[0], offset[1], offset[2]);
      const double share =
          volume * volume * partial_volume(length, input.horizon, lattice_.spacing) / length;
      stiffness.axial.push_back(moduli.micromodulus * share);
      if (input.model == BondModel::micropolar) {
        stiffness.bending.push_back(12.0 * moduli.bending_modulus * share / (length * length));
      }
    }
    make_isotropic(lattice_.dim, neighbourhood_.offsets, volume, lame_constants(input, material),
                   stiffness);
    double modulus = 0.0;
    for (std::size_t k = 0; k < neighbourhood_.offsets.size(); ++k) {
      const Vector3& x = neighbourhood_.offsets[k];
      modulus += 0.5 * stiffness.axial[k] * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    }
    stiffness_.push_back(std::move(stiffness));
    modulus_.push_back(modulus);
  }
}

/// Returns integer coordinates in half steps; every lattice vector has them.
std::array<long, 3> LatticeNeighbourhoods::key(const Vector3& vector) const {
  std::array<long, 3> numbers{};
  for (int axis = 0; axis < lattice_.dim; ++axis) {
    numbers[axis] = std::lround(2.0 * vector[axis] / lattice_.step[axis]);
  }
  return numbers;
}

Index LatticeNeighbourhoods::find(std::span<const double> direction, double length) const {
  Vector3 vector{};
  for (int axis = 0; axis < lattice_.dim; ++axis) vector[axis] = length * direction[axis];
  const auto found = numbers_.find(key(vector));
  return found == numbers_.end() ? no_index : found->second;
}

}  // namespace perilink
