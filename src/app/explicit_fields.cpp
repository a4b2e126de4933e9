#include "app/explicit_fields.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "app/field_file.hpp"

namespace perilink {
namespace {

/// A vector field of slots as rows of three numbers, one for each particle.
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

/// Adds a bond of a particle of an unbreakable body to its stress, (1 / 2V) L F n n'.
void add_bond(const ExplicitModel& model, int k, double force, double volume, double* stress) {
  constexpr std::array<std::array<int, 2>, 6> axes = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  const OwnBond& bond = model.lattice.bonds[k];
  const double share = 0.5 * bond.length * force / volume;
  for (std::size_t c = 0; c < axes.size(); ++c) {
    stress[c] += share * bond.direction[axes[c][0]] * bond.direction[axes[c][1]];
  }
}

/// Six components for each particle of an unbreakable body.
std::vector<double> stresses(const ExplicitModel& model, const ExplicitState& state) {
  const LatticeRows& lattice = model.lattice;
  const int own = lattice.own_bonds();
  std::vector<double> values(6 * lattice.particle_slot.size(), 0.0);
  std::size_t row = 0;
  for (std::size_t i = 0; i < lattice.particle_slot.size(); ++i) {
    const Index slot = lattice.particle_slot[i];
    while (slot >= lattice.rows[row].first + lattice.rows[row].size) ++row;
    double* stress = values.data() + 6 * i;
    for (int k = 0; k < own; ++k) {
      for (const Index owner : {slot, slot - lattice.shift_in[row * own + k]}) {
        const Index at = lattice.at(k, owner);
        if (lattice.present[at] == 0.0) continue;
        const double force =
            model.own_modulus(k) * state.stretch[at] + model.moduli.sum * state.sum[slot];
        add_bond(model, k, force, model.volume[slot], stress);
      }
    }
    if (model.problem == Problem::plane_strain) {
      stress[2] = model.material.poissons_ratio * (stress[0] + stress[1]);
    }
  }
  return values;
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
