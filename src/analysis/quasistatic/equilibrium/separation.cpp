#include "analysis/quasistatic/equilibrium/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/rare_branch.hpp"
#include "solver/conjugate_gradients.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Relative differences between pivots from K^-1 and from energies. Above the first a new K^-1 is
/// worth its cost. Above the second it must be made without the element.
constexpr double same_pivot = 1e-8, usable_pivot = 1e-6;

/// Error of the pivots of K^-1 above which every event is examined: its energy has the same error.
constexpr double noisy_pivot = 1e-8;

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

SeparationCheck::SeparationCheck(DamagedBody& body, Solution& solution, const ReactionWork& work)
    : body_(body), solution_(solution), work_(work) {
  for (const double stiffness : body.network().stiffness) stiffness_sum_ += stiffness;
  for (const double stiffness : body.network().support_stiffness) stiffness_sum_ += stiffness;
}

/// Returns x'u.
long double SeparationCheck::FineMotion::along(const SparseVector& x) const {
  long double sum = 0.0;
  for (int k = 0; k < x.size(); ++k) sum += x.values[k] * unknowns[x.rows[k]];
  return sum;
}

/// Refines `motion` towards K motion = load, and leaves its forces and energy in `fine_`. K times
/// the motion is summed over the elements in extended precision.
/// \param load  per unknown
auto SeparationCheck::refine_finely(std::span<const double> load, FineMotion& motion) -> Refined {
  const Unknowns& unknowns = body_.unknowns();
  const std::vector<double>& ground_stiffness = body_.ground_stiffness();
  std::vector<double> residual(load.size());
  Refined result;
  auto measure = [&] {
    internal_force(body_.network(), body_.secants(), motion.particles, fine_);
    long double square = 0.0, ground = 0.0;
    std::vector<long double> internal(residual.size(), 0.0L);
    for (std::size_t slot = 0; slot < fine_.forces.size(); ++slot) {
      unknowns.for_each(
          slot, [&](Index k, double weight) { internal[k] += weight * fine_.forces[slot]; });
    }
    for (std::size_t k = 0; k < residual.size(); ++k) {
      const long double u = motion.unknowns[k];
      const double stiffness = ground_stiffness.empty() ? 0.0 : ground_stiffness[k];
      const long double missing = load[k] - internal[k] - stiffness * u;
      residual[k] = static_cast<double>(missing);
      square += missing * missing;
      ground += stiffness * u * u;
    }
    result.residual = static_cast<double>(std::sqrt(square));
    result.energy = static_cast<double>(2.0L * fine_.energy + ground);
  };
  std::vector<double> correction(load.size());
  measure();
  for (int pass = 0; pass < most_passes; ++pass) {
    solution_.update().inverse().solve(residual, correction);
    const double energy = scalar_product(correction, residual);
    const bool gains = pass == 0 || energy < 0.1 * result.error;
    if (pass == 1) result.inverse_error = std::sqrt(std::max(energy, 0.0) / result.error);
    result.error = energy >= 0.0 ? energy : std::numeric_limits<double>::infinity();
    if (!gains || !std::isfinite(result.error)) break;
    for (std::size_t k = 0; k < correction.size(); ++k) motion.unknowns[k] += correction[k];
    for (std::size_t slot = 0; slot < motion.particles.size(); ++slot) {
      unknowns.for_each(slot, [&](Index k, double weight) {
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
auto SeparationCheck::motion_of(const SparseVector& x) -> std::pair<FineMotion, double> {
  std::vector<double> load(body_.num_unknowns(), 0.0);
  for (int k = 0; k < x.size(); ++k) load[x.rows[k]] = x.values[k];
  FineMotion motion(load.size(), body_.unknowns().number.size());
  double error = refine_finely(load, motion).error;
  if (!(error < most_error)) {
    solution_.renew();
    error = refine_finely(load, motion).error;
    if (!(error < most_error)) throw SolverError(out_of_digits);
  }
  return {std::move(motion), error};
}

/// The pivot is
///
///   min over v of  E(v) / (E(v) + (x'v)^2),
///
/// where E is twice the energy of all other elements. The minimum is at K v = x. An inexact v makes
/// the pivot too large, at most by the energy of its error.
std::pair<double, bool> SeparationCheck::resistance(const SparseVector& x, Index element,
                                                    double kept) {
  const auto [motion, error] = motion_of(x);
  const double before = body_.secant_of(element);
  body_.set_secant(element, kept);
  internal_force(body_.network(), body_.secants(), motion.particles, fine_);
  body_.set_secant(element, before);
  double energy = static_cast<double>(2.0L * fine_.energy);
  for (std::size_t k = 0; k < body_.ground_stiffness().size(); ++k) {
    const long double u = motion.unknowns[k];
    energy += static_cast<double>(body_.ground_stiffness()[k] * u * u);
  }
  const bool on_supports = static_cast<double>(fine_.support_energy) > 0.25 * energy;
  if (!(energy > clearly_there * error)) return {0.0, on_supports};
  const long double extension = motion.along(x);
  return {energy / (energy + static_cast<double>(extension * extension)), on_supports};
}

/// Decouples the vectors and sets their pivots by K^-1.
/// \return the smallest pivot
double SeparationCheck::decouple_by_inverse(Removal& removal) {
  Factor& inverse = solution_.update().inverse();
  if (removal.rank == 1) return removal.pivot[0] = inverse.pivot(removal.x[0]);
  std::vector<double> compliance(static_cast<std::size_t>(removal.rank * removal.rank));
  inverse.compliance(removal.vectors(), compliance);
  decouple(removal, compliance);
  return removal.pivot[0];
}

/// Returns x_a' K^-1 x_b, where K^-1 x_b is refined against the elements.
std::vector<double> SeparationCheck::refined_compliance(const Removal& removal) {
  const std::size_t rank = static_cast<std::size_t>(removal.rank);
  std::vector<double> compliance(rank * rank);
  for (std::size_t b = 0; b < rank; ++b) {
    const FineMotion motion = motion_of(removal.x[b]).first;
    for (std::size_t a = 0; a < rank; ++a) {
      compliance[a * rank + b] = static_cast<double>(motion.along(removal.x[a]));
    }
  }
  for (std::size_t a = 0; a < rank; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      compliance[a * rank + b] = compliance[b * rank + a] =
          0.5 * (compliance[a * rank + b] + compliance[b * rank + a]);
    }
  }
  return compliance;
}

/// Decouples the vectors and computes small pivots from energies.
void SeparationCheck::look_closely(Removal& removal, Index element, double kept) {
  if (removal.rank > 1) decouple(removal, refined_compliance(removal));
  removal.on_supports = false;
  for (int m = removal.rank - 1; m >= 0; --m) {
    if (removal.rank > 1 && removal.pivot[m] > uncertain_pivot) continue;
    std::tie(removal.pivot[m], removal.on_supports) = resistance(removal.x[m], element, kept);
  }
  // Energies may swap two pivots by their last digits.
  for (int m = removal.rank - 1; m > 0; --m) {
    removal.pivot[m - 1] = std::min(removal.pivot[m - 1], removal.pivot[m]);
  }
}

void SeparationCheck::measure_pivots(Removal& removal, Index element, double kept) {
  removal.needs_new_inverse = removal.on_supports = false;
  if (removal.acts_on_nothing()) {  // both ends prescribed
    removal.pivot[0] = 1.0;
    return;
  }
  const Removal modes = removal;
  double prepared = decouple_by_inverse(removal);
  if (prepared > uncertain_pivot && !doubts_pivots_ && !take_rare_branch("pivot by energy")) return;
  removal = modes;
  look_closely(removal, element, kept);
  doubts_pivots_ = std::abs(prepared - removal.pivot[0]) > noisy_pivot;
  if (removal.pivot[0] > uncertain_pivot) return;
  const auto agree = [&](double tolerance) {
    return std::abs(prepared - removal.pivot[0]) < tolerance * removal.pivot[0];
  };
  if (removal.pivot[0] == 0.0 || agree(same_pivot)) return;
  solution_.renew();
  removal = modes;
  prepared = decouple_by_inverse(removal);
  removal = modes;
  look_closely(removal, element, kept);
  removal.needs_new_inverse = removal.pivot[0] > 0.0 && !agree(usable_pivot);
}

bool SeparationCheck::hangs_on_weak_supports(const Removal& removal, double growth) const {
  if (!removal.on_supports || work_.is_driven()) return false;
  const double before = solution_.growing().work();
  return before < least_support * (before + growth);
}

bool SeparationCheck::rebuild_without(Index element, double kept) {
  const double before = body_.secant_of(element);
  const bool was_intact = body_.secants()[element] == 1.0;
  body_.weaken(element, kept);
  try {
    solution_.renew();
    refine();
    return true;
  } catch (const NotPositiveDefinite&) {
    body_.take_back(element, before, was_intact);
    solution_.renew();
    return false;
  }
}

auto SeparationCheck::refine() -> Refinement {
  doubts_pivots_ = true;
  solution_.make_current();
  GrowingLoad& growing = solution_.growing();
  const std::vector<double> load = growing.field().forces(body_.unknowns(), growing.loads());
  FineMotion motion(growing.field());
  Refined refined = refine_finely(load, motion);
  const auto is_uncertain = [&] {
    const double least = clearly_there * refined.least_error;  // a body without resistance
    return !(refined.error < std::max(least, most_error * std::max(refined.energy, work_.last())));
  };
  if (is_uncertain()) {
    solution_.renew();
    refined = refine_finely(load, motion);
    if (is_uncertain()) throw SolverError(out_of_digits);
  }
  growing.set_values(motion.rounded());
  Refinement result;
  result.balance.residual =
      std::max(refined.residual / growing.field().load_norm, machine_precision);
  result.balance.stored_energy = static_cast<double>(fine_.energy);
  result.inverse_error = refined.inverse_error;
  result.resists = 2.0 * result.balance.stored_energy > clearly_there * refined.error;
  result.on_supports = fine_.support_energy > 0.5L * fine_.energy;
  if (solution_.permanent() != nullptr) refine_permanent();
  return result;
}

void SeparationCheck::refine_permanent() {
  PermanentLoad& permanent = *solution_.permanent();
  if (permanent.field().load_norm == 0.0) return;
  FineMotion motion(permanent.field());
  refine_finely(permanent.forces(), motion);
  permanent.set_values(motion.rounded());
}

LoadWork SeparationCheck::work_by_energy() {
  const double before = work_.last();
  const Refinement refined = refine();
  const double work = 2.0 * refined.balance.stored_energy;
  if (!refined.resists) return {0.0, 0.0, true};
  const bool loose = refined.on_supports && before > 0.0 && work < least_support * before;
  const double forces = solution_.growing().work();
  return {forces, work - forces, loose};
}

}  // namespace perilink
