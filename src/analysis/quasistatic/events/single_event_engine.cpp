#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/element_vector.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// Where even a fresh factor leaves more than this of the load out of balance, no figure that
/// follows would mean anything.
constexpr double hopeless_residual = 1e-3;

/// A driven body whose work is less than this share of the sum of the sizes of its terms has lost
/// seven of sixteen digits in that sum.
constexpr double cancelled_work = 1e-7;

}  // namespace

std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EngineOptions& options) {
  return std::make_unique<SingleEventEngine>(problem, options);
}

SingleEventEngine::SingleEventEngine(const LoadedNetwork& problem, const EngineOptions& options)
    : network_(problem.network),
      unknowns_(problem.unknowns),
      loads_(problem.loads),
      options_(options),
      factor_(make_factor(options.route, options.threads)),
      search_(make_break_search(network_)),
      secants_(static_cast<std::size_t>(network_.num_elements()), 1.0),
      teeth_(secants_.size(), 0),
      slot_of_(unknowns_.slots()),
      solution_(static_cast<std::size_t>(unknowns_.count), 0.0),
      displacement_(unknowns_.prescribed) {
  for (std::size_t slot = 0; slot < network_.support_stiffness.size(); ++slot) {
    const double driven = unknowns_.prescribed[slot];
    driven_spring_work_ += network_.support_stiffness[slot] * driven * driven;
  }
  for (std::size_t slot = 0; slot < unknowns_.number.size(); ++slot) {
    // A force on a prescribed displacement is a part of the reaction there, whose work counts.
    if (unknowns_.number[slot] == no_index) continue;
    if (loads_.forces[slot] != 0.0) loaded_slots_.push_back(slot);
  }
  const int width = network_.width();
  auto driven = [&](Index particle) {
    const auto begin = unknowns_.prescribed.begin() + static_cast<std::ptrdiff_t>(particle) * width;
    return std::any_of(begin, begin + width, [](double value) { return value != 0.0; });
  };
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (driven(network_.bonds.first[e]) || driven(network_.bonds.second[e])) {
      driven_elements_.push_back(e);
    }
  }
  for (const double stiffness : network_.stiffness) stiffness_sum_ += stiffness;
  for (const double stiffness : network_.support_stiffness) stiffness_sum_ += stiffness;
  factor_->factorize(assemble_stiffness(network_, secants_, unknowns_),
                     particle_of_unknown(unknowns_));
  const std::vector<double> load = present_load();
  for (const double value : load) load_norm_ += value * value;
  load_norm_ = std::sqrt(load_norm_);
  choose_current_unknowns();
  refresh();
  std::vector<double> residual;
  measure_residual(residual);
  refine(residual);
}

/// Under forces alone an event needs the displacements of elements that can fail, and no others:
/// the backward pass then leaves out the parts of the body where nothing can. f'u follows the
/// events by its growth. Driven bodies need the reactions at every event and keep all.
void SingleEventEngine::choose_current_unknowns() {
  if (!driven_elements_.empty()) return;
  std::vector<std::uint8_t> wanted(solution_.size(), 0);
  auto want = [&](Index particle) {
    for (int a = 0; a < network_.width(); ++a) {
      const std::size_t slot = static_cast<std::size_t>(particle) * network_.width() + a;
      unknowns_.for_each(slot, [&](Index unknown, double) { wanted[unknown] = 1; });
    }
  };
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (!network_.has_limit(e)) continue;
    want(network_.bonds.first[e]);
    want(network_.bonds.second[e]);
  }
  partial_ = std::any_of(wanted.begin(), wanted.end(), [](std::uint8_t flag) { return flag == 0; });
  if (partial_) factor_->keep_current(wanted);
}

std::vector<double> SingleEventEngine::present_load() const {
  std::vector<double> load = assemble_right_hand_side(network_, secants_, unknowns_, loads_);
  for (std::size_t k = 0; k < ground_load_.size(); ++k) load[k] += ground_load_[k];
  return load;
}

