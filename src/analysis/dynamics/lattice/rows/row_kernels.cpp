#include "analysis/dynamics/lattice/rows/row_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/dynamics/lattice/body/lattice_loads.hpp"
#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"
#include "analysis/dynamics/lattice/rows/paper_forces.hpp"
#include "analysis/dynamics/lattice/rows/row_pointers.hpp"

namespace perilink {
namespace {

using namespace row_loops;

/// State of a row of bonds.
enum class Level {
  elastic,   ///< the body never changes
  watched,   ///< intact, with checks for damage and flow
  flowed,    ///< with plastic parts
  weakened,  ///< with damage factors, and plastic parts where the body yields
};

Level level_of(const ExplicitModel& model, const ExplicitState& state, Index row) {
  if (!model.alters()) return Level::elastic;
  if ((state.bond_changes[row] & BondChanges::weakened) != 0) return Level::weakened;
  return (state.bond_changes[row] & BondChanges::altered) != 0 ? Level::flowed : Level::watched;
}

/// Inputs and outputs of measuring a group of own bonds of a row.
template <int Dim>
struct MeasuredGroup {
  const double *u[Dim], *v[Dim];
  std::array<double*, group> stretch, effective, rate;
  std::array<const double*, group> present, drag, tension, compression, plastic;
  double* direction[group][Dim];
  double n[group][Dim], scale[group];
  Index shift[group];

