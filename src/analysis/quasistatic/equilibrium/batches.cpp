// Batches: elements that lose stiffness at once. One equilibrium follows from a change of the
// factor, from a new one, or from conjugate gradients preconditioned by an older one
// (docs/theory/events_and_energy.md, section 8).

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"
#include "solver/conjugate_gradients.hpp"
#include "solver/supernodes/supernodal_kernels.hpp"

namespace perilink {
namespace {

/// Rates of one core, to choose the cheapest way: factorisation, pass through a factor larger than
/// the caches, change by many vectors.
constexpr double factor_flops = 15e9, factor_bytes = 20e9, change_flops = 20e9;
/// Per element: time to assemble the stiffness, and to find the forces of a motion.
constexpr double seconds_to_assemble = 3e-7, seconds_per_force = 1e-8;

/// Time of a solve for forces on the elements of a batch over that of a solve for all forces [-].
constexpr double share_of_solution = 0.7;

/// Unknowns of a three-dimensional body above which conjugate gradients with subdomains follow a
/// batch faster than a factor (docs/theory/large_bodies.md, section 5).
constexpr Index fewest_for_subdomains = 15000;

/// Steps of conjugate gradients that are expected before the first batch.
constexpr int expected_steps = 12;

/// Relative error of conjugate gradients in the energy norm.
constexpr double enough = 1e-11;

/// Returns x'u.
double along(const SparseVector& x, std::span<const double> u) {
  double sum = 0.0;
  for (int k = 0; k < x.size(); ++k) sum += x.values[k] * u[x.rows[k]];
  return sum;
}

}  // namespace

auto Equilibrium::batch_of(std::span<const Weakening> changes) const -> Batch {
  Batch batch;
  batch.lagged = lags_;
  batch.force_work = force_work_;
  batch.solution = solution_;
  if (constant_) batch.constant_solution = constant_->solution;
  for (const auto& [element, secant] : changes) {
    batch.removals.push_back(removal_of(element, secant));
    batch.before.push_back(deformations(batch.removals.back(), element));
    batch.secants.push_back(secant_of(element));
    Deformations& beside = batch.beside.emplace_back();
    const Removal& removal = batch.removals.back();
    for (int m = 0; constant_ && m < removal.rank; ++m) {
      beside[m] = along(removal.x[m], constant_->solution);
    }
    batch.was_first.push_back(secants_[element] == 1.0 ? 1 : 0);
    batch.breaks.push_back(secant == 0.0 ? 1 : 0);
  }
  return batch;
}

bool is_followed_by_subdomains(const LoadedNetwork& problem, const EquilibriumOptions& options) {
  if (options.solver != LinearSolver::automatic) return options.solver == LinearSolver::iterative;
  const Network& network = problem.network;
  const bool is_solid = network.dim() == 3 && !network.shell && !network.is_beam();
  const bool is_plain = !problem.embedded && !problem.unknowns.carries() && problem.sets.empty() &&
                        network.first_slip_spring == network.num_elements() &&
                        !network.has_states();
  if (!(options.event_tolerance > 0.0) || options.route != FactorRoute::in_place || !is_solid ||
      !is_plain || problem.unknowns.count < fewest_for_subdomains) {
    return false;
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.has_limit(e) && network.law(e).is_brittle()) return false;
  }
  return true;
}

FactorStatistics Equilibrium::factor_statistics() const {
  FactorStatistics statistics = factor_->statistics();
  statistics.iterations += gradient_steps_;
  return statistics;
}

