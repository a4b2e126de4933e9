#include "analysis/dynamics/lattice/rows/row_flow_printed.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"
#include "analysis/dynamics/lattice/rows/row_scan.hpp"

namespace perilink {
namespace {

/// Largest plastic change of a stretch in a step (2018, below Eq. 29).
constexpr double most_flow = 0.01;
/// Largest fall of the yield stress in a step, as a factor (2018, below Eq. 24).
constexpr double softening_per_step = 0.99;

/// One value for each particle of a row.
struct Scratch {
  std::vector<double> due;     ///< one or zero
  std::vector<double> strain;  ///< plastic, before the step
  std::vector<double> yield;   ///< the same
};

/// Plastic strains of particles with all bonds.
void find_strains(const ExplicitModel& model, const LatticeParticles& particles,
                  const ExplicitState& state, Index r, double* strain) {
  const LatticeRow& row = model.lattice.rows[r];
  const std::vector<double>& inverse = particles.whole_inverse();
  const double* plastic[6];
  for (int j = 0; j < 6; ++j) {
    plastic[j] = state.flow.stretch.data() + model.lattice.at(j, row.first);
  }
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    double xx = 0.0, yy = 0.0, xy = 0.0;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      xx += inverse[3 * j] * plastic[j][i];
      yy += inverse[3 * j + 1] * plastic[j][i];
      xy += inverse[3 * j + 2] * plastic[j][i];
    }
    const double mean = 0.5 * (xx + yy), difference = 0.5 * (xx - yy);
    const double square = difference * difference + xy * xy;
    strain[i] = std::sqrt(mean * mean + 3.0 * square);  // e1^2 - e1 e2 + e2^2
  }
}

/// Pointers of a row that flows. The loop over the row makes its own, inlined: by reference they
/// would be read anew for every particle, since for all that the compiler knows stores to plastic
/// stretches could change them, and the loop would not be vectorised.
struct Row {
  BondPointers<6> bond;
  std::array<double*, 6> plastic;
  std::array<const double*, 6> partner;  ///< sums of the other particles
  const double *sum, *volume;

  [[gnu::always_inline]] Row(const ExplicitModel& model, ExplicitState& state, Index r)
      : bond(model, state, r) {
    const Index first = model.lattice.rows[r].first;
    const RowPlaces& places = state.now.places;
    sum = state.now.sum.data() + places.first[r];
    volume = model.volume.data() + first;
    for (int j = 0; j < 6; ++j) {
      plastic[j] = state.flow.stretch.data() + model.lattice.at(j, first);
      partner[j] = sum + (j < 3 ? places.shift_out[3 * r + j] : -places.shift_in[3 * r + j - 3]);
    }
  }
};

/// Eq. 24, of the particles that are due.
void harden(const ExplicitModel& model, ExplicitState& state, Index r, Scratch& scratch) {
  const YieldCurve& curve = model.material.yielding;
  const double first = curve.yield, ultimate_strain = curve.ultimate_strain;
  const double slope = (curve.ultimate - curve.yield) / curve.ultimate_strain;
  const LatticeRow& row = model.lattice.rows[r];
  double* yield = state.flow.yield.data() + row.first;
  double* visit = state.flow.visit.data() + row.first;
  const double *due = scratch.due.data(), *strain = scratch.strain.data();
  double* before = scratch.yield.data();
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    const double present = yield[i], waiting = visit[i];
    const double harder = std::max(present, first + slope * strain[i]);
    const double next = strain[i] >= ultimate_strain ? softening_per_step * present : harder;
    // A yield stress that falls does so in every step.
    const double look = strain[i] >= ultimate_strain ? -1.0 : next;
    before[i] = present;
    yield[i] = due[i] > 0.0 ? next : present;
    visit[i] = due[i] > 0.0 ? look : waiting;
  }
}

