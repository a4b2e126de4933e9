#include "analysis/dynamics/lattice/rows/row_flow.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"
#include "material/elasticity.hpp"

namespace perilink {
namespace {

constexpr int most_returns = 30;  // a few iterations are enough
/// convergence limit of returns, relative to the yield stress
constexpr double yield_round_off = 1e-14;

/// Yield curve and slope without branches: hardening up to a strain, then softening.
struct Curve {
  double yield, hardening, knee, ultimate, softening;

  explicit Curve(const YieldCurve& curve)
      : yield(curve.yield),
        hardening((curve.ultimate - curve.yield) / curve.ultimate_strain),
        knee(curve.ultimate_strain),
        ultimate(curve.ultimate),
        softening(curve.ultimate / (curve.failure_strain - curve.ultimate_strain)) {}

  double stress(double strain) const {
    const double harder = yield + hardening * strain;
    const double softer = std::max(0.0, ultimate - softening * (strain - knee));
    return strain <= knee ? harder : softer;
  }
  double slope(double strain) const {
    const double down = ultimate - softening * (strain - knee) > 0.0 ? -softening : 0.0;
    return strain <= knee ? hardening : down;
  }
};

/// Fields of a row, one value per particle.
struct Scratch {
  std::vector<double> mean, half, xy, normal, multiplier;

  void resize(Index size) {
    for (auto* field : {&mean, &half, &xy, &normal, &multiplier}) field->resize(size);
  }
};

/// Computes trial stresses: half the sum and half the difference of the normal components in the
/// plane, the shear component and the stress out of the plane.
void find_trial(const ExplicitModel& model, const ExplicitState& state, Index r, Scratch& trial) {
  const LatticeRow& row = model.lattice.rows[r];
  const BondPointers<6> bond(model, state, r);
  const double* sum = state.now.sum.data() + state.now.places.first[r];
  const double* volume = model.volume.data() + row.first;
  const double* locked = state.flow.normal.data() + row.first;
  const double* root_tension = state.root_tension.data() + row.first;
  const double* root_compression = state.root_compression.data() + row.first;
  const PlaneProducts nn(model.lattice);
  const double own = model.moduli.own, modulus = model.moduli.sum;
  const double half_length = 0.5 * model.lattice.spacing;
  const double nu = model.problem == Problem::plane_strain ? model.material.poissons_ratio : 0.0;
  double *means = trial.mean.data(), *halves = trial.half.data(), *shears = trial.xy.data(),
         *normals = trial.normal.data();
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    double sxx = 0.0, syy = 0.0, sxy = 0.0;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      const double stretch = bond.stretch[j][i];
      const double factor = by_sign(stretch, bond.tension[j][i], bond.compression[j][i]);
      const double root =
          bond.present[j][i] * by_sign(stretch, root_tension[i], root_compression[i]);
      const double elastic = stretch + (j < 3 ? bond.half[j][i] : -bond.half[j][i]);
      const double force = factor * own * elastic + root * modulus * sum[i];
      sxx += force * nn.xx[j % 3];
      syy += force * nn.yy[j % 3];
      sxy += force * nn.xy[j % 3];
    }
    const double scale = half_length / volume[i];
    means[i] = 0.5 * scale * (sxx + syy);
    halves[i] = 0.5 * scale * (sxx - syy);
    shears[i] = scale * sxy;
    normals[i] = 2.0 * nu * means[i] - locked[i];
  }
}

/// Excess of the particles of a row over the yield surface, as functions of their multipliers.
///
/// Plane stress: in axes of sum and difference the return decouples,
///   mean' = mean / (1 + E g / (3 (1 - nu))), difference and shear / (1 + 2 mu g),
/// where the plastic strain is g times the stress deviator. Plane strain: the deviator shrinks, and
/// the multiplier is the equivalent plastic strain.
template <bool Flat>
struct Surface {
  Curve curve;
  double mu, bulk;
  /// least stress for relative errors, where softening has reduced the yield stress to zero
  double least;
  double flattest;  ///< least magnitude of the derivative in Newton's method
  const double *means, *halves, *shears, *normals, *equivalent;

