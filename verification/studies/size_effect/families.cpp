#include "families.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/internal_force.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink::verification {
namespace {

/// A particle and its bonds, without their constants.
Network make_star(const Particles& all, std::span<const double> center, double volume,
                  std::span<const Index> neighbors) {
  Network star;
  Particles& particles = star.particles;
  particles.dim = star.bonds.dim = all.dim;
  const auto append = [&](std::span<const double> position, double own_volume) {
    particles.positions.insert(particles.positions.end(), position.begin(), position.end());
    particles.volumes.push_back(own_volume);
  };
  append(center, volume);
  for (const Index j : neighbors) append(all.position(j), all.volumes[j]);
  for (Index b = 0; b < static_cast<Index>(neighbors.size()); ++b) {
    star.bonds.append(particles, 0, b + 1);
  }
  star.first_slip_spring = star.first_bar_element = star.bonds.size();
  return star;
}

/// k = c V V / xi and 12 d V V / xi^3, as build_network() has them (the test of this study
/// compares).
void set_constants(const MicropolarModuli& moduli, Network& star) {
  star.stiffness.clear();
  star.bending.clear();
  for (Index b = 0; b < star.bonds.size(); ++b) {
    const double xi = star.bonds.lengths[b];
    const double volumes = star.particles.volumes[0] * star.particles.volumes[b + 1];
    star.stiffness.push_back(moduli.micromodulus * volumes / xi);
    star.bending.push_back(12.0 * moduli.bending_modulus * volumes / (xi * xi * xi));
  }
}

/// From the energies of strains in one direction and in two.
LayerStiffness stiffness_of(const Network& star) {
  const std::vector<double> intact(star.stiffness.size(), 1.0);
  InternalForce result;
  const auto density = [&](const Vector3& strain) {
    internal_force(star, intact, homogeneous_motion(star, strain), result);
    return 0.5 * result.energy / star.particles.volumes[0];
  };
  LayerStiffness stiffness;
  stiffness.c11 = 2.0 * density({1.0, 0.0, 0.0});
  stiffness.c22 = 2.0 * density({0.0, 1.0, 0.0});
  stiffness.c12 = density({1.0, 1.0, 0.0}) - 0.5 * (stiffness.c11 + stiffness.c22);
  if (star.dim() == 3) stiffness.c23 = density({0.0, 1.0, 1.0}) - stiffness.c22;
  return stiffness;
}

LayerStiffness combine(double a, const LayerStiffness& first, double b,
                       const LayerStiffness& second) {
  return {a * first.c11 + b * second.c11, a * first.c12 + b * second.c12,
          a * first.c22 + b * second.c22, a * first.c23 + b * second.c23};
}

}  // namespace

Body half_space_body(Problem problem, int horizon_ratio) {
  const bool plane = problem == Problem::plane_stress;
  LatticeInput input;
  input.pattern = plane ? Pattern::rectangular : Pattern::cubic;
  input.spacing = 1.0 / horizon_ratio;
  input.horizon = 1.0;
  const double side = 1.0 + input.spacing;
  const double depth = 2.0 + 3.0 * input.spacing;
  input.solid = {Box{{0.0, -side, plane ? 0.0 : -side}, {depth, side, plane ? 0.0 : side}}};
  input.material = {0};
  return make_body(input);
}

NetworkInput half_space_constants(Problem problem, double poissons_ratio) {
  NetworkInput input;
  input.problem = problem;
  input.model = BondModel::micropolar;
  input.horizon = 1.0;
  input.materials = {SolidMaterial{.youngs_modulus = 1.0, .poissons_ratio = poissons_ratio}};
  return input;
}

std::vector<double> homogeneous_motion(const Network& network, const Vector3& strain) {
  const int dim = network.dim(), width = network.width();
  std::vector<double> motion(static_cast<std::size_t>(network.particles.size()) * width, 0.0);
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (int a = 0; a < dim; ++a) {
      motion[static_cast<std::size_t>(i) * width + a] =
          strain[a] * network.particles.position(i)[a];
    }
  }
  return motion;
}

std::vector<std::vector<LayerStiffness>> neighbourhood_stiffness(const NeighbourhoodInput& input) {
  const Body body = half_space_body(input.problem, input.horizon_ratio);
  const Particles& particles = body.particles;
  const auto dim = static_cast<std::size_t>(particles.dim);
  std::vector<double> column;
  for (const int row : input.rows) {
    column.insert(column.end(), {row * body.lattice.step[0], 0.0, 0.0});
    column.resize(column.size() + dim - 3);
  }
  const Csr within =
      find_neighbors(particles.positions, column, particles.dim, 1.0 + horizon_tolerance);
  std::vector<std::vector<LayerStiffness>> result;
  for (Index row = 0; row < within.rows(); ++row) {
    const std::span<const double> center(column.data() + row * dim, dim);
    double volume = 0.0;
    std::vector<Index> neighbors;
    for (const Index j : within.row(row)) {
      double square = 0.0;
      for (std::size_t a = 0; a < dim; ++a) {
        square += std::pow(particles.position(j)[a] - center[a], 2);
      }
      if (std::sqrt(square) > 0.5 * body.lattice.spacing) {
        neighbors.push_back(j);
      } else {
        volume = particles.volumes[j];  // the particle itself
      }
    }
    Network star = make_star(particles, center, volume, neighbors);
    result.emplace_back();
    for (const double ratio : input.poissons_ratios) {
      const NetworkInput constants = half_space_constants(input.problem, ratio);
      set_constants(moduli_of(body, constants, constants.materials[0]), star);
      result.back().push_back(stiffness_of(star));
    }
  }
  return result;
}

LayerStiffness plate_of_neighbourhoods(Problem problem, int horizon_ratio, int rows,
                                       double poissons_ratio) {
  NeighbourhoodInput input{problem, horizon_ratio, {}, {poissons_ratio}};
  const int inside = horizon_ratio + 1;  // the first row whose bonds do not reach the surface
  for (int row = 0; row <= inside; ++row) input.rows.push_back(row);
  const auto neighbourhoods = neighbourhood_stiffness(input);
  const auto at = [&](int row) { return neighbourhoods[std::min(row, inside)][0]; };
  LayerStiffness mean;
  for (int row = 0; row <= rows; ++row) {
    const double share = (row == 0 || row == rows ? 0.5 : 1.0) / rows;
    const LayerStiffness both = combine(1.0, at(row), 1.0, at(rows - row));
    mean = combine(1.0, mean, share, combine(1.0, both, -1.0, at(inside)));
  }
  return mean;
}

}  // namespace perilink::verification