/// Solves for all displacements with the factor as it stands.
void SingleEventEngine::refresh() {
  factor_->follow_load(present_load(), solution_);
  scatter_solution();
  stale_ = false;
  force_work_ = work_of_forces();
}

double SingleEventEngine::work_of_forces() const {
  double work = 0.0;
  for (const std::size_t slot : loaded_slots_) work += loads_.forces[slot] * displacement_[slot];
  return work;
}

/// One step of iterative refinement; `residual` is used up.
void SingleEventEngine::refine(std::vector<double>& residual) {
  factor_->solve(residual, residual);
  for (std::size_t k = 0; k < residual.size(); ++k) solution_[k] += residual[k];
  scatter_solution();
  force_work_ = work_of_forces();
}

/// Observers must not change the run: stale displacements are solved for aside.
std::span<const double> SingleEventEngine::displacement() {
  if (!stale_) return displacement_;
  std::vector<double> all = present_load();
  factor_->solve(all, all);
  observed_ = unknowns_.expand(all);
  return observed_;
}

void SingleEventEngine::scatter_solution() {
  if (unknowns_.carries()) {
    displacement_ = unknowns_.expand(solution_);
    return;
  }
  for (std::size_t k = 0; k < slot_of_.size(); ++k) displacement_[slot_of_[k]] = solution_[k];
}

Event SingleEventEngine::next_event() {
  const BreakSearch::Hit hit = search_->find(displacement_, tie_tolerance, options_.threads);
  if (hit.element == no_index) return {};
  return {hit.element, 1.0 / hit.ratio};
}

SingleEventEngine::Change SingleEventEngine::make_change(Index element,
                                                         double stiffness_lost) const {
  Change change;
  change.x = element_vector(network_, unknowns_, element, stiffness_lost);
  const int dim = network_.dim(), width = network_.width();
  const std::span<const double> n = network_.bonds.direction(element);
  const std::size_t i = static_cast<std::size_t>(network_.bonds.first[element]) * width;
  const std::size_t j = static_cast<std::size_t>(network_.bonds.second[element]) * width;
  const double root = std::sqrt(stiffness_lost);
  // Prescribed displacements are zero where there is an unknown.
  for (int a = 0; a < dim; ++a) {
    change.extension += root * n[a] * (displacement_[j + a] - displacement_[i + a]);
    change.load_change += root * n[a] * (unknowns_.prescribed[j + a] - unknowns_.prescribed[i + a]);
  }
  return change;
}

Tooth SingleEventEngine::next_tooth(Index element) const {
  return network_.law(element).tooth(teeth_[element] + 1);
}

/// The element goes on with the secant, of its next tooth or zero.
void SingleEventEngine::pass_limit(Index element, double secant) {
  secants_[element] = secant;
  if (secant == 0.0) {
    search_->set_limit(element, std::numeric_limits<double>::infinity());
    return;
  }
  const double limit = next_tooth(element).limit;
  ++teeth_[element];
  search_->set_limit(element, network_.critical_stretch[element] * limit);
}

void SingleEventEngine::commit(const Change& change, Index element, double secant) {
  pass_limit(element, secant);
  if (must_rebuild_) return;  // done already
  if (change.x.size() == 0)
    return;  // both ends prescribed: nothing unknown is held by this element
  factor_->commit_downdate(change.load_change, solution_);
  scatter_solution();
  stale_ = partial_;
  if (look_closer_) polish();
}

/// Work products grow with the compliance.
void SingleEventEngine::follow(const EventOutcome& outcome) {
  if (!must_rebuild_) force_work_ += outcome.compliance_growth;
  followed_compliance_ += outcome.compliance_growth;
  // Small events leave the displacements as exact as they were.
  const bool sure = outcome.pivot > doubtful_pivot && !look_closer_ &&
                    outcome.compliance_growth < 0.01 * last_work_;
  events_to_follow_ = sure ? events_to_follow_ - 1 : 0;
}

