#include "analysis/quasistatic/equilibrium/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/quasistatic/equilibrium/mechanism.hpp"
#include "assembly/linear_elements.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"

namespace perilink {
namespace {

/// Residual of a fresh factor above which all further figures would be meaningless [-].
constexpr double hopeless_residual = 1e-3;

/// Residuals up to this many tolerances are removed by a plain step of refinement if a fresh factor
/// leaves as much. Double precision has enough digits for it.
constexpr double most_to_refine = 10.0;

/// Work over the sum of its absolute terms below which seven of sixteen digits are lost [-].
constexpr double cancelled_work = 1e-7;

/// Number of events at which the work of prescribed displacements is updated by the growth of the
/// compliance. It is then summed over the elements again.
constexpr int most_events_to_follow = 16;

/// Returns the stiffness of elements and ground springs.
SparseMatrix stiffness_of(const Network& network, Secants secants, const Unknowns& unknowns,
                          std::span<const double> ground_springs) {
  SparseMatrix stiffness = assemble_stiffness(network, secants, unknowns);
  for (std::size_t k = 0; k < ground_springs.size(); ++k) {
    const Index unknown = static_cast<Index>(k);
    stiffness.coeffRef(unknown, unknown) += ground_springs[k];
  }
  return stiffness;
}

}  // namespace

Equilibrium::Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options,
                         const Unknowns& unknowns, const ElementState* saved)
    : network_(problem.network),
      unknowns_(&unknowns),
      loads_(&problem.loads),
      options_(options),
      secants_(static_cast<std::size_t>(network_.num_elements()), 1.0),
      has_kept_(network_.has_kept_shear()) {
  if (is_followed_by_subdomains(problem, options)) {
    if (problem.embedded)
      throw std::invalid_argument(
          "conjugate gradients with subdomains do not support embedded particles");
    auto subdomains = std::make_unique<SubdomainFactor>(network_, options.subdomains);
    subdomains_ = subdomains.get();
    factor_ = std::move(subdomains);
  } else {
    factor_ = make_factor(options.route, options.threads);
  }
  for (const double stiffness : network_.stiffness) stiffness_sum_ += stiffness;
  for (const double stiffness : network_.support_stiffness) stiffness_sum_ += stiffness;
  if (network_.has_closing() || has_kept_) axial_ = secants_;
  damaged_ = network_.contacts();
  for (const Index element : damaged_) secants_[element] = 0.0;  // closed at first
  if (saved != nullptr) {
    secants_ = saved->secants;
    axial_ = saved->axial;
    damaged_ = saved->damaged;
    ground_stiffness_ = saved->ground_stiffness;
    ground_load_ = problem.sets.empty() ? saved->ground_load : saved->constant_ground_load;
  }
  find_driven_elements();
  adopt_motion(saved != nullptr);
  if (!ground_stiffness_.empty()) keep_all_current();
  // Stages open cracks as their loads begin to grow.
  if (saved == nullptr && problem.sets.empty()) open_cut_elements();
}

ElementState Equilibrium::state() const {
  return {secants_,     axial_,
          damaged_,     ground_stiffness_,
          ground_load_, constant_ ? constant_->ground_load : std::vector<double>()};
}

double Equilibrium::norm(std::span<const double> values) {
  double square = 0.0;
  for (const double value : values) square += value * value;
  return std::sqrt(square);
}

void Equilibrium::find_driven_elements() {
  driven_spring_work_ = 0.0;
  driven_elements_.clear();
  const std::vector<double>& prescribed = unknowns_->prescribed;
  for (std::size_t slot = 0; slot < network_.support_stiffness.size(); ++slot) {
    driven_spring_work_ += network_.support_stiffness[slot] * prescribed[slot] * prescribed[slot];
  }
  const int width = network_.width();
  auto driven = [&](Index particle) {
    const auto begin = prescribed.begin() + static_cast<std::ptrdiff_t>(particle) * width;
    return std::any_of(begin, begin + width, [](double value) { return value != 0.0; });
  };
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (driven(network_.bonds.first[e]) || driven(network_.bonds.second[e])) {
      driven_elements_.push_back(e);
    }
  }
}

/// Finds the slots with forces. A force at a prescribed displacement is a part of the reaction
/// there, whose work counts.
void Equilibrium::find_loaded_slots() {
  loaded_slots_.clear();
  for (std::size_t slot = 0; slot < unknowns_->number.size(); ++slot) {
    if (unknowns_->number[slot] == no_index) continue;
    if (loads_->forces[slot] != 0.0) loaded_slots_.push_back(slot);
  }
}

/// Makes a new factor for the present unknowns.
/// \param resists  the body is known to resist its loads, and is not examined for mechanisms
void Equilibrium::factorize_anew(bool resists) {
  lags_ = false;
  missed_savings_ = 0.0;
  slot_of_ = unknowns_->slots();
  solution_.assign(static_cast<std::size_t>(unknowns_->count), 0.0);
  if (subdomains_ != nullptr) return subdomains_->begin(*unknowns_, secants(), ground_stiffness_);
  const SparseMatrix stiffness = stiffness_of(network_, secants(), *unknowns_, ground_stiffness_);
  if (resists) return factor_->factorize(stiffness, unknowns_->owners());
  const auto forces_of = [&](std::span<const double> u) {
    return internal_force(network_, secants(), u);
  };
  factorize_stiffness(*factor_, stiffness, *unknowns_, &network_.particles, forces_of);
}

