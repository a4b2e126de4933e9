#include "axial_bar.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"
#include "network/rigid_modes.hpp"

namespace perilink::verification {
namespace {

// Kip and inch: a plate 100 by 200 and 1 thick, with caps 50 long at both ends that take the load.
constexpr double width = 100.0;
constexpr double length = 200.0;
constexpr double cap = 50.0;
constexpr double thickness = 1.0;
constexpr double youngs_modulus = 3604.0;
constexpr double horizon = 31.45;
constexpr double load = 100.0;

constexpr double stress = load / (width * thickness);
constexpr double exact_strain_y = stress / youngs_modulus;
constexpr double exact_strain_x = exact_strain_y / 3.0;
/// 2 U / P of a bar whose force falls off linearly in the caps, stress / E (length + 2 cap / 3)
/// = 0.064743 in, with the digits that the paper prints and divides by.
constexpr double exact_displacement = 0.06474;

/// Whether a point on an edge of a region counts is decided by BarGrid, not by round-off.
constexpr double on_edge = 1e-6;

double percent(double value, double exact) { return 100.0 * (value / exact - 1.0); }

bool lost(const BarGrid& grid, std::span<const double> x) {
  return (!grid.body_has_top_row && x[1] > length + cap - on_edge) ||
         (!grid.body_has_left_column && x[0] < on_edge);
}

/// Turns the solid particles that the original program lost at the edges into ghosts.
Particles without_lost_particles(const Particles& all, const BarGrid& grid) {
  Particles result;
  result.dim = all.dim;
  for (const ParticleKind wanted : {ParticleKind::solid, ParticleKind::ghost}) {
    for (Index i = 0; i < all.size(); ++i) {
      const auto x = all.position(i);
      const bool solid = all.kind[i] == ParticleKind::solid && !lost(grid, x);
      if (solid != (wanted == ParticleKind::solid)) continue;
      result.positions.insert(result.positions.end(), x.begin(), x.end());
      result.volumes.push_back(all.volumes[i]);
      result.material.push_back(solid ? all.material[i] : no_index);
      result.kind.push_back(wanted);
    }
  }
  return result;
}

Body make_bar(const BarGrid& grid) {
  LatticeInput input;
  input.pattern = grid.pattern;
  input.surface = Surface::ghost;
  input.spacing = width / grid.columns;
  input.horizon = horizon;
  input.thickness = thickness;
  input.solid = {Box{{0.0, -cap, 0.0}, {width, length + cap, 0.0}}};
  input.material = {0};
  Body body = make_body(input);
  body.particles = without_lost_particles(body.particles, grid);
  return body;
}

/// Pulls at both caps, each particle of a cap as strongly as the next.
Loads pull(const Network& network, const BarGrid& grid) {
  const Particles& particles = network.particles;
  std::vector<Index> lower;
  std::vector<Index> upper;
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::ghost) continue;
    const double y = particles.position(i)[1];
    if (y < (grid.load_has_inner_row ? on_edge : -on_edge)) lower.push_back(i);
    if (y > length - on_edge) upper.push_back(i);
  }
  Loads loads;
  loads.forces.assign(2 * static_cast<std::size_t>(particles.size()), 0.0);
  for (const Index i : lower) loads.forces[2 * i + 1] = -load / static_cast<double>(lower.size());
  for (const Index i : upper) loads.forces[2 * i + 1] = load / static_cast<double>(upper.size());
  return loads;
}

/// Rows that are not symmetric leave a small couple. The original program holds the body by equal,
/// very weak springs on all particles, which take the couple as a field of rotation; taken away
/// here, so that the pins take nothing.
void balance_couple(const Particles& particles, Loads& loads) {
  Vector3 centroid{};
  for (Index i = 0; i < particles.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) centroid[axis] += particles.position(i)[axis];
  }
  for (double& x : centroid) x /= particles.size();
  double couple = 0.0;
  double inertia = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    const double x = particles.position(i)[0] - centroid[0];
    const double y = particles.position(i)[1] - centroid[1];
    couple += x * loads.forces[2 * i + 1] - y * loads.forces[2 * i];
    inertia += x * x + y * y;
  }
  for (Index i = 0; i < particles.size(); ++i) {
    loads.forces[2 * i] += couple / inertia * (particles.position(i)[1] - centroid[1]);
    loads.forces[2 * i + 1] -= couple / inertia * (particles.position(i)[0] - centroid[0]);
  }
}

/// Four neighbours per particle leave every row and every column a chain by itself: one end of each
/// is held. Any other lattice is a body with three rigid-body modes.
std::vector<std::uint8_t> hold(const Network& network, double spacing, bool chains) {
  const Particles& particles = network.particles;
  std::vector<std::uint8_t> held(2 * static_cast<std::size_t>(particles.size()), 0);
  if (!chains) {
    for (const Fragment& fragment : find_fragments(network, held)) {
      pin_rigid_modes(network, fragment, held);
    }
    return held;
  }
  for (Index i = 0; i < particles.size(); ++i) {
    held[2 * i] = particles.position(i)[0] < spacing;
    held[2 * i + 1] = particles.position(i)[1] < -cap + on_edge;
  }
  return held;
}

