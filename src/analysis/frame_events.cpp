// Events of micropolar bonds in the single-event engine: removals of rank three and six.

#include <algorithm>
#include <cmath>

#include "analysis/removal.hpp"
#include "analysis/single_event_engine.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// A mode that a removal sets free carries load when it holds more than this share of the bond's
/// energy; round-off leaves 1e-16.
constexpr double least_loaded_share = 1e-12;

/// Energy at load factor 1, twice, in the modes that the removal would leave without any hold.
double energy_of_free_modes(const Removal& removal, std::span<const double> solution) {
  double sum = 0.0;
  for (int m = 0; m < removal.rank && removal.pivot[m] < mechanism_pivot; ++m) {
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
  std::vector<double> direction;
  for (std::size_t b = 0; b < rank; ++b) {
    refined_solve(removal.x[b], direction);
    for (std::size_t a = 0; a < rank; ++a) {
      double sum = 0.0;
      const SparseVector& x = removal.x[a];
      for (int k = 0; k < x.size; ++k) sum += x.values[k] * direction[x.rows[k]];
      compliance[a * rank + b] = sum;
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

/// Decouples the modes of a removal; where a pivot is small, with a factor and a solution that can
/// be trusted.
void SingleEventEngine::measure_pivots(Removal& removal) {
  const Removal modes = removal;
  std::vector<double> compliance(static_cast<std::size_t>(modes.rank * modes.rank));
  factor_->compliance(modes.vectors(), compliance);
  decouple(removal, compliance);
  if (removal.pivot[0] > doubtful_pivot) return;
  const double doubted = removal.pivot[0];
  removal = modes;
  decouple(removal, refined_compliance(modes));
  if (removal.pivot[0] < mechanism_pivot) return;
  if (std::abs(doubted - removal.pivot[0]) < 1e-8 * removal.pivot[0]) return;
  factorize();
  removal = modes;
  decouple(removal, refined_compliance(modes));
}

/// Before a bond goes that alone held an unloaded motion, as the rotation of a particle on which
/// only ties are left, springs take hold of it.
/// \param unloaded  energy, twice, up to which a motion counts as unloaded
/// \return false when the motion carries load: a mechanism
bool SingleEventEngine::hold_free_modes(Removal& removal, Index element, double unloaded,
                                        int& springs) {
  const Removal modes = make_removal(network_, unknowns_, element, secants_[element]);
  const int most = removal.rank;
  for (int tries = 0; removal.rank > 0 && removal.pivot[0] < mechanism_pivot; ++tries) {
    if (energy_of_free_modes(removal, solution_) > unloaded) return false;
    if (tries == most) {
      throw SolverError("a part that comes loose cannot be held by ground springs");
    }
    keep_all_current();
    add_ground_spring(most_mobile_unknown(removal.x[0]));
    ++springs;
    removal = modes;
    measure_pivots(removal);
  }
  return true;
}

void SingleEventEngine::commit_frame(const Removal& removal, Index element) {
  secants_[element] = 0.0;
  search_->remove(element);
  factor_->downdate(removal.vectors(), removal.load_changes(), removal.pivots(), solution_);
  scatter_solution();
  stale_ = partial_;
}

EventOutcome SingleEventEngine::break_frame(Index element) {
  Removal removal = make_removal(network_, unknowns_, element, secants_[element]);
  measure_pivots(removal);
  EventOutcome outcome;
  const double energy = energy_of_all_modes(removal, solution_);
  outcome.released = 0.5 * energy;
  int springs = 0;
  outcome.mechanism = !hold_free_modes(removal, element, least_loaded_share * energy, springs);
  outcome.pivot = removal.pivot[0];
  if (outcome.mechanism) return outcome;
  for (int m = 0; m < removal.rank; ++m) {
    outcome.compliance_growth += std::pow(removal.deformation(m, solution_), 2) / removal.pivot[m];
  }
  force_work_ += outcome.compliance_growth;
  commit_frame(removal, element);
  return outcome;
}

int SingleEventEngine::cut_frame(Index element) {
  Removal removal = make_removal(network_, unknowns_, element, secants_[element]);
  measure_pivots(removal);
  int springs = 0;
  // A force, as far as forces and moments compare: sqrt(k) times sqrt(k) times an extension.
  const double unloaded = std::pow(1e-6 * load_norm_, 2) / network_.stiffness[element];
  if (!hold_free_modes(removal, element, unloaded, springs)) {
    throw SolverError("the part that comes loose carries load: the body has separated");
  }
  commit_frame(removal, element);
  return springs;
}

/// Work at load factor 1 of the forces of an element on what it does at driven particles.
double SingleEventEngine::driven_work_of(Index element) const {
  const Removal modes = make_removal(network_, unknowns_, element, secants_[element]);
  double work = 0.0;
  for (int m = 0; m < modes.rank; ++m) {
    work += modes.deformation(m, solution_) * modes.prescribed[m];
  }
  return work;
}

}  // namespace perilink
