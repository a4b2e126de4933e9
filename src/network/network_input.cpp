#include "network/network_input.hpp"

#include "material/micromodulus.hpp"

namespace perilink {

MicropolarModuli moduli_of(const Body& body, const NetworkInput& input,
                           const SolidMaterial& material) {
  const ElasticConstants elastic{material.youngs_modulus, material.poissons_ratio};
  // Calibration starts from the continuum: a lattice may not reach the given Poisson's ratio.
  const bool continuum =
      input.micromodulus == Constants::continuum || body.lattice.surface == Surface::calibrated;
  if (input.model == BondModel::micropolar) {
    if (continuum) {
      return continuum_micropolar(input.problem, elastic, input.horizon, input.thickness);
    }
    return lattice_micropolar(input.problem,
                              interior_neighbourhood(body.lattice, input.horizon).offsets,
                              body.lattice.cell_volume, elastic);
  }
  if (continuum) {
    return {continuum_micromodulus(input.problem, material.youngs_modulus, input.horizon,
                                   input.thickness),
            0.0};
  }
  const InteriorNeighbourhood neighbourhood = interior_neighbourhood(body.lattice, input.horizon);
  const LatticeModuli moduli =
      lattice_moduli(input.problem, neighbourhood.offsets, body.lattice.cell_volume);
  return {moduli.micromodulus_per_modulus * material.youngs_modulus, 0.0};
}

LameConstants lame_constants(const NetworkInput& input, const SolidMaterial& material) {
  const double nu = input.model == BondModel::micropolar ? material.poissons_ratio
                                                         : bond_poissons_ratio(input.problem);
  const double mu = 0.5 * material.youngs_modulus / (1.0 + nu);
  const double through = input.problem == Problem::plane_stress ? 1.0 - nu : 1.0 - 2.0 * nu;
  return {2.0 * mu * nu / through, mu};
}

}  // namespace perilink