/// Chooses by counted work, so that the machine's load and the number of threads do not matter.
auto Equilibrium::cheapest_way(const Batch& batch) -> Way {
  if (take_rare_branch("lagging factor")) return Way::gradients;
  if (take_rare_branch("renewed factor")) return Way::renew;
  const FactorStatistics factor = factor_->statistics();
  const auto elements = static_cast<double>(network_.num_elements());
  const double solution = 2.0 * factor.bytes / factor_bytes;
  const double anew = factor.flops / factor_flops + seconds_to_assemble * elements + solution;
  const int steps = last_steps_ > 0 ? last_steps_ : expected_steps;
  const double search = steps * (solution + seconds_per_force * elements);
  double numbers = 0.0;  // entries of the paths, counted for each vector
  for (const Removal& removal : batch.removals) numbers += factor_->path_of(removal.vectors());
  const double change = 4.0 * numbers / change_flops + share_of_solution * solution;
  if (!lags_ && change <= std::min(anew, search)) return Way::change;
  // A new factor is made once changes of it would have saved as much time as it takes.
  if (lags_) missed_savings_ += std::max(0.0, search - change);
  return missed_savings_ + search < anew ? Way::gradients : Way::renew;
}

double Equilibrium::energy_lost(const Weakening& change) const {
  const Removal removal = removal_of(change.element, change.secant);
  double energy = 0.0;
  for (const double deformation : deformations_now(removal, change.element)) {
    energy += deformation * deformation;
  }
  return energy;
}

std::optional<EventOutcome> Equilibrium::weaken_together(std::span<const Weakening> changes) {
  const auto stands_alone = [&](const Weakening& change) {
    const bool closed = !axial_.empty() && is_closed(change.element);
    return closed || !network_.has_limit(change.element);
  };
  if (look_closer_ || std::ranges::any_of(changes, stands_alone) || take_rare_branch("no batch")) {
    return std::nullopt;
  }
  changed_sides_.clear();
  Batch batch = batch_of(changes);
  EventOutcome outcome;
  outcome.secant = 1.0;
  double removed = 0.0;  // twice the energy that the elements lose
  for (std::size_t k = 0; k < changes.size(); ++k) {
    double energy = 0.0;
    for (const double deformation : batch.before[k]) energy += deformation * deformation;
    EventOutcome own;
    own.released = 0.5 * energy;
    if (constant_) release_constant(batch.removals[k], changes[k].element, own);
    outcome.released += own.released;
    outcome.released_by_permanent += own.released_by_permanent;
    removed += energy;
  }
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const auto [element, secant] = changes[k];
    if (!axial_.empty() && batch.was_first[k] && network_.law(element).closes()) {
      damaged_.push_back(element);
    }
    set_secant(element, secant);
  }
  if (!follow_batch(batch, outcome.pivot)) {
    take_back(changes, batch);
    return std::nullopt;
  }
  for (std::size_t k = 0; k < changes.size(); ++k) {
    add_growth(batch.removals[k], changes[k].element, batch.before[k], batch.beside[k], outcome);
  }
  // Elements whose strain grows very much without their stiffness held the body.
  const bool uncertain = !(outcome.compliance_growth * uncertain_pivot <= removed) ||
                         !(outcome.pivot > uncertain_pivot) || !resists_without(batch) ||
                         take_rare_branch("batch taken back");
  if (!uncertain) {
    follow(outcome);
    try {
      if (!axial_.empty()) settle_closing(outcome);
    } catch (const SolverError&) {
      outcome.mechanism = true;
    }
    if (outcome.mechanism) batch.keeps_factor = false;
  }
  if (uncertain || outcome.mechanism) {
    take_back(changes, batch);
    return std::nullopt;
  }
  return outcome;
}

/// Adds the growth of f'u - R'd from one equilibrium to the other, u_1' (K_1 - K_2) u_2.
void Equilibrium::add_growth(const Removal& removal, Index element, const Deformations& before,
                             const Deformations& beside, EventOutcome& outcome) const {
  const Deformations after = deformations(removal, element);
  for (int m = 0; m < removal.rank; ++m) outcome.compliance_growth += before[m] * after[m];
  for (int m = 0; constant_ && m < removal.rank; ++m) {
    const double held = removal.constant[m];
    const double holds = held + along(removal.x[m], constant_->solution) - beside[m];
    outcome.permanent_growth.linear += before[m] * holds + held * after[m];
    outcome.permanent_growth.constant += held * holds;
  }
}

