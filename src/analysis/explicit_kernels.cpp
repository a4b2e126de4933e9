#include "analysis/explicit_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// An array of a slot-shaped field, from the first slot of a row.
const double* at(const std::vector<double>& field, const LatticeRows& lattice, Index part,
                 const LatticeRow& row) {
  return field.data() + static_cast<std::size_t>(part) * lattice.slots + row.first;
}
double* at(std::vector<double>& field, const LatticeRows& lattice, Index part,
           const LatticeRow& row) {
  return field.data() + static_cast<std::size_t>(part) * lattice.slots + row.first;
}

/// Bond vector of unit reference length: n + du / L. Elongation without cancellation:
/// |y|^2 - 1 = 2 n.du/L + |du/L|^2 = e, |y| - 1 = e / (1 + sqrt(1 + e)).
template <int Dim>
double measure_bond(const ExplicitModel& model, ExplicitState& state, Index r, int k, double dt) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const Index shift = lattice.shift_out[r * lattice.own_bonds() + k];
  const Vector3 n = lattice.bonds[k].direction;
  const double scale = 1.0 / lattice.bonds[k].length;
  const double *u[Dim], *v[Dim];
  double* y[Dim];
  for (int c = 0; c < Dim; ++c) {
    u[c] = at(state.displacement, lattice, c, row);
    v[c] = at(state.velocity, lattice, c, row);
    y[c] = at(state.direction, lattice, k * Dim + c, row);
  }
  double* stretch = at(state.stretch, lattice, k, row);
  double* effective = at(state.effective, lattice, k, row);
  double* rate = at(state.rate, lattice, k, row);
  const double* drag = at(state.drag, lattice, k, row);
  const double* tension = at(state.in_tension, lattice, k, row);
  const double* compression = at(state.in_compression, lattice, k, row);
  double loss = 0.0;
#pragma omp simd reduction(+ : loss)
  for (Index i = 0; i < row.size; ++i) {
    double change[Dim];
    double along = 0.0, square = 0.0;
    for (int c = 0; c < Dim; ++c) {
      change[c] = (u[c][i + shift] - u[c][i]) * scale;
      along += n[c] * change[c];
      square += change[c] * change[c];
    }
    const double excess = 2.0 * along + square;
    const double length = std::sqrt(1.0 + excess);
    const double share = 1.0 / ((1.0 + length) * length);  // one division for two quotients
    const double s = excess * length * share;
    const double shorten = (1.0 + length) * share;
    double speed = 0.0;
    for (int c = 0; c < Dim; ++c) {
      const double direction = (n[c] + change[c]) * shorten;
      y[c][i] = direction;
      speed += direction * (v[c][i + shift] - v[c][i]);
    }
    stretch[i] = s;
    effective[i] = s * (s >= 0.0 ? tension[i] : compression[i]);
    loss += 0.5 * dt * drag[i] * (rate[i] + speed);
    rate[i] = speed;
  }
  return loss;
}

template <LatticeRules Rules>
void force_bond(const ExplicitModel& model, ExplicitState& state, Index r, int k) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const Index shift = lattice.shift_out[r * lattice.own_bonds() + k];
  const double own = model.own_modulus(k), modulus = model.moduli.sum;
  const double damping = model.bond_damping;
  const double* stretch = at(state.stretch, lattice, k, row);
  const double* effective = at(state.effective, lattice, k, row);
  const double* tension = at(state.in_tension, lattice, k, row);
  const double* compression = at(state.in_compression, lattice, k, row);
  const double* present = at(lattice.present, lattice, k, row);
  const double* rate = at(state.rate, lattice, k, row);
  const double* sum = at(state.sum, lattice, 0, row);
  double* drag = at(state.drag, lattice, k, row);
  double* magnitude = at(state.force, lattice, k * lattice.dim, row);
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    const double factor = stretch[i] >= 0.0 ? tension[i] : compression[i];
    const double here = modulus * sum[i], there = modulus * sum[i + shift];
    double force = own * effective[i];
    if constexpr (Rules == LatticeRules::consistent) {
      force += factor * 0.5 * (here + there);
    } else if constexpr (Rules == LatticeRules::mean_2017) {
      force = present[i] * (force + 0.5 * (here + there));
    } else {
      const double mine = force + here, other = force + there;
      const double smaller = std::abs(mine) < std::abs(other) ? mine : other;
      force = present[i] * (mine * other > 0.0 ? smaller : 0.5 * (mine + other));
    }
    drag[i] = damping * factor * rate[i];
    magnitude[i] = force + drag[i];
  }
  for (int c = lattice.dim - 1; c >= 0; --c) {
    double* component = at(state.force, lattice, k * lattice.dim + c, row);
    const double* direction = at(state.direction, lattice, k * lattice.dim + c, row);
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) component[i] = magnitude[i] * direction[i];
  }
}

/// New velocity of one component of a row, before prescribed motions.
void accelerate(const ExplicitModel& model, const ExplicitState& state, Index r, int c, double dt,
                double* speed) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double* velocity = at(state.velocity, lattice, c, row);
  const double* inverse_mass = at(model.inverse_mass, lattice, 0, row);
  std::fill(speed, speed + row.size, 0.0);
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const double* out = at(state.force, lattice, k * lattice.dim + c, row);
    const double* in = out - lattice.shift_in[r * lattice.own_bonds() + k];
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) speed[i] += out[i] - in[i];
  }
  const double keep = 1.0 - dt * model.mass_damping;
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    speed[i] = keep * velocity[i] + dt * inverse_mass[i] * speed[i];
  }
}

}  // namespace