/// Energy of the bonds between solid particles.
double solid_energy(const Network& network, std::span<const double> displacement) {
  double energy = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const Index i = network.bonds.first[b];
    const Index j = network.bonds.second[b];
    if (network.particles.kind[j] == ParticleKind::ghost) continue;
    double elongation = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      elongation += (displacement[2 * j + axis] - displacement[2 * i + axis]) *
                    network.bonds.direction(b)[axis];
    }
    energy += 0.5 * network.stiffness[b] * elongation * elongation;
  }
  return energy;
}

/// Rows and columns of the whole grid, counted from one at its lower left ghost. They start one
/// horizon, rounded up to spacings, outside the body.
struct GridCount {
  int margin;
  int columns;
  int rows;
};

GridCount count_grid(const Lattice& lattice, const BarGrid& grid) {
  const int margin = static_cast<int>(std::ceil(horizon / lattice.spacing));
  const double height = length + 2.0 * (cap + margin * lattice.spacing);
  return {margin, grid.columns + 2 * margin,
          static_cast<int>(std::floor(height / lattice.step[1] + on_edge)) + 1};
}

Index particle_at(const Network& network, const Lattice& lattice, int margin, int column, int row) {
  const bool shifted = lattice.pattern == Pattern::hexagonal && row % 2 == 0;
  const double x = (column - 1 - margin + (shifted ? 1.0 : 0.5)) * lattice.step[0];
  const double y = (row - 1) * lattice.step[1] - cap - margin * lattice.spacing;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto p = network.particles.position(i);
    if (std::abs(p[0] - x) < on_edge && std::abs(p[1] - y) < on_edge) return i;
  }
  throw std::invalid_argument("no particle where the strain is to be measured");
}

/// The particle in the middle and its neighbours in the same column and the same row of the grid.
struct Cross {
  Index middle;
  std::array<Index, 2> before;  ///< left, below
  std::array<Index, 2> after;   ///< right, above
};

/// Column and row of the middle are the whole grid's; which row was read off the printed strains.
Cross find_cross(const Network& network, const Lattice& lattice, const BarGrid& grid) {
  const GridCount count = count_grid(lattice, grid);
  const int column = (count.columns + 1) / 2;
  const int row = (grid.pattern == Pattern::hexagonal ? (count.rows + 3) / 2 : count.rows / 2) +
                  (grid.centre_row_above ? 1 : 0);
  const auto at = [&](int right, int up) {
    return particle_at(network, lattice, count.margin, column + right, row + up);
  };
  return {at(0, 0), {at(-1, 0), at(0, -1)}, {at(1, 0), at(0, 1)}};
}

/// Central difference of the displacement along an axis. In the hexagonal pattern the particles of
/// a column lie half a spacing aside in every second row: the strain along y is taken there.
double strain(const Cross& cross, const Lattice& lattice, std::span<const double> displacement,
              int axis) {
  return (displacement[2 * cross.after[axis] + axis] -
          displacement[2 * cross.before[axis] + axis]) /
         (2.0 * lattice.step[axis]);
}

Index count_links(const Network& network, Index particle) {
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  return static_cast<Index>(neighbourhoods.row(particle).size());
}

}  // namespace

BarErrors solve_bar(const BarGrid& grid) {
  const Body body = make_bar(grid);
  NetworkInput input;
  input.horizon = horizon;
  input.thickness = thickness;
  input.materials = {SolidMaterial{.youngs_modulus = youngs_modulus}};
  const Network network = build_network(body, input);
  const Cross cross = find_cross(network, body.lattice, grid);
  const Index links = count_links(network, cross.middle);

  Loads loads = pull(network, grid);
  balance_couple(network.particles, loads);
  const std::vector<std::uint8_t> held = hold(network, body.lattice.spacing, links == 4);
  const Unknowns unknowns = number_unknowns(2, held, std::vector<double>(held.size(), 0.0));
  const ElasticResult result = run_elastic_analysis({network, unknowns, loads, {}});

  const double strain_x = strain(cross, body.lattice, result.displacement, 0);
  const double strain_y = strain(cross, body.lattice, result.displacement, 1);
  BarErrors errors;
  errors.strain_x = percent(-strain_x, exact_strain_x);
  errors.strain_y = percent(strain_y, exact_strain_y);
  errors.poissons_ratio = percent(-strain_x / strain_y, 1.0 / 3.0);
  errors.displacement =
      percent(2.0 * solid_energy(network, result.displacement) / load, exact_displacement);
  errors.whole_displacement = percent(2.0 * result.strain_energy / load, exact_displacement);
  errors.links = links;
  return errors;
}

}  // namespace perilink::verification
