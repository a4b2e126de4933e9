// Detects whether a break separates the body. Finds equilibrium if motions are so large that double
// precision leaves few digits of the strains (docs/theory/events_and_energy.md, section 5).

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

/// Energies below this multiple of their error count as zero [-].
constexpr double clearly_there = 100.0;

/// Energy of a correction over the whole energy at which refinement ends [-]. Displacements are
/// accurate to its root.
constexpr double fine_enough = 1e-20;

/// Largest number of refinement passes. Each gains digits if the factor has any left; the last ones
/// only measure.
constexpr int most_passes = 8;

/// Fraction of its former stiffness below which a body that only elastic supports hold counts as
/// loose [-].
constexpr double least_support = 1e-3;

/// Largest usable error of a motion, as energy over the energy of the motion [-].
constexpr double most_error = 1e-6;

constexpr const char* out_of_digits =
    "even with a fresh factor and extended precision no equilibrium is found: the stiffness matrix "
    "is singular to working precision";

}  // namespace

/// Refines `motion` towards K motion = load, and leaves its forces and energy in `fine_`. K times
/// the motion is summed over the elements in extended precision.
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
  // Directions of bonds are rounded, so a rigid motion stretches them slightly.
  const double noise = machine_precision * static_cast<double>(largest);
  result.least_error = stiffness_sum_ * noise * noise;
  result.error += result.least_error;
  return result;
}

/// Returns v with K v = x, and the uncertainty of its energy v'K v = x'v <= 1.
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

/// Returns the resistance to a motion of an element's ends without the element. It is the pivot
///
///   min over v of  E(v) / (E(v) + (x'v)^2),
///
/// where E is twice the energy of all other elements. The minimum is at K v = x. An inexact v makes
/// the pivot too large, at most by the energy of its error.
/// \param kept  secant that stays
/// \return 0 if the pivot cannot be distinguished from zero
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

/// Returns whether a loose part is held only by elastic supports that are negligible compared with
/// its former support.
bool Equilibrium::hangs_on_weak_supports(double compliance_growth) const {
  if (!supports_alone_ || !driven_elements_.empty()) return false;
  const double before = partial_ ? force_work_ : work_of_forces();
  return before < least_support * (before + compliance_growth);
}

/// Finds equilibrium from a new factor without the element, or with a smaller secant.
/// \return false if the matrix is not positive definite; then all is unchanged
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

/// Refines the displacements in extended precision and stores them rounded. The factor's pivots may
/// then be noise too.
Balance Equilibrium::refine_in_extended_precision() {
  look_closer_ = true;
  if (stale_) refresh();
  std::vector<double> load = unknowns_->restrict(loads_->forces);
  for (std::size_t k = 0; k < ground_load_.size(); ++k) load[k] += ground_load_[k];
  FineMotion motion{{solution_.begin(), solution_.end()},
                    {displacement_.begin(), displacement_.end()}};
  Refined refined = refine_finely(load, motion);
  const auto uncertain = [&] {
    const double least = clearly_there * refined.least_error;  // a body without resistance
    return !(refined.error < std::max(least, most_error * std::max(refined.energy, last_work_)));
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

/// Computes the work of a body whose reactions nearly cancel from the energy of its elements, a sum
/// of squares.
LoadWork Equilibrium::work_by_energy() {
  const double before = last_work_;
  const double work = 2.0 * refine_in_extended_precision().stored_energy;
  if (!resists_) return {0.0, 0.0, true};
  const bool loose = supports_alone_ && before > 0.0 && work < least_support * before;
  const double forces = work_of_forces();
  return {forces, work - forces, loose};
}

}  // namespace perilink