  Surface(const LatticeMaterial& material, const Scratch& trial, const double* strains)
      : curve(material.yielding),
        mu(material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio))),
        bulk(material.youngs_modulus / (3.0 * (1.0 - material.poissons_ratio))),
        least(1e-3 * material.yielding.yield),
        flattest(1e-9 * mu),
        means(trial.mean.data()),
        halves(trial.half.data()),
        shears(trial.xy.data()),
        normals(trial.normal.data()),
        equivalent(strains) {}

  /// Computes the excess of von Mises' stress over the yield stress, its derivative and the yield
  /// stress. They are separate arguments because loops with structures are not vectorised.
  void at(Index i, double g, double& excess, double& derivative, double& yield) const {
    const double square = 3.0 * (halves[i] * halves[i] + shears[i] * shears[i]);
    double mises = 0.0, slope = 0.0, strain = 0.0, growth = 1.0;
    if constexpr (Flat) {
      const double grow = 1.0 / (1.0 + bulk * g), turn = 1.0 / (1.0 + 2.0 * mu * g);
      const double a = means[i] * means[i] * grow * grow, b = square * turn * turn;
      mises = std::sqrt(a + b);
      slope = -(bulk * a * grow + 2.0 * mu * b * turn) / std::max(mises, least * yield_round_off);
      strain = equivalent[i] + 2.0 / 3.0 * g * mises;
      growth = 2.0 / 3.0 * (mises + g * slope);
    } else {
      const double over = means[i] - normals[i];
      mises = std::sqrt(over * over + square) - 3.0 * mu * g;
      slope = -3.0 * mu;
      strain = equivalent[i] + g;
    }
    yield = curve.stress(strain);
    excess = mises - yield;
    derivative = slope - curve.slope(strain) * growth;
  }
  double excess(Index i, double g) const {
    double value = 0.0, derivative = 0.0, yield = 0.0;
    at(i, g, value, derivative, yield);
    return value;
  }
  double error(Index i, double g) const {
    double value = 0.0, derivative = 0.0, yield = 0.0;
    at(i, g, value, derivative, yield);
    return std::abs(value) / std::max(yield, least);
  }
};

/// Does one iteration of Newton's method for the multipliers of all particles.
/// \param surface  a copy: a reference could alias the multipliers, and the loop would not be
///                 vectorised
/// \returns the largest excess before the iteration, relative to the yield stress
template <bool Flat>
double improve(const Surface<Flat> surface, Index size, double* multiplier) {
  double worst = 0.0;
#pragma omp simd reduction(max : worst)
  for (Index i = 0; i < size; ++i) {
    const double g = multiplier[i];
    double excess = 0.0, derivative = 0.0, yield = 0.0;
    surface.at(i, g, excess, derivative, yield);
    // A particle flows where its multiplier or its excess is positive.
    const double flows = std::max(g, excess);
    // Where softening is as steep as the return, the excess gives no direction; bisect() handles
    // it.
    const double slope = std::abs(derivative) > surface.flattest ? derivative : -surface.flattest;
    const double next = std::max(0.0, g - excess / slope);
    const double error = std::abs(excess) / std::max(yield, surface.least);
    multiplier[i] = flows > 0.0 ? next : 0.0;
    worst = std::max(worst, flows > 0.0 ? error : 0.0);
  }
  return worst;
}

