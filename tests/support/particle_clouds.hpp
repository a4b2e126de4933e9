#pragma once

#include <random>
#include <vector>

#include "discretization/meshes/mesh_body.hpp"
#include "network/states/particle_network.hpp"
#include "support/simplex_meshes.hpp"

/// \file
/// State-based particles in unstructured sets.

namespace perilink::test {

inline constexpr IsotropicMaterial soft_solid{30.0, 0.2};

/// Returns a unit square or cube with `count` steps across and shifted inner vertices.
inline Body unstructured_body(int dim, int count) {
  const Mesh mesh = box_mesh(dim, count);
  return make_mesh_body(mesh, std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0),
                        1.0);
}

inline ParticleNetwork unstructured_particles(int dim, int count,
                                              const IsotropicMaterial& material = soft_solid) {
  return make_particle_network(unstructured_body(dim, count),
                               dim == 2 ? Problem::plane_stress : Problem::three_dimensional,
                               std::vector{material}, 1.0);
}

inline std::vector<double> random_numbers(std::size_t count, unsigned seed, double low,
                                          double high) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> value(low, high);
  std::vector<double> values(count);
  for (double& each : values) each = value(generator);
  return values;
}

}  // namespace perilink::test
