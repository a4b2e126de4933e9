#include "clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/dynamics/fundamental_period.hpp"
#include "analysis/dynamics/inertia.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/lattices/triangulate.hpp"

namespace perilink::verification {
namespace {

constexpr double density = 2323.0;    // kg/m^3
constexpr double extension = 2.5e-4;  // m, more than the critical opening
constexpr Index unbreakable = 1;      // material

bool is_plane(const UnstructuredParticles& particle_set) {
  return particle_set.problem != Problem::three_dimensional;
}

double section(const UnstructuredParticles& particle_set) {
  return particle_set.width *
         (is_plane(particle_set) ? particle_set.thickness : particle_set.width);
}

LatticeInput lattice_of(const UnstructuredParticles& particle_set) {
  LatticeInput input;
  input.pattern = !is_plane(particle_set) ? Pattern::cubic
                  : particle_set.square   ? Pattern::rectangular
                                          : Pattern::hexagonal;
  input.spacing = particle_set.spacing;
  input.thickness = is_plane(particle_set) ? particle_set.thickness : 1.0;
  const double depth = is_plane(particle_set) ? 0.0 : particle_set.width;
  input.solid = {{{0.0, 0.0, 0.0}, {particle_set.width, particle_set.length, depth}}};
  input.material = {0};
  return input;
}

/// Whether a coordinate lies on a face of the bar.
bool is_on_face(const UnstructuredParticles& particle_set, double x, int axis) {
  const double extent = axis == 1 ? particle_set.length : particle_set.width;
  return x < 1e-9 * extent || x > (1.0 - 1e-9) * extent;
}

void scatter(const UnstructuredParticles& particle_set, Body& body) {
  std::mt19937 random(11);
  // Not a distribution of the library, whose numbers depend on its maker.
  const auto any = [&random] { return 2.0 * (static_cast<double>(random()) / 4294967295.0) - 1.0; };
  Particles& particles = body.particles;
  for (Index i = 0; i < particles.size(); ++i) {
    for (int axis = 0; axis < particles.dim; ++axis) {
      double& x = particles.positions[static_cast<std::size_t>(i) * particles.dim + axis];
      const double shift = particle_set.scatter * particle_set.spacing * any();
      if (!is_on_face(particle_set, x, axis)) x += shift;
    }
  }
}

}  // namespace

ParticleNetwork build(const UnstructuredParticles& particle_set) {
  const LatticeInput input = lattice_of(particle_set);
  Body body = make_body(input);
  body.cells = triangulate(input, body);
  scatter(particle_set, body);
  const std::vector<double> volumes =
      cell_volumes(body.cells, body.particles.positions, input.thickness);
  double sum = 0.0;
  for (const double volume : volumes) sum += std::abs(volume);
  if (std::abs(sum / (section(particle_set) * particle_set.length) - 1.0) > 1e-9) {
    throw std::runtime_error("particles are scattered so far that cells overlap");
  }
  if (is_plane(particle_set)) {
    body.facets = facets_of(body.cells, body.particles.positions, particle_set.thickness);
  }
  for (Index i = 0; i < body.particles.size(); ++i) {
    const double y = body.particles.position(i)[1] / particle_set.length;
    body.particles.material[i] = y < 0.35 || y > 0.65 ? unbreakable : 0;
  }
  const std::vector<IsotropicMaterial> materials(2, {youngs_modulus, poissons_ratio});
  return make_particle_network(body, particle_set.problem, materials, particle_set.thickness);
}

Unknowns pull(const UnstructuredParticles& particle_set, const Network& network, double by) {
  const std::size_t dim = network.dim(), slots = network.particles.positions.size();
  std::vector<std::uint8_t> held(slots, 0);
  std::vector<double> value(slots, 0.0);
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    const std::size_t slot = i * dim;
    if (is_on_face(particle_set, x[1], 1)) {
      held[slot + 1] = 1;
      if (x[1] > 0.5 * particle_set.length) value[slot + 1] = by;
    }
    // A corner and, in space, the other ends of the edges from it stop the rest.
    const auto at = [&](double a, double c) {
      return std::abs(x[0] - a) < 1e-9 && x[1] < 1e-9 && (dim == 2 || std::abs(x[2] - c) < 1e-9);
    };
    if (at(0.0, 0.0)) {
      held[slot] = 1;
      if (dim == 3) held[slot + 2] = 1;
    }
    if (dim == 3 && at(particle_set.width, 0.0)) held[slot + 2] = 1;
  }
  return number_unknowns(static_cast<int>(dim), held, value);
}

Stretching stretch(const UnstructuredParticles& particle_set, const ParticleNetwork& built) {
  const Network& network = built.network;
  const double by = 1e-3 * particle_set.length;
  const Unknowns unknowns = pull(particle_set, network, by);
  const Loads loads{std::vector<double>(unknowns.number.size(), 0.0)};
  const ElasticResult result = run_elastic_analysis({network, unknowns, loads, {}});
  Stretching found;
  found.modulus = 2.0 * result.strain_energy * particle_set.length /
                  (youngs_modulus * section(particle_set) * by * by);
  const std::size_t dim = network.dim();
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    for (std::size_t c = 0; c < dim; ++c) {
      const double exact = c == 1 ? 1e-3 * x[1] : -poissons_ratio * 1e-3 * x[c];
      const double error = std::abs(result.displacement[i * dim + c] - exact) / by;
      found.displacement = std::max(found.displacement, error);
    }
  }
  return found;
}

ExplicitResult tear(const UnstructuredParticles& particle_set, const ParticleNetwork& built) {
  const Network& network = built.network;
  const Unknowns unknowns = pull(particle_set, network, extension);
  const Loads loads{std::vector<double>(unknowns.number.size(), 0.0)};
  const Inertia inertia = lumped_inertia(network, std::vector{density, density});
  const double period = fundamental_period(network, unknowns, inertia);
  BondRunRules rules;
  rules.damping_rate = 0.1 * 2.0 * 6.283 / period;  // a tenth of critical, slowest vibration
  StateMaterial material;
  material.youngs_modulus = youngs_modulus;
  material.poissons_ratio = poissons_ratio;
  rules.states = {particle_set.problem, particle_set.thickness, {material, material}};
  rules.states.materials[0].breakable = true;
  rules.states.materials[0].softening = {strength, 0.25, 2e-5, 2e-4};
  ExplicitOptions options;
  options.duration = 60.0 * period;
  options.ramp = options.duration;
  options.safety = 0.3;
  ReferenceLoad reference;
  reference.driven = true;
  reference.value = extension;
  BondRunObserver observer;
  return run_explicit_bonds({network, unknowns, loads, reference}, inertia, rules, options,
                            observer);
}

}  // namespace perilink::verification