  MeasuredGroup(const ExplicitModel& model, ExplicitState& state, Index r, int first) {
    const LatticeRows& lattice = model.lattice;
    const LatticeRow& row = lattice.rows[r];
    for (int c = 0; c < Dim; ++c) {
      u[c] = at(state.displacement, lattice, c, row);
      v[c] = at(state.velocity, lattice, c, row);
    }
    const RowPlaces& places = state.now.places;
    at_bonds_now(state.now.stretch, places, first, r, stretch);
    at_bonds_now(state.now.effective, places, first, r, effective);
    at_bonds(state.rate, lattice, first, row, rate);
    at_bonds(lattice.present, lattice, first, row, present);
    at_bonds(std::as_const(state.drag), lattice, first, row, drag);
    at_bonds(std::as_const(state.in_tension), lattice, first, row, tension);
    at_bonds(std::as_const(state.in_compression), lattice, first, row, compression);
    at_bonds(std::as_const(state.flow.mean), lattice, first, row, plastic);
    for (int g = 0; g < group; ++g) {
      const OwnBond& bond = lattice.bonds[first + g];
      shift[g] = lattice.shift_out[r * lattice.own_bonds() + first + g];
      scale[g] = 1.0 / bond.length;
      for (int c = 0; c < Dim; ++c) {
        n[g][c] = bond.direction[c];
        direction[g][c] = at_now(state.now.force, places, (first + g) * Dim + c, r);
      }
    }
  }
};

/// Measures bonds with vectors of unit reference length, n + du / L. Elongation without
/// cancellation: |y|^2 - 1 = 2 n.du/L + |du/L|^2 = e, |y| - 1 = e / (1 + sqrt(1 + e)).
/// \param Flowed  bonds have plastic parts
template <int Dim, Level Kind, bool Flowed>
void measure_group(const ExplicitModel& model, ExplicitState& state, Index r, int first,
                   double dt) {
  const MeasuredGroup<Dim> m(model, state, r, first);
  const Index size = model.lattice.rows[r].size;
  const double half_step = 0.5 * dt, damping = model.bond_damping;
  double loss = 0.0, fastest = 0.0;
#pragma omp simd reduction(+ : loss) reduction(max : fastest)
  for (Index i = 0; i < size; ++i) {
#pragma GCC unroll 6
    for (int g = 0; g < group; ++g) {
      // Component by component: arrays here would prevent vectorisation.
      const Index other = i + m.shift[g];
      const double x = (m.u[0][other] - m.u[0][i]) * m.scale[g];
      const double y = (m.u[1][other] - m.u[1][i]) * m.scale[g];
      double along = m.n[g][0] * x + m.n[g][1] * y, square = x * x + y * y, z = 0.0;
      if constexpr (Dim == 3) {
        z = (m.u[2][other] - m.u[2][i]) * m.scale[g];
        along += m.n[g][2] * z;
        square += z * z;
      }
      const double excess = 2.0 * along + square;
      const double length = std::sqrt(1.0 + excess);
      const double share = 1.0 / ((1.0 + length) * length);  // one division for two quotients
      double s = excess * length * share;
      const double shorten = (1.0 + length) * share;
      const double nx = (m.n[g][0] + x) * shorten, ny = (m.n[g][1] + y) * shorten;
      m.direction[g][0][i] = nx;
      m.direction[g][1][i] = ny;
      double speed = nx * (m.v[0][other] - m.v[0][i]) + ny * (m.v[1][other] - m.v[1][i]);
      if constexpr (Dim == 3) {
        const double nz = (m.n[g][2] + z) * shorten;
        m.direction[g][2][i] = nz;
        speed += nz * (m.v[2][other] - m.v[2][i]);
      }
      speed *= m.present[g][i];
      const double twice = m.rate[g][i] + speed;
      if constexpr (Flowed) s -= m.plastic[g][i];
      if constexpr (Kind != Level::elastic) m.stretch[g][i] = s;
      if constexpr (Kind == Level::weakened) {
        m.effective[g][i] = s * by_sign(s, m.tension[g][i], m.compression[g][i]);
        loss += half_step * m.drag[g][i] * twice;
      } else {
        m.effective[g][i] = s * m.present[g][i];
        loss += half_step * damping * m.rate[g][i] * twice;
      }
      m.rate[g][i] = speed;
      if constexpr (Kind != Level::elastic) {
        fastest = std::max(fastest, std::abs(speed) * m.scale[g]);
      }
    }
  }
  state.sums[r].internal_damping += loss;
  if constexpr (Kind != Level::elastic) state.fastest[r] = std::max(state.fastest[r], dt * fastest);
}

template <int Dim, Level Kind, bool Flowed>
void measure(const ExplicitModel& model, ExplicitState& state, Index r, double dt) {
  // Flow in the last step also changed the elastic stretches.
  state.fastest[r] = state.flow.change.empty() ? 0.0 : std::exchange(state.flow.change[r], 0.0);
  state.now.clear_stale(r, model.lattice.rows[r].size);
  for (int first = 0; first < model.lattice.own_bonds(); first += group) {
    measure_group<Dim, Kind, Flowed>(model, state, r, first, dt);
  }
}

template <int Dim>
void measure(const ExplicitModel& model, ExplicitState& state, Index r, double dt) {
  switch (level_of(model, state, r)) {
    case Level::elastic: return measure<Dim, Level::elastic, false>(model, state, r, dt);
    case Level::watched: return measure<Dim, Level::watched, false>(model, state, r, dt);
    case Level::flowed: return measure<Dim, Level::flowed, true>(model, state, r, dt);
    case Level::weakened:
      return model.material.yields ? measure<Dim, Level::weakened, true>(model, state, r, dt)
                                   : measure<Dim, Level::weakened, false>(model, state, r, dt);
  }
}

/// Computes stretches of a row's own bonds times their weights in the sums of their ends.
void weigh(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const RowPlaces& places = state.now.places;
  for (int first = 0; first < lattice.own_bonds(); first += group) {
    const WeightPointers weight(lattice, state, r, first);
    std::array<const double*, group> stretch;
    std::array<double*, group> owners, partners;
    at_bonds_now(std::as_const(state.now.stretch), places, first, r, stretch);
    at_bonds_now(state.now.owners, places, first, r, owners);
    at_bonds_now(state.now.partners, places, first, r, partners);
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
#pragma GCC unroll 6
      for (int g = 0; g < group; ++g) {
        const double s = stretch[g][i];
        owners[g][i] = s * weight.of_owner(g, i, s);
        partners[g][i] = s * weight.of_partner(g, i, s);
      }
    }
  }
}

/// Computes the bond forces of a group, magnitudes times directions, by the consistent rules.
/// \param Weakened  bonds have damage factors
template <int Dim, bool Weakened>
void force_group(const ExplicitModel& model, ExplicitState& state, Index r, int first) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  std::array<const double*, group> effective, present, rate, tension, compression, stretch;
  std::array<double*, group> drag;
  const RowPlaces& places = state.now.places;
  at_bonds_now(std::as_const(state.now.effective), places, first, r, effective);
  at_bonds(std::as_const(lattice.present), lattice, first, row, present);
  at_bonds(std::as_const(state.rate), lattice, first, row, rate);
  at_bonds(std::as_const(state.in_tension), lattice, first, row, tension);
  at_bonds(std::as_const(state.in_compression), lattice, first, row, compression);
  at_bonds_now(std::as_const(state.now.stretch), places, first, r, stretch);
  at_bonds(state.drag, lattice, first, row, drag);
  double* force[group][Dim];
  double own[group];
  Index shift[group];
  for (int g = 0; g < group; ++g) {
    own[g] = model.own_modulus(first + g);
    shift[g] = places.shift_out[r * lattice.own_bonds() + first + g];
    for (int c = 0; c < Dim; ++c) {
      force[g][c] = at_now(state.now.force, places, (first + g) * Dim + c, r);
    }
  }
  const double* sum = at_now(state.now.sum, places, 0, r);
  const double modulus = model.moduli.sum, damping = model.bond_damping;
  const WeightPointers weight(lattice, state, r, first);
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
#pragma GCC unroll 6
    for (int g = 0; g < group; ++g) {
      const double here = modulus * sum[i], there = modulus * sum[i + shift[g]];
      double magnitude = own[g] * effective[g][i];
      if constexpr (Weakened) {
        const double factor = by_sign(stretch[g][i], tension[g][i], compression[g][i]);
        magnitude += weight.mean(g, i, stretch[g][i], here, there);
        drag[g][i] = damping * factor * rate[g][i];
        magnitude += drag[g][i];
      } else {
        magnitude += present[g][i] * 0.5 * (here + there);
        magnitude += damping * rate[g][i];
      }
      for (int c = 0; c < Dim; ++c) force[g][c][i] *= magnitude;
    }
  }
}