/// Finds the equilibrium of the present secants.
/// \param pivot  smallest pivot of the batch, if the factor reports it
/// \return false if no equilibrium is found
bool Equilibrium::follow_batch(Batch& batch, double& pivot) {
  must_rebuild_ = false;
  const Way way = subdomains_ != nullptr ? Way::gradients : cheapest_way(batch);
  batch.tells_pivots = way == Way::change;
  if (way == Way::change) return change_factor(batch, pivot);
  must_rebuild_ = subdomains_ == nullptr;  // work products are summed anew
  try {
    batch.keeps_factor = way == Way::gradients;
    if (way == Way::gradients && search_equilibrium()) return true;
    if (subdomains_ != nullptr) return false;
    batch.keeps_factor = false;
    factorize();
    return true;
  } catch (const SolverError&) {
    return false;
  }
}

/// Returns whether the body resists where elements have broken, in motions that the loads do not
/// excite. Forces along their vectors then do little work. Needed only if the factor has not
/// reported their pivots.
bool Equilibrium::resists_without(const Batch& batch) {
  if (batch.tells_pivots) return true;
  std::vector<double> load(solution_.size(), 0.0), motion(solution_.size(), 0.0);
  double size = 0.5, vectors = 0.0;
  for (std::size_t k = 0; k < batch.removals.size(); ++k) {
    if (!batch.breaks[k]) continue;
    for (const SparseVector& x : batch.removals[k].vectors()) {
      for (int j = 0; j < x.size(); ++j) load[x.rows[j]] += size * x.values[j];
      size = size < 1.0 ? size + 0.381966 : size - 0.618034;  // sizes do not repeat
      ++vectors;
    }
  }
  if (vectors == 0.0) return true;
  const std::vector<double> forces = load;
  constexpr double rough = 1e-2;
  try {
    if (subdomains_ != nullptr) {
      // This energy scales the errors.
      subdomains_->correct(load, vectors * std::pow(rough / options_.subdomains.tolerance, 2));
      motion = std::move(load);
    } else if (!lags_) {
      factor_->solve(load, motion);
    } else if (gradients(load, motion, vectors * rough * rough / (enough * enough)) == 0) {
      return false;
    }
  } catch (const SolverError&) {
    return false;
  }
  const double work = scalar_product(forces, motion);
  return work >= 0.0 && work * uncertain_pivot < vectors;
}

void Equilibrium::bring_factor_up() {
  if (lags_) factorize();
}

bool Equilibrium::change_factor(const Batch& batch, double& pivot) {
  std::vector<SparseVector> vectors;
  ForceOfElements forces(solution_.size());
  for (std::size_t k = 0; k < batch.removals.size(); ++k) {
    const Removal& removal = batch.removals[k];
    for (int m = 0; m < removal.rank; ++m) {
      vectors.push_back(removal.x[m]);
      forces.add(removal.x[m], batch.before[k][m], removal.constant[m]);
    }
  }
  pivot = factor_->downdate_together(vectors);
  if (!(pivot > uncertain_pivot)) return false;
  follow_forces(forces);
  stale_ = partial_;
  return true;
}

/// Updates the displacements for forces that elements no longer carry, by the factor of the
/// remaining body.
void Equilibrium::follow_forces(const ForceOfElements& forces) {
  factor_->add_solution(forces.growing, solution_);
  if (constant_ && !constant_->rests) {
    factor_->add_solution(forces.constant, constant_->solution);
  }
  scatter_current();
  if (constant_) scatter_constant();
}

/// Computes K q from the present elements.
void Equilibrium::multiply(std::span<const double> q, std::span<double> result) {
  std::vector<double> motion(displacement_.size(), 0.0);
  if (unknowns_->carries()) {
    unknowns_->expand(q, moving_slots_, motion);
  } else {
    for (std::size_t k = 0; k < slot_of_.size(); ++k) motion[slot_of_[k]] = q[k];
  }
  internal_force(network_, secants(), motion, internal_);
  const std::vector<double> forces = unknowns_->restrict(internal_.forces);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    result[k] = forces[k] + (ground_stiffness_.empty() ? 0.0 : ground_stiffness_[k] * q[k]);
  }
}