EventOutcome SingleEventEngine::apply(const Event& event) {
  const Index element = event.element;
  const double next = next_tooth(element).secant;
  if (is_frame(element)) return weaken_frame(element, next);
  const double lost = network_.stiffness[element] * (secants_[element] - next);
  Change change = make_change(element, lost);
  EventOutcome outcome;
  outcome.secant = next;
  outcome.pivot = pivot_of(change, element, next);
  change = make_change(element, lost);  // looking closer may have sharpened the displacements
  outcome.released = 0.5 * change.extension * change.extension;
  outcome.compliance_growth = change.extension * change.extension / outcome.pivot;
  outcome.mechanism = outcome.pivot == 0.0 || hangs_on_weak_supports(outcome.compliance_growth) ||
                      (must_rebuild_ && !rebuild_without(element, next));
  if (outcome.mechanism) return outcome;
  follow(outcome);
  commit(change, element, next);
  return outcome;
}

LoadWork SingleEventEngine::load_work() {
  if (partial_) return {force_work_, 0.0};
  LoadWork work{work_of_forces(), driven_spring_work_};
  double sizes = driven_spring_work_;
  const int dim = network_.dim();
  for (const Index e : driven_elements_) {
    if (secants_[e] == 0.0) continue;
    if (network_.carries_moments()) {
      const auto [share, size] = driven_work_of(e);
      work.supports += share;
      sizes += size;
      continue;
    }
    const std::span<const double> n = network_.bonds.direction(e);
    const std::size_t i = static_cast<std::size_t>(network_.bonds.first[e]) * dim;
    const std::size_t j = static_cast<std::size_t>(network_.bonds.second[e]) * dim;
    double extension = 0.0, driven = 0.0, size = 0.0;
    for (int a = 0; a < dim; ++a) {
      extension += n[a] * (displacement_[j + a] - displacement_[i + a]);
      size += std::abs(n[a]) * (std::abs(displacement_[j + a]) + std::abs(displacement_[i + a]));
      driven += n[a] * (unknowns_.prescribed[j + a] - unknowns_.prescribed[i + a]);
    }
    work.supports += network_.stiffness[e] * secants_[e] * extension * driven;
    sizes += network_.stiffness[e] * secants_[e] * size * std::abs(driven);
  }
  if (!driven_elements_.empty()) {
    const bool lost = !(work.forces + work.supports > cancelled_work * sizes);
    if (lost) work = work_by_energy();
    if (!lost) events_to_follow_ = 0;
    last_work_ = work.forces + work.supports;
  }
  return work;
}

double SingleEventEngine::measure_residual(std::vector<double>& residual) {
  internal_force(network_, secants_, displacement_, internal_);
  for (std::size_t slot = 0; slot < internal_.forces.size(); ++slot) {
    internal_.forces[slot] = loads_.forces[slot] - internal_.forces[slot];
  }
  residual = unknowns_.restrict(internal_.forces);
  double square = 0.0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (!ground_stiffness_.empty()) {
      residual[k] += ground_load_[k] - ground_stiffness_[k] * solution_[k];
    }
    square += residual[k] * residual[k];
  }
  return std::sqrt(square) / load_norm_;
}

Equilibrium SingleEventEngine::check_equilibrium() {
  if (stale_) refresh();
  std::vector<double> residual;
  const double size = measure_residual(residual);
  const double tolerance = std::max(options_.residual_tolerance, residual_floor_);
  // Written so that a residual that is not a number is not within any tolerance.
  if (size <= options_.residual_tolerance) residual_floor_ = 0.0;
  if (size <= tolerance) return {size, internal_.energy};
  Equilibrium equilibrium = polish();
  // Refined displacements do not help the next event, which the factor alone makes.
  const double usable = std::max(options_.residual_tolerance, factor_floor_);
  if (!(equilibrium.residual <= tolerance) || !(factor_error_ <= usable)) {
    factorize();
    equilibrium = polish();
    // A body on the verge of separation moves so far that even a fresh factor leaves more than the
    // tolerance; factorising again for less than twice that would be work for nothing.
    residual_floor_ = 2.0 * equilibrium.residual;
    factor_floor_ = 2.0 * factor_error_;
    if (!(equilibrium.residual <= hopeless_residual)) {
      throw SolverError(fmt::format(
          "a fresh factor leaves {:.1e} of the load out of balance: the body is on the verge of "
          "separation and its stiffness matrix is singular to working precision",
          equilibrium.residual));
    }
  }
  if (equilibrium.residual <= options_.residual_tolerance) residual_floor_ = 0.0;
  return equilibrium;
}