/// Bisects for particles on which Newton's method did not converge. The excess falls with the
/// multiplier, but its slope jumps where softening begins and ends.
template <bool Flat>
void bisect(const Surface<Flat>& surface, Index size, double* multiplier) {
  for (Index i = 0; i < size; ++i) {
    if (surface.excess(i, 0.0) <= 0.0 || surface.error(i, multiplier[i]) <= yield_round_off)
      continue;
    double low = 0.0, high = Flat ? 1.0 / surface.mu : 1.0;
    while (surface.excess(i, high) > 0.0 && high < 1e12 / surface.mu) high *= 2.0;
    for (int k = 0; k < 4 * most_returns; ++k) {
      const double middle = 0.5 * (low + high);
      (surface.excess(i, middle) > 0.0 ? low : high) = middle;
    }
    multiplier[i] = high;
  }
}

/// Updates plastic strains, thresholds and halves of bonds from the multipliers.
template <bool Flat>
void settle(const ExplicitModel& model, const Scratch& trial, Index r, ExplicitState& state) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const LatticeMaterial& material = model.material;
  const Curve curve(material.yielding);
  const double e = material.youngs_modulus, nu = material.poissons_ratio;
  const double mu = e / (2.0 * (1.0 + nu)), bulk = e / (3.0 * (1.0 - nu));
  double* strain[4];
  for (const int c : {0, 1, 2, 3}) {
    strain[c] = state.flow.strain.data() + lattice.at(c, row.first);
  }
  double* equivalent = state.flow.equivalent.data() + row.first;
  double* locked = state.flow.normal.data() + row.first;
  double* yield = state.flow.yield.data() + row.first;
  double* look_at = state.flow.look_at.data() + row.first;
#pragma omp simd
  for (Index i = 0; i < row.size; ++i) {
    const double g = trial.multiplier[i];
    double mean = trial.mean[i], half = trial.half[i], shear = trial.xy[i], out = 0.0;
    double scale = g, grown = g;
    if constexpr (Flat) {
      const double grow = 1.0 / (1.0 + bulk * g), turn = 1.0 / (1.0 + 2.0 * mu * g);
      mean *= grow;
      half *= turn;
      shear *= turn;
      grown = 2.0 / 3.0 * g * std::sqrt(mean * mean + 3.0 * (half * half + shear * shear));
    } else {
      out = trial.normal[i];
      const double over = mean - out;
      const double mises = std::sqrt(over * over + 3.0 * (half * half + shear * shear));
      scale = 1.5 * g / std::max(mises, 1e-300);
    }
    const double third = (2.0 * mean + out) / 3.0;
    strain[0][i] += scale * (mean + half - third);
    strain[1][i] += scale * (mean - half - third);
    strain[2][i] += scale * (out - third);
    strain[3][i] += scale * shear;
    equivalent[i] += grown;
    yield[i] = curve.stress(equivalent[i]);
    // Round-off may leave the returned stress above the surface.
    look_at[i] = yield[i] * (1.0 + 10.0 * yield_round_off);
    if constexpr (!Flat) locked[i] = e * strain[2][i];
  }
}

/// Computes halves of bonds from the plastic strains. In plane strain the prevented out-of-plane
/// part adds in-plane strain.
/// \returns their largest change
double project_strains(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double* strain = state.flow.strain.data() + row.first;
  const Index slots = lattice.slots;
  const double nu = model.problem == Problem::plane_strain ? model.material.poissons_ratio : 0.0;
  double change = 0.0;
  for (int j = 0; j < 6; ++j) {
    const Vector3& n = lattice.bonds[j % 3].direction;
    const double xx = n[0] * n[0], yy = n[1] * n[1], xy = 2.0 * n[0] * n[1];
    double* stretch = state.flow.stretch.data() + lattice.at(j, row.first);
#pragma omp simd reduction(max : change)
    for (Index i = 0; i < row.size; ++i) {
      const double next = xx * strain[i] + yy * strain[slots + i] + nu * strain[2 * slots + i] +
                          xy * strain[3 * slots + i];
      change = std::max(change, std::abs(next - stretch[i]));
      stretch[i] = next;
    }
  }
  return change;
}

