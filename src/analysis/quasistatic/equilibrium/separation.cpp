// Whether a break separates the body, and equilibrium of bodies that move so far that double
// precision leaves few digits of their strains (docs/theory/events_and_energy.md, section 5).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/error.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

constexpr double machine_precision = std::numeric_limits<double>::epsilon();

/// An energy that is not this many times what errors leave cannot be told from none.
constexpr double clearly_there = 100.0;

/// Refinement has done its work when a correction has this share of the energy: displacements are
/// right to its root.
constexpr double fine_enough = 1e-20;

/// From a factor that has any digits left, each pass gains some; the last ones only measure.
constexpr int most_passes = 8;

/// Where nothing but elastic supports holds a part, and the body is less stiff than this share of
/// what it was before the break, the part counts as loose.
constexpr double least_support = 1e-3;

/// Errors of a motion, as energy over that of the motion, beyond which nothing can be said from it.
constexpr double most_error = 1e-6;

constexpr const char* out_of_digits =
    "even with a fresh factor and extended precision no equilibrium is found: the stiffness matrix "
    "is singular to working precision";

}  // namespace

/// Adds to `motion` what is missing to K motion = load, K times the motion summed element by
/// element in extended precision, and leaves its forces and energy in `fine_`.
/// \param load  per unknown
Equilibrium::Refined Equilibrium::refine_finely(std::span<const double> load, FineMotion& motion) {
  std::vector<double> residual(solution_.size());
  Refined result;
  auto measure = [&] {
    internal_force(network_, secants(), motion.particles, fine_);
    long double square = 0.0, ground = 0.0;
    std::vector<long double> internal(residual.size(), 0.0L);
    for (std::size_t slot = 0; slot < fine_.forces.size(); ++slot) {
      unknowns_->for_each(
          slot, [&](Index k, double weight) { internal[k] += weight * fine_.forces[slot]; });
    }
    for (std::size_t k = 0; k < residual.size(); ++k) {
      const long double u = motion.unknowns[k];
      const double stiffness = ground_stiffness_.empty() ? 0.0 : ground_stiffness_[k];
      const long double missing = load[k] - internal[k] - stiffness * u;
      residual[k] = static_cast<double>(missing);
      square += missing * missing;
      ground += stiffness * u * u;
    }
    result.residual = static_cast<double>(std::sqrt(square));
    result.energy = static_cast<double>(2.0L * fine_.energy + ground);
  };
  std::vector<double> correction(solution_.size());
  measure();
  for (int pass = 0; pass < most_passes; ++pass) {
    factor_->solve(residual, correction);
    const double energy =
        std::inner_product(correction.begin(), correction.end(), residual.begin(), 0.0);
    const bool gains = pass == 0 || energy < 0.1 * result.error;
    if (pass == 1) result.factor_error = std::sqrt(std::max(energy, 0.0) / result.error);
    result.error = energy >= 0.0 ? energy : std::numeric_limits<double>::infinity();
    if (!gains || !std::isfinite(result.error)) break;
    for (std::size_t k = 0; k < correction.size(); ++k) motion.unknowns[k] += correction[k];
    for (std::size_t slot = 0; slot < motion.particles.size(); ++slot) {
      unknowns_->for_each(slot, [&](Index k, double weight) {
        motion.particles[slot] += static_cast<long double>(weight) * correction[k];
      });
    }
    measure();
    if (result.error <= fine_enough * result.energy) break;
  }
  long double largest = 0.0;
  for (const long double u : motion.particles) largest = std::max(largest, std::abs(u));
  // Directions of bonds are rounded: a rigid motion stretches them by as much.
  const double noise = machine_precision * static_cast<double>(largest);
  result.error += stiffness_sum_ * noise * noise;
  return result;
}

/// The v with K v = x, and what is in doubt of its energy v'K v = x'v <= 1.
auto Equilibrium::motion_of(const SparseVector& x) -> std::pair<FineMotion, double> {
  std::vector<double> load(solution_.size(), 0.0);
  for (int k = 0; k < x.size(); ++k) load[x.rows[k]] = x.values[k];
  FineMotion motion{std::vector<long double>(solution_.size(), 0.0L),
                    std::vector<long double>(displacement_.size(), 0.0L)};
  double error = refine_finely(load, motion).error;
  if (!(error < most_error)) {
    factorize();
    error = refine_finely(load, motion).error;
    if (!(error < most_error)) throw SolverError(out_of_digits);
  }
  return {std::move(motion), error};
}