/// Finds the equilibrium under the present unknowns with a new factor.
void Equilibrium::adopt_motion(bool resists) {
  displacement_ = unknowns_->prescribed;
  find_loaded_slots();
  factorize_anew(resists);
  choose_current_unknowns();
  adopt_load();
}

/// Finds the displacements under the present load.
void Equilibrium::adopt_load() {
  load_norm_ = norm(present_load());
  // Displacements prescribed on free parts cause no load.
  if (load_norm_ == 0.0) load_norm_ = 1.0;
  residual_floor_ = factor_floor_ = 0.0;
  refresh();
  std::vector<double> residual;
  fresh_residual_ = measure_residual(residual);
  refine(residual);
}

Freedom Equilibrium::change_motion(const Unknowns& unknowns) {
  if (!ground_stiffness_.empty()) {
    throw SolverError("the unknowns cannot change while ground springs hold a loose part");
  }
  if (unknowns.prescribed != unknowns_->prescribed) {
    throw std::invalid_argument("new unknowns must keep the prescribed motions");
  }
  bring_factor_up();
  if (stale_) refresh();
  events_to_follow_ = 0;
  const LoadWork before = work();
  const ConstantWork beside = constant_ ? constant_work() : ConstantWork();
  const Unknowns* const old = unknowns_;
  try {
    use_motion(unknowns);
    EventOutcome sides;
    if (!axial_.empty()) settle_closing(sides);
    if (sides.mechanism) {
      throw SolverError("only closed bonds would hold the released particles");
    }
    events_to_follow_ = 0;
    const LoadWork after = work();
    if (before.separated || after.separated) {
      throw SolverError(
          "the unknowns cannot change while the body does not resist the prescribed displacements");
    }
    Freedom freedom{after.compliance() - before.compliance()};
    if (constant_) freedom.beside = permanent_growth(beside, constant_work());
    return freedom;
  } catch (const std::exception&) {
    use_motion(*old);
    throw;
  }
}

void Equilibrium::use_motion(const Unknowns& unknowns) {
  unknowns_ = &unknowns;
  if (constant_) {
    std::vector<double> stays = std::move(constant_->unknowns.prescribed);
    constant_->unknowns = unknowns;
    constant_->unknowns.prescribed = std::move(stays);
  }
  adopt_motion();
}

std::vector<double> Equilibrium::present_load() const {
  std::vector<double> load = assemble_right_hand_side(network_, secants(), *unknowns_, *loads_);
  for (std::size_t k = 0; k < ground_load_.size(); ++k) load[k] += ground_load_[k];
  return load;
}

/// Solves for all displacements with the present factor.
void Equilibrium::refresh() {
  factor_->solve(present_load(), solution_);
  scatter_solution();
  stale_ = false;
  force_work_ = work_of_forces();
  if (constant_) refresh_constant();
}

/// Makes one step of iterative refinement; the current `residual` becomes the correction.
void Equilibrium::refine(std::vector<double>& residual) {
  if (subdomains_ != nullptr) {
    subdomains_->correct(residual, 2.0 * internal_.energy);
  } else {
    factor_->solve(residual, residual);
  }
  for (std::size_t k = 0; k < residual.size(); ++k) solution_[k] += residual[k];
  scatter_solution();
  force_work_ = work_of_forces();
}

void Equilibrium::scatter_solution() {
  if (unknowns_->carries()) {
    unknowns_->expand(solution_, moving_slots_, displacement_);
    return;
  }
  for (std::size_t k = 0; k < slot_of_.size(); ++k) displacement_[slot_of_[k]] = solution_[k];
  find_largest_motion();
}

/// Returns the work of forces and reactions. The latter is summed over elements at prescribed
/// displacements, or follows from the growth of the compliance.
LoadWork Equilibrium::work() {
  if (partial_) return {force_work_, 0.0};
  const double forces = work_of_forces();
  if (driven_elements_.empty()) return {forces, 0.0};
  LoadWork work{forces, forces - followed_compliance_};
  const double whole = work.forces + work.supports;
  const bool halved = whole < 0.5 * followed_from_;
  if (events_to_follow_ <= 0 || halved || take_rare_branch("summed work")) {
    work = sum_work();
    if ((work.forces + work.supports) * next_to_infinite < last_work_) work.separated = true;
    followed_from_ = work.forces + work.supports;
    followed_compliance_ = work.compliance();
    events_to_follow_ = work.separated ? 0 : most_events_to_follow;
  }
  if (!work.separated) last_work_ = work.forces + work.supports;
  return work;
}

