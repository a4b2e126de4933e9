// Events of micropolar bonds in the single-event engine: changes of rank three and six.

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/events/removal.hpp"
#include "analysis/quasistatic/events/single_event_engine.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// A mode that a removal sets free carries load when it holds more than this share of the bond's
/// energy; round-off leaves 1e-16.
constexpr double least_loaded_share = 1e-12;

/// Energy at load factor 1, twice, in the modes that the removal would leave without any hold.
double energy_of_free_modes(const Removal& removal, std::span<const double> solution) {
  double sum = 0.0;
  for (int m = 0; m < removal.rank && removal.pivot[m] == 0.0; ++m) {
    sum += std::pow(removal.deformation(m, solution), 2);
  }
  return sum;
}

double energy_of_all_modes(const Removal& removal, std::span<const double> solution) {
  double sum = 0.0;
  for (int m = 0; m < removal.rank; ++m) sum += std::pow(removal.deformation(m, solution), 2);
  return sum;
}

}  // namespace

/// x_a' K^-1 x_b with K^-1 x_b refined against the elements themselves.
std::vector<double> SingleEventEngine::refined_compliance(const Removal& removal) {
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

/// Decouples the modes; small pivots come from energies.
void SingleEventEngine::look_closely(Removal& removal, Index element, double kept) {
  const Removal modes = removal;
  decouple(removal, refined_compliance(modes));
  supports_alone_ = false;
  for (int m = removal.rank - 1; m >= 0; --m) {
    if (removal.pivot[m] > doubtful_pivot) continue;
    removal.pivot[m] = pivot_by_energy(removal.x[m], element, kept);
  }
  // Energies may put two of them in another order by their last digits.
  for (int m = removal.rank - 1; m > 0; --m) {
    removal.pivot[m - 1] = std::min(removal.pivot[m - 1], removal.pivot[m]);
  }
}

/// Decouples the modes of a removal; where a pivot is small, with a factor and a solution that can
/// be trusted.
void SingleEventEngine::measure_pivots(Removal& removal, Index element, double kept) {
  const Removal modes = removal;
  must_rebuild_ = supports_alone_ = false;
  std::vector<double> compliance(static_cast<std::size_t>(modes.rank * modes.rank));
  const auto prepare = [&] {
    removal = modes;
    factor_->compliance(modes.vectors(), compliance);
    decouple(removal, compliance);
    return removal.pivot[0];
  };
  double prepared = prepare();
  if (prepared > doubtful_pivot && !look_closer_) return;
  removal = modes;
  look_closely(removal, element, kept);
  look_closer_ = std::abs(prepared - removal.pivot[0]) > noisy_pivot;
  if (removal.pivot[0] > doubtful_pivot) return;
  const auto agree = [&](double tolerance) {
    return std::abs(prepared - removal.pivot[0]) < tolerance * removal.pivot[0];
  };
  if (removal.pivot[0] == 0.0 || agree(same_pivot)) return;
  factorize();
  prepared = prepare();
  removal = modes;
  look_closely(removal, element, kept);
  must_rebuild_ = removal.pivot[0] > 0.0 && !agree(usable_pivot);
}

/// Before a bond goes that alone held an unloaded motion, as the rotation of a particle on which
/// only ties are left, springs take hold of it.
/// \param unloaded  energy, twice, up to which a motion counts as unloaded
/// \return false when the motion carries load: a mechanism
bool SingleEventEngine::hold_free_modes(Removal& removal, Index element, double unloaded,
                                        int& springs) {
  const Removal modes = make_removal(network_, unknowns_, element, secants_[element]);
  const int most = removal.rank;
  for (int tries = 0; removal.rank > 0 && removal.pivot[0] == 0.0; ++tries) {
    if (energy_of_free_modes(removal, solution_) > unloaded) return false;
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

void SingleEventEngine::commit_frame(const Removal& removal, Index element, double secant) {
  pass_limit(element, secant);
  if (must_rebuild_) return;  // done already
  factor_->downdate(removal.vectors(), removal.load_changes(), removal.pivots(), solution_);
  scatter_solution();
  stale_ = partial_;
  if (look_closer_) polish();
}

/// All parts of its stiffness fall alike.
EventOutcome SingleEventEngine::weaken_frame(Index element, double secant) {
  Removal removal = make_removal(network_, unknowns_, element, secants_[element] - secant);
  measure_pivots(removal, element, secant);
  EventOutcome outcome;
  outcome.secant = secant;
  const double energy = energy_of_all_modes(removal, solution_);
  outcome.released = 0.5 * energy;
  int springs = 0;
  outcome.mechanism = outcome.broke()
                          ? !hold_free_modes(removal, element, least_loaded_share * energy, springs)
                          : removal.rank > 0 && removal.pivot[0] == 0.0;
  outcome.pivot = removal.pivot[0];
  if (outcome.mechanism) return outcome;
  for (int m = 0; m < removal.rank; ++m) {
    outcome.compliance_growth += std::pow(removal.deformation(m, solution_), 2) / removal.pivot[m];
  }
  outcome.mechanism = hangs_on_weak_supports(outcome.compliance_growth) ||
                      (must_rebuild_ && !rebuild_without(element, secant));
  if (outcome.mechanism) return outcome;
  follow(outcome);
  commit_frame(removal, element, secant);
  return outcome;
}

int SingleEventEngine::cut_frame(Index element) {
  Removal removal = make_removal(network_, unknowns_, element, secants_[element]);
  measure_pivots(removal, element, 0.0);
  int springs = 0;
  // A force, as far as forces and moments compare: sqrt(k) times sqrt(k) times an extension.
  const double unloaded = std::pow(1e-6 * load_norm_, 2) / network_.stiffness[element];
  if (!hold_free_modes(removal, element, unloaded, springs)) {
    throw SolverError("the part that comes loose carries load: the body has separated");
  }
  if (must_rebuild_ && !rebuild_without(element, 0.0)) {
    throw SolverError("the body without the part that comes loose cannot be factorised");
  }
  commit_frame(removal, element, 0.0);
  return springs;
}

/// Work at load factor 1 of the forces of an element on what it does at driven particles, and the
/// same sum over the sizes of its terms.
std::pair<double, double> SingleEventEngine::driven_work_of(Index element) const {
  const Removal modes = make_removal(network_, unknowns_, element, secants_[element]);
  double work = 0.0, sizes = 0.0;
  for (int m = 0; m < modes.rank; ++m) {
    work += modes.deformation(m, solution_) * modes.prescribed[m];
    double size = std::abs(modes.prescribed[m]);
    const SparseVector& x = modes.x[m];
    for (int k = 0; k < x.size(); ++k) size += std::abs(x.values[k] * solution_[x.rows[k]]);
    sizes += size * std::abs(modes.prescribed[m]);
  }
  return {work, sizes};
}

}  // namespace perilink