/// What resists when the ends of an element move apart without it: the pivot
///
///   min over v of  E(v) / (E(v) + (x'v)^2),
///
/// E twice the energy of all other elements, which the v with K v = x attains. An inexact v gives
/// too much by no more than the energy of its error.
/// \param kept  secant that stays
/// \return 0 where it cannot be told from zero
double Equilibrium::pivot_by_energy(const SparseVector& x, Index element, double kept) {
  const auto [motion, error] = motion_of(x);
  const double before = secant_of(element);
  set_secant(element, kept);
  internal_force(network_, secants(), motion.particles, fine_);
  set_secant(element, before);
  double energy = static_cast<double>(2.0L * fine_.energy);
  for (std::size_t k = 0; k < ground_stiffness_.size(); ++k) {
    const long double u = motion.unknowns[k];
    energy += static_cast<double>(ground_stiffness_[k] * u * u);
  }
  supports_alone_ = static_cast<double>(fine_.support_energy) > 0.25 * energy;
  if (!(energy > clearly_there * error)) return 0.0;
  long double extension = 0.0;
  for (int k = 0; k < x.size(); ++k) extension += x.values[k] * motion.unknowns[x.rows[k]];
  return energy / (energy + static_cast<double>(extension * extension));
}

/// Whether what still holds a loose part are elastic supports that are next to nothing beside what
/// held it before.
bool Equilibrium::hangs_on_weak_supports(double compliance_growth) const {
  if (!supports_alone_ || !driven_elements_.empty()) return false;
  const double before = partial_ ? force_work_ : work_of_forces();
  return before < least_support * (before + compliance_growth);
}

/// Equilibrium without the element, or with less of it, from a new factor. \return false when there
/// is none, since the matrix is not positive definite: then all is as it was
bool Equilibrium::rebuild_without(Index element, double kept) {
  const double before = secant_of(element);
  set_secant(element, kept);
  try {
    factorize();
    refine_in_extended_precision();
    return true;
  } catch (const NotPositiveDefinite&) {
    set_secant(element, before);
    factorize();
    return false;
  }
}

/// Refines the displacements in extended precision; they are kept rounded. Where that is needed the
/// factor's pivots may be noise too.
Balance Equilibrium::refine_in_extended_precision() {
  look_closer_ = true;
  if (stale_) refresh();
  std::vector<double> load = unknowns_->restrict(loads_->forces);
  for (std::size_t k = 0; k < ground_load_.size(); ++k) load[k] += ground_load_[k];
  FineMotion motion{{solution_.begin(), solution_.end()},
                    {displacement_.begin(), displacement_.end()}};
  Refined refined = refine_finely(load, motion);
  const auto uncertain = [&] {
    return !(refined.error < most_error * std::max(refined.energy, last_work_));
  };
  if (uncertain()) {
    factorize();
    refined = refine_finely(load, motion);
    if (uncertain()) throw SolverError(out_of_digits);
  }
  for (std::size_t k = 0; k < solution_.size(); ++k) {
    solution_[k] = static_cast<double>(motion.unknowns[k]);
  }
  scatter_solution();
  force_work_ = work_of_forces();
  factor_error_ = refined.factor_error;
  Balance result;
  result.residual = std::max(refined.residual / load_norm_, machine_precision);
  result.stored_energy = static_cast<double>(fine_.energy);
  resists_ = 2.0 * result.stored_energy > clearly_there * refined.error;
  supports_alone_ = fine_.support_energy > 0.5L * fine_.energy;
  if (constant_) refine_permanent();
  return result;
}

/// The work of a driven body whose reactions all but cancel: from the energy of its elements, which
/// is a sum of squares.
LoadWork Equilibrium::work_by_energy() {
  const double before = last_work_;
  const double work = 2.0 * refine_in_extended_precision().stored_energy;
  if (!resists_) return {0.0, 0.0, true};
  const bool loose = supports_alone_ && before > 0.0 && work < least_support * before;
  const double forces = work_of_forces();
  return {forces, work - forces, loose};
}

}  // namespace perilink