void measure_bonds(const ExplicitModel& model, ExplicitState& state, Index row, double time_step) {
  double loss = 0.0;
  for (int k = 0; k < model.lattice.own_bonds(); ++k) {
    loss += model.lattice.dim == 2 ? measure_bond<2>(model, state, row, k, time_step)
                                   : measure_bond<3>(model, state, row, k, time_step);
  }
  state.sums[row].internal_damping += loss;
}

void apply_factors(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRow& row = model.lattice.rows[r];
  for (int k = 0; k < model.lattice.own_bonds(); ++k) {
    const double* stretch = at(state.stretch, model.lattice, k, row);
    const double* tension = at(state.in_tension, model.lattice, k, row);
    const double* compression = at(state.in_compression, model.lattice, k, row);
    double* effective = at(state.effective, model.lattice, k, row);
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
      effective[i] = stretch[i] * (stretch[i] >= 0.0 ? tension[i] : compression[i]);
    }
  }
}

void sum_stretches(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  double* sum = at(state.sum, lattice, 0, row);
  std::fill(sum, sum + row.size, 0.0);
  double energy = 0.0;
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const double weight = lattice.bonds[k].length / lattice.spacing;
    const double half = 0.5 * lattice.bonds[k].length * model.own_modulus(k);
    const double* out = at(state.effective, lattice, k, row);
    const double* in = out - lattice.shift_in[r * lattice.own_bonds() + k];
    const double* stretch = at(state.stretch, lattice, k, row);
#pragma omp simd reduction(+ : energy)
    for (Index i = 0; i < row.size; ++i) {
      sum[i] += weight * (out[i] + in[i]);
      energy += half * out[i] * stretch[i];
    }
  }
  const double quarter = 0.25 * lattice.spacing * model.moduli.sum;
#pragma omp simd reduction(+ : energy)
  for (Index i = 0; i < row.size; ++i) energy += quarter * sum[i] * sum[i];
  state.sums[r].stored = energy;
}

void bound_tension(const ExplicitModel& model, ExplicitState& state, Index r) {
  // n n' has the eigenvalues 1 and 0: no principal stress exceeds the sum of pulling bonds.
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double* sum = at(state.sum, lattice, 0, row);
  const double* volume = at(model.volume, lattice, 0, row);
  double largest = 0.0;
  if (lattice.dim != 2) return;  // damage is for bodies in the plane
  const double *out[3], *in[3], *out_present[3], *in_present[3];
  for (int k = 0; k < 3; ++k) {
    const Index shift = lattice.shift_in[r * 3 + k];
    out[k] = at(state.effective, lattice, k, row);
    out_present[k] = at(lattice.present, lattice, k, row);
    in[k] = out[k] - shift;
    in_present[k] = out_present[k] - shift;
  }
  const double own = model.moduli.own, half = 0.5 * lattice.spacing;
#pragma omp simd reduction(max : largest)
  for (Index i = 0; i < row.size; ++i) {
    const double shared = model.moduli.sum * sum[i];
    double pull = 0.0;
    for (int k = 0; k < 3; ++k) {
      pull += out_present[k][i] * std::max(0.0, own * out[k][i] + std::max(0.0, shared));
      pull += in_present[k][i] * std::max(0.0, own * in[k][i] + std::max(0.0, shared));
    }
    largest = std::max(largest, half * pull / volume[i]);
  }
  state.tension_bound[r] = largest;
}

void bond_forces(const ExplicitModel& model, ExplicitState& state, Index row) {
  for (int k = 0; k < model.lattice.own_bonds(); ++k) {
    switch (model.rules) {
      case LatticeRules::consistent:
        force_bond<LatticeRules::consistent>(model, state, row, k);
        break;
      case LatticeRules::mean_2017:
        force_bond<LatticeRules::mean_2017>(model, state, row, k);
        break;
      case LatticeRules::least_2018:
        force_bond<LatticeRules::least_2018>(model, state, row, k);
        break;
    }
  }
}

void advance(const ExplicitModel& model, ExplicitState& state, Index r, double time_step,
             double load_increment) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  thread_local std::vector<double> buffer;
  buffer.resize(row.size);
  double* speed = buffer.data();
  const double* mass = at(model.mass, lattice, 0, row);
  RowReactions reactions;
  double loss = 0.0;
  for (int c = 0; c < lattice.dim; ++c) {
    accelerate(model, state, r, c, time_step, speed);
    double* velocity = at(state.velocity, lattice, c, row);
    double* displacement = at(state.displacement, lattice, c, row);
    for (const PrescribedMotion& motion : model.prescribed[r]) {
      if (motion.component != c) continue;
      const Index i = motion.slot - row.first;
      const double wanted = motion.amplitude * load_increment / time_step;
      const double reaction = mass[i] * (wanted - speed[i]) / time_step;
      speed[i] = wanted;
      state.sums[r].external_work += 0.5 * time_step * reaction * (wanted + velocity[i]);
      reactions.driven += reaction * motion.amplitude;
      if (motion.amplitude == 0.0 && c == model.load_component) reactions.supports += reaction;
    }
#pragma omp simd reduction(+ : loss)
    for (Index i = 0; i < row.size; ++i) {
      loss += mass[i] * velocity[i] * (velocity[i] + speed[i]);
      velocity[i] = speed[i];
      displacement[i] += time_step * speed[i];
    }
  }
  state.reactions[r] = reactions;
  state.sums[r].external_damping += 0.5 * time_step * model.mass_damping * loss;
}

}  // namespace perilink