LoadWork Equilibrium::sum_work() {
  LoadWork work{work_of_forces(), driven_spring_work_};
  double sizes = driven_spring_work_;
  for (const Index e : driven_elements_) {
    if (secants().axial(e) == 0.0) continue;
    const auto [share, size] = driven_work_of(e);
    work.supports += share;
    sizes += size;
  }
  if (network_.cells) {
    const auto [share, size] =
        work_between(*network_.cells, network_.width(), displacement_, unknowns_->prescribed);
    work.supports += share;
    sizes += size;
  }
  return work.forces + work.supports > cancelled_work * sizes ? work : work_by_energy();
}

/// Returns the work at load factor 1 of an element's forces on prescribed displacements, and the
/// sum of its absolute terms.
std::pair<double, double> Equilibrium::driven_work_of(Index element) const {
  double work = 0.0, sizes = 0.0;
  const auto add = [&](const Removal& modes) {
    const Deformations deformation = deformations(modes, element);
    for (int m = 0; m < modes.rank; ++m) {
      work += deformation[m] * modes.prescribed[m];
      double size = std::abs(modes.prescribed[m]);
      const SparseVector& x = modes.x[m];
      for (int k = 0; k < x.size(); ++k) size += std::abs(x.values[k] * solution_[x.rows[k]]);
      sizes += size * std::abs(modes.prescribed[m]);
    }
  };
  add(removal_from(*unknowns_, element, 0.0));
  if (!axial_.empty() && is_closed(element)) {
    add(make_axial_removal(network_, *unknowns_, element, 1.0 - secants_[element]));
  }
  return {work, sizes};
}

double Equilibrium::measure_residual(std::vector<double>& residual) {
  internal_force(network_, secants(), where_elements_fail(), internal_);
  for (std::size_t slot = 0; slot < internal_.forces.size(); ++slot) {
    internal_.forces[slot] = loads_->forces[slot] - internal_.forces[slot];
  }
  residual = unknowns_->restrict(internal_.forces);
  double square = 0.0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (!ground_stiffness_.empty()) {
      residual[k] += ground_load_[k] - ground_stiffness_[k] * solution_[k];
    }
    square += residual[k] * residual[k];
  }
  return std::sqrt(square) / load_norm_;
}

Balance Equilibrium::check_cheaply() {
  if (!stale_ || checked_elements_.empty() || take_rare_branch("full check")) return check();
  const double residual = residual_of_current();
  if (residual <= std::max(options_.residual_tolerance, residual_floor_)) {
    return {residual, std::numeric_limits<double>::quiet_NaN()};
  }
  return check();
}

Balance Equilibrium::check() {
  if (stale_) refresh();
  std::vector<double> residual;
  double size = measure_residual(residual);
  if (subdomains_ != nullptr) size = refine_followed(size, residual);
  // Written so that a residual that is not a number exceeds every tolerance.
  if (size <= options_.residual_tolerance) residual_floor_ = 0.0;
  if (size <= std::max(options_.residual_tolerance, residual_floor_) &&
      !take_rare_branch("refinement")) {
    return {size, internal_.energy};
  }
  events_to_follow_ = 0;
  if (lags_) {
    factorize();
    size = measure_residual(residual);
  }
  if (size <= std::min(2.0 * fresh_residual_, most_to_refine * options_.residual_tolerance)) {
    // The factor is as accurate as a fresh one, whose solutions need a step of refinement here.
    refine(residual);
    const double refined = measure_residual(residual);
    if (refined <= options_.residual_tolerance) return {refined, internal_.energy};
  }
  return restore();
}

/// Refines the displacements, with a fresh factor if the present one is not accurate enough.
Balance Equilibrium::restore() {
  const double tolerance = std::max(options_.residual_tolerance, residual_floor_);
  Balance balance = refine_in_extended_precision();
  // Refined displacements do not help the next event, which depends on the factor.
  const double usable = std::max(options_.residual_tolerance, factor_floor_);
  if (!(balance.residual <= tolerance) || !(factor_error_ <= usable)) {
    factorize();
    std::vector<double> residual;
    fresh_residual_ = measure_residual(residual);
    balance = refine_in_extended_precision();
    // A nearly separated body moves so far that even a fresh factor leaves more than the tolerance.
    // Factorising again for less than twice that would be useless.
    residual_floor_ = 2.0 * balance.residual;
    factor_floor_ = 2.0 * factor_error_;
    if (!(balance.residual <= hopeless_residual)) {
      throw SolverError(fmt::format(
          "a fresh factor leaves {:.1e} of the load out of balance: the body is on the verge of "
          "separation and its stiffness matrix is singular to working precision",
          balance.residual));
    }
  }
  if (balance.residual <= options_.residual_tolerance) residual_floor_ = 0.0;
  return balance;
}

void Equilibrium::factorize() {
  if (subdomains_ != nullptr) {
    factorize_anew();
    return refresh();
  }
  factor_->refactorize(stiffness_of(network_, secants(), *unknowns_, ground_stiffness_));
  lags_ = false;
  missed_savings_ = 0.0;
  refresh();
}

}  // namespace perilink