/// Corrects a solution by conjugate gradients. The older factor is close to K, so that r'z is
/// nearly the energy of the error.
/// \param residual  residual of the solution; overwritten
/// \param energy    u'K u of the solution
/// \return number of steps; zero if they do not converge
int Equilibrium::gradients(std::vector<double>& residual, std::span<double> solution,
                           double energy) {
  constexpr int most_steps = 60;
  std::vector<double> z(residual.size()), p(residual.size(), 0.0), q(residual.size());
  double before = 1.0;
  for (int step = 0; step < most_steps; ++step) {
    factor_->solve(residual, z);
    const double rz = scalar_product(residual, z);
    if (!(rz > enough * enough * energy)) return rz >= 0.0 ? step + 1 : 0;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + (step > 0 ? rz / before : 0.0) * p[k];
    multiply(p, q);
    const double curvature = scalar_product(p, q);
    if (!(curvature > 0.0)) return 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      solution[k] += rz / curvature * p[k];
      residual[k] -= rz / curvature * q[k];
    }
    before = rz;
  }
  return 0;
}

/// Finds the equilibrium from the last displacements by conjugate gradients.
/// \return false if they do not converge
bool Equilibrium::search_equilibrium() {
  if (stale_) refresh();
  std::vector<double> residual;
  measure_residual(residual);
  const double energy = 2.0 * internal_.energy;
  if (subdomains_ != nullptr) {
    try {
      subdomains_->follow(residual, energy);
    } catch (const SolverError&) {
      return false;
    }
    for (std::size_t k = 0; k < residual.size(); ++k) solution_[k] += residual[k];
    scatter_solution();
    force_work_ = work_of_forces();
    if (constant_) refresh_constant();
    return true;
  }
  lags_ = true;
  last_steps_ = gradients(residual, solution_, energy);
  gradient_steps_ += last_steps_;
  if (last_steps_ == 0) return false;
  scatter_solution();
  force_work_ = work_of_forces();
  return !constant_ || constant_->rests || search_constant();
}

/// Finds the displacements by constant loads.
/// \return false if conjugate gradients do not converge
bool Equilibrium::search_constant() {
  ConstantField& field = *constant_;
  std::vector<double> load =
      assemble_right_hand_side(network_, secants(), field.unknowns, field.loads);
  for (std::size_t k = 0; k < field.ground_load.size(); ++k) load[k] += field.ground_load[k];
  std::vector<double> forces(load.size());
  multiply(field.solution, forces);
  const double energy = scalar_product(field.solution, forces);
  for (std::size_t k = 0; k < load.size(); ++k) load[k] -= forces[k];
  const int steps = gradients(load, field.solution, energy);
  gradient_steps_ += steps;
  scatter_constant();
  return steps > 0;
}

/// Restores the body before the batch.
void Equilibrium::take_back(std::span<const Weakening> changes, const Batch& batch) {
  for (const Index other : changed_sides_) {
    axial_[other] = is_closed(other) ? secants_[other] : 1.0;
  }
  changed_sides_.clear();
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (batch.was_first[k]) std::erase(damaged_, changes[k].element);
    set_secant(changes[k].element, batch.secants[k]);
  }
  damaged_ends_.clear();
  must_rebuild_ = false;
  events_to_follow_ = 0;
  if (!batch.keeps_factor) return factorize();
  lags_ = batch.lagged;
  solution_ = batch.solution;
  scatter_solution();
  stale_ = partial_ && !lags_;
  force_work_ = batch.force_work;
  if (!constant_) return;
  constant_->solution = batch.constant_solution;
  scatter_constant();
}

}  // namespace perilink