void SingleEventEngine::factorize() {
  auto stiffness = assemble_stiffness(network_, secants_, unknowns_);
  for (std::size_t k = 0; k < ground_stiffness_.size(); ++k) {
    const Index unknown = static_cast<Index>(k);
    stiffness.coeffRef(unknown, unknown) += ground_stiffness_[k];
  }
  factor_->refactorize(stiffness);
  refresh();
}

Index SingleEventEngine::most_mobile_unknown(const SparseVector& x) {
  std::vector<double> direction(solution_.size(), 0.0);
  for (int k = 0; k < x.size(); ++k) direction[x.rows[k]] = x.values[k];
  factor_->solve(direction, direction);
  const auto largest = std::max_element(direction.begin(), direction.end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  return static_cast<Index>(largest - direction.begin());
}

/// That of the stiffest bond; of a rotation the largest bending stiffness.
double SingleEventEngine::ground_stiffness_of(Index unknown) const {
  const auto component = static_cast<int>(slot_of_[unknown] % network_.width());
  if (component < network_.dim()) {
    return *std::max_element(network_.stiffness.begin(),
                             network_.stiffness.begin() + network_.first_tie);
  }
  double largest = 0.0;
  for (Index e = 0; e < network_.first_tie; ++e) {
    largest = std::max(largest, network_.bending[e] * std::pow(network_.bonds.lengths[e], 2));
  }
  return largest;
}

void SingleEventEngine::add_ground_spring(Index unknown) {
  if (ground_stiffness_.empty()) {
    ground_stiffness_.assign(solution_.size(), 0.0);
    ground_load_.assign(solution_.size(), 0.0);
  }
  const double stiffness = ground_stiffness_of(unknown);
  SparseVector x;
  x.add(unknown, std::sqrt(stiffness));
  factor_->update(x, solution_);
  ground_stiffness_[unknown] += stiffness;
  ground_load_[unknown] += stiffness * solution_[unknown];
}

/// Springs act on displacements anywhere: from now on all of them are kept current.
void SingleEventEngine::keep_all_current() {
  if (partial_) factor_->keep_current(std::vector<std::uint8_t>(solution_.size(), 1));
  if (stale_) refresh();
  partial_ = false;
}

int SingleEventEngine::cut(std::span<const Index> elements) {
  keep_all_current();
  int springs = 0;
  const int most = network_.dim() == 2 ? 3 : 6;
  for (const Index element : elements) {
    if (secants_[element] == 0.0) continue;
    if (is_frame(element)) {
      springs += cut_frame(element);
      continue;
    }
    const Change change = make_change(element, network_.stiffness[element] * secants_[element]);
    double pivot = pivot_of(change, element, 0.0);
    for (int tries = 0; pivot == 0.0; ++tries) {
      if (tries == most) {
        throw SolverError("a part that comes loose cannot be held by ground springs");
      }
      const double force =
          std::abs(change.extension) * std::sqrt(network_.stiffness[element] * secants_[element]);
      if (force > 1e-6 * load_norm_) {
        throw SolverError("the part that comes loose carries load: the body has separated");
      }
      add_ground_spring(most_mobile_unknown(change.x));
      ++springs;
      pivot = pivot_of(change, element, 0.0);
    }
    if (must_rebuild_ && !rebuild_without(element, 0.0)) {
      throw SolverError("the body without the part that comes loose cannot be factorised");
    }
    commit(change, element, 0.0);
  }
  return springs;
}

}  // namespace perilink
