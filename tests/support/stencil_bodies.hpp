#pragma once

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

/// \file
/// Bodies with recurring bonds, and their motions.

namespace perilink::test {

struct StencilCase {
  std::string name;
  Pattern pattern;
  bool holed = false;
  bool two_materials = false;
};

inline std::ostream& operator<<(std::ostream& out, const StencilCase& body) {
  return out << body.name;
}

/// Returns a plate or block with rows of about ten particles, with an optional hole and materials.
inline Network stencil_network(const StencilCase& body) {
  LatticeInput input = body_input({body.name, body.pattern, Surface::none}, 12);
  const Vector3 end = input.solid[0].upper;
  const double deep = is_plane(body.pattern) ? 0.0 : end[2] / 3.0;
  const auto box = [&](double x, double y, double to_x, double to_y) {
    return Box{{x * end[0] / 12.0, y * end[1] / 12.0, 0.0},
               {to_x * end[0] / 12.0, to_y * end[1] / 12.0, deep}};
  };
  input.solid = {box(0, 0, 12, 4), box(0, 4, 4, 8), box(8, 4, 12, 8), box(0, 8, 12, 12)};
  input.material = {0, 0, 0, body.two_materials ? 1 : 0};
  if (!body.holed) {
    input.solid.push_back(box(4, 4, 8, 8));
    input.material.push_back(0);
  }
  NetworkInput constants = network_input(input);
  constants.materials.push_back({50.0, 0.01});
  constants.solid = input.solid;
  return build_network(make_body(input), constants);
}

inline std::vector<StencilCase> stencil_cases() {
  return {{"rectangular", Pattern::rectangular},
          {"rectangular_holed_of_two", Pattern::rectangular, true, true},
          {"hexagonal", Pattern::hexagonal},
          {"cubic_holed", Pattern::cubic, true},
          {"face_centred_of_two", Pattern::face_centred, false, true}};
}

/// Returns a random motion in which every component of both ends moves by at most `size` [length].
inline BondMotion random_motion(const Network& network, double size, unsigned seed) {
  const std::size_t slots = static_cast<std::size_t>(network.particles.size()) * network.width();
  BondMotion motion{random_vector(slots, seed), random_vector(slots, seed + 1)};
  for (double& u : motion.displacement) u *= size;
  for (double& v : motion.velocity) v *= size;
  return motion;
}

struct ForcesOfAll {
  std::vector<double> force;
  BondLosses losses;
};

inline ForcesOfAll forces_of_all(const Network& network, ExplicitBonds& bonds,
                                 const BondMotion& motion, double time_step) {
  ForcesOfAll result;
  result.force.assign(motion.displacement.size(), NAN);  // every value must be overwritten
  result.losses = bonds.forces(0, network.particles.size(), time_step, motion, result.force);
  return result;
}

}  // namespace perilink::test
