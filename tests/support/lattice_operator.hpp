#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/dynamics/lattice/lattice_changes.hpp"
#include "analysis/dynamics/lattice/rows/row_energy.hpp"
#include "analysis/dynamics/lattice/rows/row_kernels.hpp"

/// \file
/// Forces and energies of a lattice body as functions of its displacements.

namespace perilink::testing_support {

/// Computes stretches, sums and forces from the displacements of a state without velocity.
inline void evaluate(const ExplicitModel& model, ExplicitState& state) {
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (Index r = 0; r < rows; ++r) measure_bonds(model, state, r, 0.0);
  for (Index r = 0; r < rows; ++r) sum_stretches(model, state, r);
  for (Index r = 0; r < rows; ++r) state.sums[r].stored = half_step_energy(model, state, r, 0.0);
  for (Index r = 0; r < rows; ++r) bond_forces(model, state, r);
  std::fill(state.slack.begin(), state.slack.end(), 0.0);
}

/// Weakens some bonds, differently in tension and compression. The consistent rules also get
/// separate weights in the sums.
inline void weaken(const ExplicitModel& model, ExplicitState& state) {
  for (std::size_t k = 0; k < state.in_tension.size(); ++k) {
    const auto number = static_cast<double>(k);
    state.in_tension[k] *= 0.5 + 0.5 * std::sin(0.7 * number);
    state.in_compression[k] *= 0.8 + 0.2 * std::cos(1.3 * number);
    state.share_tension[k] = 1.0 + 0.5 * std::sin(0.3 * number);
    state.share_compression[k] = 1.0 + 0.2 * std::cos(0.9 * number);
  }
  for (std::size_t slot = 0; slot < state.root_tension.size(); ++slot) {
    if (model.rules != LatticeRules::consistent) break;
    state.root_tension[slot] = 0.6 + 0.4 * std::sin(1.1 * static_cast<double>(slot));
    state.root_compression[slot] = 0.8 + 0.2 * std::cos(1.7 * static_cast<double>(slot));
  }
  for (std::uint8_t& bond_changes : state.bond_changes)
    bond_changes |= BondChanges::altered | BondChanges::weakened;
}

/// Applies damage and flow of a step, pass after pass over all rows.
inline void change(const ExplicitModel& model, const LatticeChanges& changes, ExplicitState& state,
                   double time_step) {
  const auto each_row = [&](const auto& work) {
    for (Index r = 0; r < static_cast<Index>(model.lattice.rows.size()); ++r) work(r);
  };
  each_row([&](Index r) { changes.look(state, r); });
  each_row([&](Index r) { changes.commit(state, r, time_step); });
  each_row([&](Index r) { changes.update_plastic_bonds(state, r); });
  each_row([&](Index r) { changes.update_plastic_sums(state, r, time_step); });
  each_row([&](Index r) { changes.update_factors(state, r); });
  each_row([&](Index r) { changes.update_sums(state, r, time_step); });
}

/// Applies damage and flow of a step of zero length, after evaluate().
inline void change(const ExplicitModel& model, const LatticeChanges& changes,
                   ExplicitState& state) {
  change(model, changes, state, 0.0);
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (Index r = 0; r < rows; ++r) state.sums[r].stored = half_step_energy(model, state, r, 0.0);
}

inline double stored_energy(const ExplicitState& state) {
  double energy = 0.0;
  for (const RowSums& row : state.sums) energy += row.stored;
  return energy;
}

/// Returns the sum of the bond forces on every particle, shape (dim, slots).
inline std::vector<double> resultants(const ExplicitModel& model, const ExplicitState& state) {
  const LatticeRows& lattice = model.lattice;
  std::vector<double> total(state.displacement.size(), 0.0);
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (int k = 0; k < lattice.own_bonds(); ++k) {
      for (Index i = 0; i < lattice.rows[r].size; ++i) {
        const Index slot = lattice.rows[r].first + i;
        if (lattice.present[lattice.at(k, slot)] == 0.0) continue;
        const Index partner = slot + lattice.shift_out[r * lattice.bonds.size() + k];
        for (int c = 0; c < lattice.dim; ++c) {
          const double force = state.now.force[lattice.at(k * lattice.dim + c, slot)];
          total[lattice.at(c, slot)] += force;
          total[lattice.at(c, partner)] -= force;
        }
      }
    }
  }
  return total;
}

/// Returns a lower estimate of the largest eigenvalue of M^-1 K by power iteration.
inline double highest_frequency_squared(const ExplicitModel& model) {
  ExplicitState state(model);
  const LatticeRows& lattice = model.lattice;
  const double size = 1e-9 * lattice.spacing;  // small enough for linear response
  std::vector<double> shape(state.displacement.size(), 0.0);
  for (const Index slot : lattice.particle_slot) {
    for (int c = 0; c < lattice.dim; ++c) shape[lattice.at(c, slot)] = std::sin(3.7 * slot + c);
  }
  double value = 0.0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    double largest = 0.0;
    for (const double entry : shape) largest = std::max(largest, std::abs(entry));
    for (double& entry : shape) entry /= largest;
    for (std::size_t k = 0; k < shape.size(); ++k) state.displacement[k] = size * shape[k];
    evaluate(model, state);
    const std::vector<double> force = resultants(model, state);
    double up = 0.0, down = 0.0;
    for (const Index slot : lattice.particle_slot) {
      for (int c = 0; c < lattice.dim; ++c) {
        const Index at = lattice.at(c, slot);
        up -= force[at] / size * shape[at];
        down += model.mass[slot] * shape[at] * shape[at];
        shape[at] = -force[at] / size * model.inverse_mass[slot];
      }
    }
    value = up / down;
  }
  return value;
}

}  // namespace perilink::testing_support
