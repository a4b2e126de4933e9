#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"

namespace perilink::test {

/// Lattice of a parametrised test.
struct LatticeCase {
  std::string name;
  Pattern pattern;
  Surface surface;
};

inline const LatticeCase rectangular{"rectangular", Pattern::rectangular, Surface::none};
inline const LatticeCase hexagonal{"hexagonal", Pattern::hexagonal, Surface::none};
inline const LatticeCase hexagonal_ghost{"hexagonal_ghost", Pattern::hexagonal, Surface::ghost};
inline const LatticeCase cubic{"cubic", Pattern::cubic, Surface::none};

inline std::ostream& operator<<(std::ostream& out, const LatticeCase& lattice_case) {
  return out << lattice_case.name;
}

inline bool is_plane(Pattern pattern) {
  return pattern == Pattern::rectangular || pattern == Pattern::hexagonal;
}

/// Returns a body of `columns` spacings across; the rows of hexagonal lattices are exactly
/// sqrt(3)/2 apart.
inline LatticeInput body_input(const LatticeCase& lattice_case, int columns) {
  LatticeInput input;
  input.pattern = lattice_case.pattern;
  input.surface = lattice_case.surface;
  input.spacing = 0.2;
  input.horizon = 2.5 * input.spacing;
  input.thickness = 0.7;
  double width = columns * input.spacing;
  if (lattice_case.pattern == Pattern::face_centred) width /= std::numbers::sqrt2;
  double height = width;
  if (lattice_case.pattern == Pattern::hexagonal) height *= 0.5 * std::numbers::sqrt3;
  input.solid = {{{0.0, 0.0, 0.0}, {width, height, width}}};
  input.material = {0};
  return input;
}

inline NetworkInput network_input(const LatticeInput& body) {
  NetworkInput input;
  input.problem = is_plane(body.pattern) ? Problem::plane_stress : Problem::three_dimensional;
  input.horizon = body.horizon;
  input.thickness = body.thickness;
  input.materials = {{30.0, 0.02}};
  return input;
}

/// Returns input that is calibrated as a whole for any size, forced by a face that no bond crosses.
inline NetworkInput in_one_piece(NetworkInput input) {
  input.interfaces.resize(1);
  return input;
}

inline Network make_network(const LatticeCase& lattice_case, int columns) {
  const LatticeInput input = body_input(lattice_case, columns);
  return build_network(make_body(input), network_input(input));
}

inline std::vector<double> random_vector(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<double> result(size);
  for (double& x : result) x = value(generator);
  return result;
}

/// Returns random secants: a third broken, a third on a later segment, a third intact.
inline std::vector<double> random_secants(Index size, unsigned seed) {
  std::vector<double> secants = random_vector(static_cast<std::size_t>(size), seed);
  for (double& a : secants) a = a < -0.3 ? 0.0 : a < 0.3 ? 0.6 : 1.0;
  return secants;
}

/// Returns the displacement of every particle as a linear function of its position, shape
/// (particles, dim).
inline std::vector<double> linear_field(const Particles& particles,
                                        const std::array<Vector3, 3>& gradient) {
  std::vector<double> field;
  for (Index i = 0; i < particles.size(); ++i) {
    for (int row = 0; row < particles.dim; ++row) {
      double value = 0.0;
      for (int col = 0; col < particles.dim; ++col) {
        value += gradient[row][col] * particles.position(i)[col];
      }
      field.push_back(value);
    }
  }
  return field;
}

}  // namespace perilink::test
