#pragma once

#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

namespace perilink::test {

inline NetworkInput micropolar_input(const LatticeInput& body, double poissons_ratio = 0.1) {
  NetworkInput input = network_input(body);
  input.model = BondModel::micropolar;
  input.materials[0].poissons_ratio = poissons_ratio;
  input.torsion = 1.3;
  return input;
}

inline Network make_micropolar_network(const LatticeCase& lattice_case, int columns) {
  const LatticeInput input = body_input(lattice_case, columns);
  return build_network(make_body(input), micropolar_input(input));
}

/// Returns two particles joined by one micropolar bond of given stiffnesses.
inline Network single_frame(int dim, const std::vector<double>& second, double stiffness,
                            double bending) {
  Network network;
  network.particles.dim = network.bonds.dim = dim;
  network.particles.positions.assign(static_cast<std::size_t>(dim), 0.0);
  network.particles.positions.insert(network.particles.positions.end(), second.begin(),
                                     second.end());
  network.particles.volumes = {1.0, 1.0};
  network.particles.material = {0, 0};
  network.particles.kind = {ParticleKind::solid, ParticleKind::solid};
  network.bonds.append(network.particles, 0, 1);
  network.stiffness = {stiffness};
  network.bending = {bending};
  network.critical_stretch = {1e-3};
  network.first_slip_spring = network.first_bar_element = 1;
  return network;
}

/// Returns the motion of all particles in a homogeneous deformation, rotations included, shape
/// (particles, width).
inline std::vector<double> linear_motion(const Network& network,
                                         const std::array<Vector3, 3>& gradient) {
  const std::vector<double> displacement = linear_field(network.particles, gradient);
  const int dim = network.dim(), width = network.width();
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    motion.insert(motion.end(), displacement.begin() + i * dim,
                  displacement.begin() + (i + 1) * dim);
    for (int k = dim == 2 ? 2 : 0; k < 3 && width > dim; ++k) {
      const int next = (k + 1) % 3, last = (k + 2) % 3;
      motion.push_back(0.5 * (gradient[last][next] - gradient[next][last]));
    }
  }
  return motion;
}

}  // namespace perilink::test
