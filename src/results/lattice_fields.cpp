#include "results/lattice_fields.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "analysis/dynamics/lattice/lattice_flow.hpp"
#include "results/field_file.hpp"

namespace perilink {
namespace {

/// Returns a vector field of slots as rows of three numbers per particle.
std::vector<double> vectors_of(const LatticeRows& lattice, const std::vector<double>& field) {
  std::vector<double> vectors(3 * lattice.particle_slot.size(), 0.0);
  for (std::size_t i = 0; i < lattice.particle_slot.size(); ++i) {
    for (int c = 0; c < lattice.dim; ++c) {
      vectors[3 * i + c] = field[lattice.at(c, lattice.particle_slot[i])];
    }
  }
  return vectors;
}

std::vector<double> numbers_of(const LatticeRows& lattice, const std::vector<double>& field) {
  std::vector<double> numbers;
  numbers.reserve(lattice.particle_slot.size());
  for (const Index slot : lattice.particle_slot) numbers.push_back(field[slot]);
  return numbers;
}

/// Returns the stresses of each particle in the order xx, yy, zz, xy, yz, zx.
std::vector<double> stresses(const ExplicitModel& model, const ExplicitState& state) {
  const LatticeParticles particles(model);
  std::vector<double> values;
  values.reserve(6 * model.lattice.particle_slot.size());
  for_each_particle(model.lattice, [&](Index row, Index slot) {
    const SymmetricTensor stress =
        particles.stress(state, particles.neighbourhood(state, row, slot));
    values.insert(values.end(), stress.begin(), stress.end());
  });
  return values;
}

std::vector<double> plastic_strains(const ExplicitModel& model, const ExplicitState& state) {
  const LatticeParticles particles(model);
  const LatticeYielding yielding(model, particles);
  std::vector<double> values;
  for_each_particle(model.lattice, [&](Index row, Index slot) {
    values.push_back(yielding.plastic_strain(state, row, slot));
  });
  return values;
}

/// Returns cracked particles in the order in which their damage began; of one step by slot number.
std::vector<Index> cracked_particles(const LatticeRows& lattice, const ExplicitState& state) {
  std::vector<Index> cracked;
  const auto step = [&](Index i) { return state.cracked_in[lattice.particle_slot[i]]; };
  for (Index i = 0; i < lattice.particles(); ++i) {
    if (state.damage[lattice.particle_slot[i]] > 0.0) cracked.push_back(i);
  }
  std::stable_sort(cracked.begin(), cracked.end(),
                   [&](Index a, Index b) { return step(a) < step(b); });
  return cracked;
}

void append_vertices(VtuGrid& grid, Index count) {
  for (Index i = 0; i < count; ++i) {
    grid.types.push_back(VtuCell::vertex);
    grid.connectivity.push_back(i);
    grid.offsets.push_back(i + 1);
  }
  const auto cells = static_cast<std::size_t>(count);
  grid.cell_data = {
      {"element", 1, std::vector<double>(cells, static_cast<double>(FieldElement::particle))},
      {"broken_at", 1, std::vector<double>(cells, 0.0)}};
}

}  // namespace

VtuGrid make_lattice_grid(const ExplicitModel& model, const ExplicitState& state,
                          const ExplicitRecord& record) {
  const LatticeRows& lattice = model.lattice;
  const std::size_t count = lattice.particle_slot.size();
  VtuGrid grid;
  grid.points = vectors_of(lattice, lattice.positions);
  append_vertices(grid, lattice.particles());
  number_cracks(grid, cracked_particles(lattice, state));
  grid.point_data = {
      {"displacement", 3, vectors_of(lattice, state.displacement)},
      {"velocity", 3, vectors_of(lattice, state.velocity)},
      {"damage", 1, numbers_of(lattice, state.damage)},
      {"region", 1, std::vector<double>(count, 0.0)},
      {"kind", 1, std::vector<double>(count, 0.0)},
      {"volume", 1, numbers_of(lattice, model.volume)},
  };
  if (!model.material.breakable) {
    grid.point_data.push_back({"stress", 6, stresses(model, state)});
  }
  if (model.material.yields) {
    grid.point_data.push_back({"plastic_strain", 1, plastic_strains(model, state)});
  }
  grid.field_data = {{"step", static_cast<double>(record.step)},
                     {"time", record.time},
                     {"load_factor", record.load_factor},
                     {"load", record.load},
                     {"dimension", static_cast<double>(lattice.dim)},
                     {"spacing", lattice.spacing}};
  if (lattice.dim == 2) grid.field_data.push_back({"thickness", model.thickness});
  return grid;
}

}  // namespace perilink