/// Eqs. 26–30.
/// \param Weakened  bonds of the row have factors of damage
template <bool Weakened>
bool flow_due(const ExplicitModel& model, ExplicitState& state, Index r, const Scratch& scratch) {
  const Row row(model, state, r);
  const Index size = model.lattice.rows[r].size;
  const LatticeMaterial& material = model.material;
  const double least = material.yielding.yield / material.youngs_modulus;
  const double own = model.moduli.own, modulus = model.moduli.sum;
  const double half_length = 0.5 * model.lattice.spacing;
  const double nu = model.problem == Problem::plane_strain ? material.poissons_ratio : 0.0;
  const PlaneProducts nn(model.lattice);
  const double *due = scratch.due.data(), *yield = scratch.yield.data();
  double any = 0.0;
#pragma omp simd reduction(max : any)
  for (Index i = 0; i < size; ++i) {
    const double shared = modulus * row.sum[i];
    double sxx = 0.0, syy = 0.0, sxy = 0.0, total = 0.0, count = 0.0;
    double force[6];
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      const double present = row.bond.present[j][i];
      const double half = j < 3 ? row.bond.half[j][i] : -row.bond.half[j][i];
      const double stretch = Weakened ? row.bond.stretch[j][i] : row.bond.effective[j][i];
      double stiffness = own;
      if constexpr (Weakened) {
        stiffness *= by_sign(stretch, row.bond.tension[j][i], row.bond.compression[j][i]);
      }
      const double mine = present * (stiffness * (stretch + half) + shared);
      const double other = stiffness * (stretch - half) + modulus * row.partner[j][i];
      sxx += mine * nn.xx[j % 3];
      syy += mine * nn.yy[j % 3];
      sxy += mine * nn.xy[j % 3];
      const double smaller = std::abs(mine) < std::abs(other) ? mine : other;
      force[j] = present * (mine * other > 0.0 ? smaller : 0.5 * (mine + other));
      total += force[j];
      count += present;
    }
    const double mean = 0.5 * (sxx + syy), difference = 0.5 * (sxx - syy);
    const double over = (1.0 - 2.0 * nu) * mean;
    const double mises = half_length / row.volume[i] *
                         std::sqrt(over * over + 3.0 * (difference * difference + sxy * sxy));
    const double share = total / std::max(1.0, count);
    double square = 0.0;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      force[j] -= row.bond.present[j][i] * share;
      square += force[j] * force[j];
    }
    const double ratio = mises / yield[i];
    const double amount = std::min(least * (ratio * ratio - 1.0), most_flow);
    // Equal forces, of square zero: the printed rule does not flow.
    const double scale = due[i] * amount / std::sqrt(std::max(square, 1e-300));
    const double step = mises > yield[i] ? scale : 0.0;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) row.plastic[j][i] += step * force[j];
    any = std::max(any, step * square);
  }
  return any > 0.0;
}

}  // namespace

double printed_plastic_strain(const ExplicitModel& model, const LatticeParticles& particles,
                              const ExplicitState& state, Index row, Index slot) {
  const LatticeParticles::Family family = particles.family(state, row, slot);
  LatticeParticles::Halves halves{};
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) halves[j] = state.flow.stretch[model.lattice.at(j, slot)];
  }
  const PrincipalValues strain = principal_values(particles.fit(halves, family), model.lattice.dim);
  const double e1 = strain.first, e2 = strain.last;
  return std::sqrt(e1 * e1 - e1 * e2 + e2 * e2);
}

bool flow_row_as_printed(const ExplicitModel& model, const LatticeParticles& particles,
                         ExplicitState& state, Index r, const std::vector<Index>& due) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  thread_local Scratch scratch;
  scratch.strain.resize(row.size);
  scratch.yield.resize(row.size);
  scratch.due.assign(row.size, 0.0);
  find_strains(model, particles, state, r, scratch.strain.data());
  for (const Index slot : due) {
    const Index i = slot - row.first;
    scratch.due[i] = 1.0;
    if (lattice.bond_count[slot] == 6) continue;
    scratch.strain[i] = printed_plastic_strain(model, particles, state, r, slot);
  }
  harden(model, state, r, scratch);
  const bool weakened = (duty_of_bonds(lattice, state, r) & RowDuty::weakened) != 0;
  return weakened ? flow_due<true>(model, state, r, scratch)
                  : flow_due<false>(model, state, r, scratch);
}

}  // namespace perilink