template <int Dim>
void forces(const ExplicitModel& model, ExplicitState& state, Index r) {
  const bool weakened = level_of(model, state, r) == Level::weakened;
  const auto force = weakened ? force_group<Dim, true> : force_group<Dim, false>;
  for (int first = 0; first < model.lattice.own_bonds(); first += group) {
    force(model, state, r, first);
  }
}

/// Computes the new velocity of one component of a row, before prescribed motions.
template <int Own>
void accelerate(const ExplicitModel& model, const ExplicitState& state, Index r, int c, double dt,
                double* speed) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double* velocity = at(state.velocity, lattice, c, row);
  const double* inverse_mass = at(model.inverse_mass, lattice, 0, row);
  const double *out[Own], *in[Own];
  for (int k = 0; k < Own; ++k) {
    out[k] = at_now(state.now.force, state.now.places, k * lattice.dim + c, r);
    in[k] = out[k] - state.now.places.shift_in[r * Own + k];
  }
  const double keep = 1.0 - dt * model.mass_damping;
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    double force = 0.0;
#pragma GCC unroll 18
    for (int k = 0; k < Own; ++k) force += out[k][i] - in[k][i];
    speed[i] = keep * velocity[i] + dt * inverse_mass[i] * force;
  }
}

/// \return work of one component's motion against a drag of one per mass, times 2 / dt
template <bool Damped>
double move(const ExplicitModel& model, ExplicitState& state, Index r, int c, double dt,
            const double* speed) {
  const LatticeRow& row = model.lattice.rows[r];
  const double* mass = at(model.mass, model.lattice, 0, row);
  double* velocity = at(state.velocity, model.lattice, c, row);
  double* displacement = at(state.displacement, model.lattice, c, row);
  double loss = 0.0;
#pragma omp simd reduction(+ : loss)
  for (Index i = 0; i < row.size; ++i) {
    if constexpr (Damped) loss += mass[i] * velocity[i] * (velocity[i] + speed[i]);
    velocity[i] = speed[i];
    displacement[i] += dt * speed[i];
  }
  return loss;
}

}  // namespace

void measure_bonds(const ExplicitModel& model, ExplicitState& state, Index row, double time_step) {
  model.lattice.dim == 2 ? measure<2>(model, state, row, time_step)
                         : measure<3>(model, state, row, time_step);
  if (is_weighted(model, state, row)) weigh(model, state, row);
}