template <bool Flat>
bool flow_row(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRow& row = model.lattice.rows[r];
  thread_local Scratch trial;
  trial.resize(row.size);
  find_trial(model, state, r, trial);
  std::fill(trial.multiplier.begin(), trial.multiplier.end(), 0.0);
  const Surface<Flat> surface(model.material, trial, state.flow.equivalent.data() + row.first);
  double* multiplier = trial.multiplier.data();
  double worst = improve(surface, row.size, multiplier);
  if (worst == 0.0) return false;
  for (int k = 0; k < most_returns && worst > yield_round_off; ++k) {
    worst = improve(surface, row.size, multiplier);
  }
  if (!(worst <= yield_round_off)) bisect(surface, row.size, multiplier);
  settle<Flat>(model, trial, r, state);
  state.flow.change[r] = project_strains(model, state, r);
  return true;
}

}  // namespace

bool flows_in_rows(const ExplicitModel& model) {
  return model.material.yields && model.rules == LatticeRules::consistent && model.lattice.dim == 2;
}

bool flow_row(const ExplicitModel& model, ExplicitState& state, Index row) {
  return model.problem == Problem::plane_stress ? flow_row<true>(model, state, row)
                                                : flow_row<false>(model, state, row);
}

void update_plastic_parts(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const int own = lattice.own_bonds();
  const double own_halves = model.rules != LatticeRules::mean_2017 ? 0.5 : 0.0;
  const RowPlaces& now = state.now.places;
  for (int k = 0; k < own; ++k) {
    const double* mine = state.flow.stretch.data() + lattice.at(k, row.first);
    const double* other =
        state.flow.stretch.data() + lattice.at(k + own, row.first + lattice.shift_out[r * own + k]);
    const double* present = lattice.present.data() + lattice.at(k, row.first);
    double* mean = state.flow.mean.data() + lattice.at(k, row.first);
    double* half = state.flow.half.data() + lattice.at(k, row.first);
    double* stretch = state.now.stretch.data() + now.at(k, now.first[r]);
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
      const double next = 0.5 * present[i] * (mine[i] + other[i]);
      stretch[i] += mean[i] - next;
      mean[i] = next;
      half[i] = own_halves * present[i] * (other[i] - mine[i]);
    }
  }
  lock_energy(model, state, r);
  state.bond_changes[r] |= BondChanges::altered;
}

void lock_energy(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  double locked = 0.0;
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const double* half = state.flow.half.data() + lattice.at(k, row.first);
    const double* tension = state.in_tension.data() + lattice.at(k, row.first);
    double energy = 0.0;
#pragma omp simd reduction(+ : energy)
    for (Index i = 0; i < row.size; ++i) energy += tension[i] * half[i] * half[i];
    locked += 0.5 * lattice.bonds[k].length * model.own_modulus(k) * energy;
  }
  state.flow.locked[r] = locked;
}

void add_plastic_halves(const ExplicitModel& model, ExplicitState& state, Index r) {
  state.bond_changes[r] |= BondChanges::altered;
  if (model.rules == LatticeRules::mean_2017) return;
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  double* sum = state.flow.sum.data() + row.first;
  const double* root = state.root_tension.data() + row.first;
  std::fill_n(sum, row.size, 0.0);
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const double weight = lattice.bonds[k].length / lattice.spacing;
    const Index back = lattice.shift_in[r * lattice.own_bonds() + k];
    const double* half = state.flow.half.data() + lattice.at(k, row.first);
    const double* tension = state.in_tension.data() + lattice.at(k, row.first);
    const double* share = state.share_tension.data() + lattice.at(k, row.first);
    const bool weighs = model.weighs_halves();
#pragma omp simd
    for (Index i = 0; i < row.size; ++i) {
      const double mine = weighs ? root[i] * share[i] : tension[i];
      const double other = weighs ? root[i] * (2.0 - share[i - back]) : tension[i - back];
      sum[i] += weight * (mine * half[i] - other * half[i - back]);
    }
  }
}

}  // namespace perilink
