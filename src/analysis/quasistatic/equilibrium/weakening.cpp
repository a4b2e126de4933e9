// Weakening of elements: changes of rank one, three and six of the factor, their downdate pivots,
// and ground springs for loose parts.

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"

namespace perilink {
namespace {

/// Relative differences between pivots from the factor and from energies. Above the first a fresh
/// factor is worth its cost. Above the second it must be made without the element.
constexpr double same_pivot = 1e-8, usable_pivot = 1e-6;

/// Error of the factor's pivots above which every event is examined: its energy has the same error.
constexpr double noisy_pivot = 1e-8;

/// Fraction of the bond's energy above which a motion that a removal frees carries load [-].
/// Round-off leaves 1e-16.
constexpr double least_loaded_share = 1e-12;

/// Fraction of the load above which the force on a loose part counts as load [-].
constexpr double least_loaded_force = 1e-6;

}  // namespace

/// Returns square roots of twice the energies of the vectors. A bar's comes from differences of
/// displacements, which keep their digits if the body moves far.
auto Equilibrium::deformations(const Removal& removal, Index element) const -> Deformations {
  Deformations result{};
  if (is_frame(element)) {
    for (int m = 0; m < removal.rank; ++m) result[m] = removal.deformation(m, solution_);
    return result;
  }
  const std::size_t i = static_cast<std::size_t>(network_.bonds.first[element]) * network_.width();
  const std::size_t j = static_cast<std::size_t>(network_.bonds.second[element]) * network_.width();
  const std::span<const double> n = network_.bonds.direction(element);
  const double root = std::sqrt(network_.stiffness[element] * removal.fraction);
  for (int a = 0; a < network_.dim(); ++a) {
    result[0] += root * n[a] * (displacement_[j + a] - displacement_[i + a]);
  }
  return result;
}

/// Decouples the vectors and sets their pivots by the factor.
/// \return the smallest pivot
double Equilibrium::prepare(Removal& removal) {
  if (removal.rank == 1) return removal.pivot[0] = factor_->pivot(removal.x[0]);
  std::vector<double> compliance(static_cast<std::size_t>(removal.rank * removal.rank));
  factor_->compliance(removal.vectors(), compliance);
  decouple(removal, compliance);
  return removal.pivot[0];
}

/// Returns x_a' K^-1 x_b, where K^-1 x_b is refined against the elements.
std::vector<double> Equilibrium::refined_compliance(const Removal& removal) {
  const std::size_t rank = static_cast<std::size_t>(removal.rank);
  std::vector<double> compliance(rank * rank);
  for (std::size_t b = 0; b < rank; ++b) {
    const std::vector<long double> motion = motion_of(removal.x[b]).first.unknowns;
    for (std::size_t a = 0; a < rank; ++a) {
      long double sum = 0.0;
      const SparseVector& x = removal.x[a];
      for (int k = 0; k < x.size(); ++k) sum += x.values[k] * motion[x.rows[k]];
      compliance[a * rank + b] = static_cast<double>(sum);
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
void Equilibrium::look_closely(Removal& removal, Index element, double kept) {
  if (removal.rank > 1) decouple(removal, refined_compliance(removal));
  supports_alone_ = false;
  for (int m = removal.rank - 1; m >= 0; --m) {
    if (removal.rank > 1 && removal.pivot[m] > uncertain_pivot) continue;
    removal.pivot[m] = pivot_by_energy(removal.x[m], element, kept);
  }
  // Energies may swap two pivots by their last digits.
  for (int m = removal.rank - 1; m > 0; --m) {
    removal.pivot[m - 1] = std::min(removal.pivot[m - 1], removal.pivot[m]);
  }
}

/// Sets the pivots of a removal; zero if a vector has no resistance. Small pivots come from
/// energies. The factor is then reliable, or `must_rebuild_` marks that it must be made anew.
void Equilibrium::measure_pivots(Removal& removal, Index element, double kept) {
  must_rebuild_ = supports_alone_ = false;
  if (removal.rank == 1 && removal.x[0].size() == 0) {  // both ends prescribed
    removal.pivot[0] = 1.0;
    return;
  }
  const Removal modes = removal;
  double prepared = prepare(removal);
  if (prepared > uncertain_pivot && !look_closer_ && !take_rare_branch("pivot by energy")) return;
  removal = modes;
  look_closely(removal, element, kept);
  look_closer_ = std::abs(prepared - removal.pivot[0]) > noisy_pivot;
  if (removal.pivot[0] > uncertain_pivot) return;
  const auto agree = [&](double tolerance) {
    return std::abs(prepared - removal.pivot[0]) < tolerance * removal.pivot[0];
  };
  if (removal.pivot[0] == 0.0 || agree(same_pivot)) return;
  factorize();
  removal = modes;
  prepared = prepare(removal);
  removal = modes;
  look_closely(removal, element, kept);
  must_rebuild_ = removal.pivot[0] > 0.0 && !agree(usable_pivot);
}

/// Adds ground springs before a removal that frees an unloaded motion. An example is the rotation
/// of a particle that only slip springs hold.
/// \param unloaded  twice the energy up to which a motion counts as unloaded
/// \return false if the motion carries load: a mechanism
bool Equilibrium::hold_free_modes(Removal& removal, Index element, double unloaded, int& springs) {
  const Removal modes = removal_of(element, 0.0);
  const int most = network_.dim() == 2 ? 3 : 6;
  for (int tries = 0; removal.rank > 0 && removal.pivot[0] == 0.0; ++tries) {
    const Deformations deformation = deformations_now(removal, element);
    double energy = 0.0;
    for (int m = 0; m < removal.rank && removal.pivot[m] == 0.0; ++m) {
      energy += deformation[m] * deformation[m];
    }
    if (!(energy <= unloaded)) return false;
    if (tries == most) {
      throw SolverError("a part that comes loose cannot be held by ground springs");
    }
    keep_all_current();
    add_ground_spring(most_mobile_unknown(removal.x[0]));
    ++springs;
    removal = modes;
    measure_pivots(removal, element, 0.0);
  }
  return true;
}

/// Updates work products by the growth of the compliance.
void Equilibrium::follow(const EventOutcome& outcome) {
  if (!must_rebuild_) force_work_ += outcome.compliance_growth;
  followed_compliance_ += outcome.compliance_growth;
  // Small events keep the accuracy of the displacements.
  const bool sure = outcome.pivot > uncertain_pivot && !look_closer_ &&
                    outcome.compliance_growth < 0.01 * last_work_;
  events_to_follow_ = sure ? events_to_follow_ - 1 : 0;
}

void Equilibrium::commit(const Removal& removal, Index element, double secant) {
  // A factor made anew on the way has no columns yet: they belong to the body before the event.
  if (subdomains_ != nullptr && !must_rebuild_) subdomains_->hold(removal.vectors());
  const bool is_first = secants_[element] == 1.0;
  if (!axial_.empty() && is_first && network_.law(element).closes()) damaged_.push_back(element);
  set_secant(element, secant);
  if (must_rebuild_) return;                                  // done already
  if (removal.rank == 1 && removal.x[0].size() == 0) return;  // acts on no unknown
  if (constant_ && removal.rank == 1) {
    commit_both(removal);
  } else {
    if (constant_) move_constant(removal);
    factor_->downdate(removal.vectors(), removal.load_changes(), removal.pivots(), solution_);
  }
  if (subdomains_ != nullptr && secant == 0.0) subdomains_->evict(removal.vectors());
  scatter_current();
  if (constant_) scatter_constant();
  stale_ = partial_;
  if (look_closer_) refine_in_extended_precision();
}

EventOutcome Equilibrium::weaken(Index element, double secant) {
  const double before = secants_[element];
  bring_factor_up();
  if (!network_.has_limit(element)) keep_all_current();
  Removal removal = removal_of(element, secant);
  measure_pivots(removal, element, secant);
  EventOutcome outcome;
  outcome.secant = secant;
  double energy = 0.0;
  for (const double deformation : deformations(removal, element))
    energy += deformation * deformation;
  outcome.released = 0.5 * energy;
  if (constant_) energy = release_constant(removal, element, outcome);
  int springs = 0;
  outcome.mechanism = outcome.broke()
                          ? !hold_free_modes(removal, element, least_loaded_share * energy, springs)
                          : removal.pivot[0] == 0.0;
  outcome.pivot = removal.pivot[0];
  if (outcome.mechanism) return outcome;
  const Deformations deformation = deformations(removal, element);
  for (int m = 0; m < removal.rank; ++m) {
    outcome.compliance_growth += deformation[m] * deformation[m] / removal.pivot[m];
    if (!constant_) continue;
    const double held = removal.constant[m];
    outcome.permanent_growth.linear += 2.0 * deformation[m] * held / removal.pivot[m];
    outcome.permanent_growth.constant += held * held / removal.pivot[m];
  }
  outcome.mechanism = hangs_on_weak_supports(outcome.compliance_growth) ||
                      (must_rebuild_ && !rebuild_without(element, secant));
  if (outcome.mechanism) return outcome;
  follow(outcome);
  commit(removal, element, secant);
  if (take_rare_branch("early factor")) factorize();
  if (!axial_.empty()) settle_closing(outcome);
  if (outcome.mechanism) take_back(element, before);
  return outcome;
}

int Equilibrium::cut(Index element) {
  bring_factor_up();
  keep_all_current();
  if (!axial_.empty() && is_closed(element)) open(element);
  if (secants_[element] == 0.0) return 0;
  Removal removal = removal_of(element, 0.0);
  measure_pivots(removal, element, 0.0);
  int springs = 0;
  // Twice the energy of a spring under the least loaded force; forces and moments are compared
  // directly.
  const double unloaded = std::pow(least_loaded_force * load_norm_, 2) /
                          (network_.stiffness[element] * secant_of(element));
  if (!hold_free_modes(removal, element, unloaded, springs)) {
    throw SolverError("the part that comes loose carries load: the body has separated");
  }
  if (must_rebuild_ && !rebuild_without(element, 0.0)) {
    throw SolverError("the stiffness matrix without the loose part cannot be factorised");
  }
  commit(removal, element, 0.0);
  return springs;
}

Index Equilibrium::most_mobile_unknown(const SparseVector& x) {
  const std::vector<double> direction = factor_->columns({&x, 1});
  const auto largest = std::max_element(direction.begin(), direction.end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  return static_cast<Index>(largest - direction.begin());
}

/// Returns the stiffness of the stiffest bond; for a rotation the largest bending stiffness.
double Equilibrium::ground_stiffness_of(Index unknown) const {
  const auto component = static_cast<int>(slot_of_[unknown] % network_.width());
  if (component < network_.dim()) {
    return *std::max_element(network_.stiffness.begin(),
                             network_.stiffness.begin() + network_.first_slip_spring);
  }
  double largest = 0.0;
  for (Index e = 0; e < network_.first_slip_spring; ++e) {
    largest = std::max(largest, network_.bending[e] * std::pow(network_.bonds.length(e), 2));
  }
  return largest;
}

void Equilibrium::add_ground_spring(Index unknown) {
  if (ground_stiffness_.empty()) {
    ground_stiffness_.assign(solution_.size(), 0.0);
    ground_load_.assign(solution_.size(), 0.0);
  }
  const double stiffness = ground_stiffness_of(unknown);
  SparseVector x;
  x.add(unknown, std::sqrt(stiffness));
  factor_->update(x);
  ground_stiffness_[unknown] += stiffness;
  ground_load_[unknown] += stiffness * solution_[unknown];
  if (!constant_) return;
  constant_->ground_load.resize(solution_.size());
  constant_->ground_load[unknown] += stiffness * constant_->solution[unknown];
}

}  // namespace perilink