void apply_factors(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRow& row = model.lattice.rows[r];
  for (int k = 0; k < model.lattice.own_bonds(); ++k) {
    const double* stretch = at_now(state.now.stretch, state.now.places, k, r);
    const double* tension = at(state.in_tension, model.lattice, k, row);
    const double* compression = at(state.in_compression, model.lattice, k, row);
    double* effective = at_now(state.now.effective, state.now.places, k, r);
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
      effective[i] = stretch[i] * by_sign(stretch[i], tension[i], compression[i]);
    }
  }
  if (is_weighted(model, state, r)) weigh(model, state, r);
}

void sum_stretches(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const RowPlaces& places = state.now.places;
  double* sum = at_now(state.now.sum, places, 0, r);
  const double* plastic = at(std::as_const(state.flow.sum), lattice, 0, row);
  const bool weighted = is_weighted(model, state, r);
  const StepNumbers& now = state.now;
  const bool flowed = plastic != nullptr && level_of(model, state, r) >= Level::flowed;
  for (int first = 0; first < lattice.own_bonds(); first += group) {
    std::array<const double*, group> out, in;
    std::array<double, group> weight;
    at_bonds_now(weighted ? now.owners : now.effective, places, first, r, out);
    for (int g = 0; g < group; ++g) {
      const Index k = r * lattice.own_bonds() + first + g, source = lattice.row_in[k];
      const bool far = source != no_index && is_weighted(model, state, source);
      in[g] = at_now(far ? now.partners : now.effective, places, first + g, r) - places.shift_in[k];
      weight[g] = lattice.bonds[first + g].length / lattice.spacing;
    }
    const double keep = first == 0 ? 0.0 : 1.0;
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
      double total = keep * sum[i];
#pragma GCC unroll 6
      for (int g = 0; g < group; ++g) total += weight[g] * (out[g][i] + in[g][i]);
      sum[i] = total;
    }
  }
  if (!flowed) return;
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) sum[i] += plastic[i];
}

void bond_forces(const ExplicitModel& model, ExplicitState& state, Index row) {
  if (model.rules != LatticeRules::consistent) return paper_forces(model, state, row);
  model.lattice.dim == 2 ? forces<2>(model, state, row) : forces<3>(model, state, row);
}

void advance(const ExplicitModel& model, ExplicitState& state, Index r, double time_step,
             double load_factor, double load_increment) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  thread_local std::vector<double> buffer;
  buffer.resize(row.size);
  double* speed = buffer.data();
  const double* mass = at(model.mass, lattice, 0, row);
  RowReactions reactions;
  double loss = 0.0;
  for (int c = 0; c < lattice.dim; ++c) {
    lattice.dim == 2 ? accelerate<3>(model, state, r, c, time_step, speed)
                     : accelerate<9>(model, state, r, c, time_step, speed);
    if (!model.applied.empty()) push(model, r, c, time_step * load_factor, speed);
    const double* velocity = at(state.velocity, lattice, c, row);
    for (const PrescribedMotion& motion : model.prescribed[r]) {
      if (motion.component != c) continue;
      const Index i = motion.slot - row.first;
      const double wanted = motion.amplitude * load_increment / time_step;
      const double reaction = mass[i] * (wanted - speed[i]) / time_step;
      speed[i] = wanted;
      state.sums[r].external_work += 0.5 * time_step * reaction * (wanted + velocity[i]);
      state.holding[lattice.at(c, motion.slot)] = reaction;
      reactions.driven += reaction * motion.amplitude;
      if (motion.amplitude == 0.0 && c == model.load_component) reactions.supports += reaction;
    }
    if (!model.applied.empty()) {
      state.sums[r].external_work +=
          0.5 * time_step * load_factor * power(model, r, c, velocity, speed);
    }
    loss += model.mass_damping > 0.0 ? move<true>(model, state, r, c, time_step, speed)
                                     : move<false>(model, state, r, c, time_step, speed);
  }
  state.reactions[r] = reactions;
  state.sums[r].external_damping += 0.5 * time_step * model.mass_damping * loss;
}

}  // namespace perilink
