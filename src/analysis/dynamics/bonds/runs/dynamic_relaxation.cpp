#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/bonds/runs/rest_sums.hpp"
#include "analysis/dynamics/bonds/runs/separation.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/thread_choice.hpp"

namespace perilink {
namespace {

constexpr Index iterations_between_checks = 200;

/// Iterations with one number of threads.
constexpr int iterations_of_a_round = 4;

class Relaxation {
 public:
  Relaxation(const LoadedNetwork& problem, const Inertia& inertia,
             std::unique_ptr<ExplicitBonds> bonds, const RelaxationOptions& options,
             BondRunObserver& observer)
      : options_(options),
        observer_(observer),
        body_(problem, inertia, std::move(bonds), options.safety * inertia.critical_time_step()),
        before_(body_.force),
        first_(body_.force),
        first_force_(body_.force),
        rest_(body_.sums.size()),
        separation_(problem),
        threads_(body_.blocks.threads(options.threads)) {
    for (std::size_t slot = 0; slot < body_.force.size(); ++slot) {
      // Converts moments to forces of equal energy.
      const std::size_t own = slot - slot % body_.unknowns.width;
      weight_.push_back(body_.mass[own] / body_.mass[slot]);
    }
  }

  /// Continues from a saved state.
  void restore(const TimeState& from) {
    const RelaxationState& saved = from.relaxation;
    const std::vector<double>& factors = options_.load_factors;
    if (saved.load_step == 0 || saved.load_step >= factors.size() ||
        saved.load_factor != factors[saved.load_step - 1]) {
      throw std::invalid_argument(
          fmt::format("the saved state is that of another run: its load step {} has the load "
                      "factor {}",
                      saved.load_step, saved.load_factor));
    }
    body_.restore(from.bonds);
    record_ = from.record;
    step_ = saved.load_step;
    factor_ = saved.load_factor;
    fractured_ = saved.fractured;
    largest_residual_ = saved.largest_residual;
    largest_error_ = saved.largest_error;
    square_ = saved.square;
    most_held_ = saved.most_held;
    separation_.restore(saved.examined, saved.is_unstrained);
    result_.iterations = saved.iterations;
    result_.peak_load = saved.peak_load;
  }

  RelaxationResult run() {
    for (; step_ < options_.load_factors.size() && next_.then != AfterIteration::end_run; ++step_) {
      start(options_.load_factors[step_]);
      while (next_.iterates()) {
        threads_.run([&](int threads) { iterate_round(threads); });
      }
      if (next_.then == AfterIteration::end_load_step) rest();
    }
    result_.last = record_;
    result_.displacement = body_.motion.displacement;
    return std::move(result_);
  }

 private:
  /// Starts from rest at the last equilibrium, scaled by the load factor.
  void start(double factor) {
    const double growth = factor_ != 0.0 ? factor / factor_ : 0.0;
    factor_ = factor;
    for (std::size_t slot = 0; slot < body_.force.size(); ++slot) {
      double& u = body_.motion.displacement[slot];
      u = body_.is_held(slot) ? factor * body_.unknowns.prescribed[slot] : growth * u;
      body_.motion.velocity[slot] = 0.0;
    }
    iteration_ = 0;
    next_.then = AfterIteration::iterate;
  }

  void iterate_round(int threads) {
#pragma omp parallel num_threads(threads)
    for (int k = 0; k < iterations_of_a_round && next_.iterates(); ++k) iterate();
  }

  /// Run by every thread; loops end in barriers.
  void iterate() {
#pragma omp for schedule(static)
    for (Index b = 0; b < body_.blocks.count(); ++b) {
      body_.find_forces(b, result_.iterations);
      measure(b);
    }
#pragma omp single
    decide();
#pragma omp for schedule(static)
    for (Index b = 0; b < body_.blocks.count(); ++b) advance(b);
  }

  void measure(Index block) {
    MotionSums& sums = body_.sums[block];
    sums.driven = sums.supports = sums.loaded = 0.0;
    RestSums& rests = rest_[block] = {};
    rests.fractured = sums.fractured;
    body_.blocks.for_slots(block, [&](std::size_t slot) {
      const double u = body_.motion.displacement[slot], mass = body_.mass[slot];
      const double applied = factor_ * body_.loads[slot], inner = body_.force[slot];
      const double rest = inner - applied;
      sums.loaded += body_.loads[slot] * u;
      rests.size += u * mass * u;
      rests.held += weight_[slot] * applied * applied;
      if (body_.is_held(slot)) {
        rests.held += weight_[slot] * rest * rest;
        body_.add_reaction(slot, rest, sums);
        return;
      }
      rests.residual += weight_[slot] * rest * rest;
      rests.push += rest * rest / mass;
      const double way = u - first_[slot], last = body_.time_step * body_.motion.velocity[slot];
      rests.stiffness += way * (inner - first_force_[slot]);
      rests.mass += way * mass * way;
      rests.work += way * applied;
      rests.last_stiffness += last * (inner - before_[slot]);
      rests.last_mass += last * mass * last;
    });
  }

  /// By one thread.
  void decide() {
    RestSums all;
    for (const RestSums& block : rest_) all += block;
    judge(all);
    if (next_.then == AfterIteration::examine) observe([&] { examine_pieces(); });
    ++iteration_;
    ++result_.iterations;
  }

  /// Decides whether the body is in equilibrium and how it is damped.
  void judge(const RestSums& all) {
    const double rest = std::sqrt(all.residual);
    most_held_ = std::max(most_held_, all.held);
    const double held = separation_.is_unstrained() ? most_held_ : all.held;
    result_.residual = held > 0.0 ? rest / std::sqrt(held) : rest > 0.0 ? 1.0 : 0.0;
    if (iteration_ == 0) first_rest_ = rest;
    const bool gave_way = all.fractured != fractured_;
    fractured_ = all.fractured;
    next_.restart = iteration_ == 0 || gave_way;
    damp(all);
    // Estimates the remaining displacement r'K^-2 r over the displacement: no vibration is much
    // slower than the damped one.
    const bool moves = all.push > 0.0 && !separation_.is_unstrained();
    result_.error = moves ? std::sqrt(all.push / all.size) / square_ : 0.0;
    // Loads and reactions are round-off beside the forces in the bonds, and so is the residual.
    if (moves && result_.error <= 1e-6 * options_.tolerance) result_.residual = 0.0;
    const bool at_rest = std::max(result_.residual, result_.error) <= options_.tolerance;
    next_.then = at_rest && !gave_way ? AfterIteration::end_load_step : AfterIteration::iterate;
    if (next_.then == AfterIteration::iterate) look(all, rest);
  }

  void look(const RestSums& all, double rest) {
    const bool grows = !(rest <= largest_growth * std::max(first_rest_, 1e-290));
    const bool ends = iteration_ >= options_.most_iterations;
    const bool is_due = separation_.is_due(fractured_);
    if (grows || (ends && !is_due)) {
      end(Termination::failed,
          fmt::format("load step {} (load factor {}): {} after {} iterations; the residual force "
                      "is {:.2e} of the loads and reactions, the estimated error {:.2e}; the "
                      "tolerance of both is {:.2e}{}",
                      step_ + 1, factor_, grows ? "the motion grows" : "not converged",
                      std::min(iteration_, options_.most_iterations), result_.residual,
                      result_.error, options_.tolerance,
                      grows ? "; give smaller steps in load_factors" : ""));
    }
    const bool checks = iteration_ % iterations_between_checks == 0;
    if ((checks || ends) && !next_.restart && !is_due && options_.strain == Strain::small &&
        separation_.is_mechanism(all.work, factor_, all.stiffness)) {
      collapse(fmt::format("a mechanism: the loads move the part at ({}) without resistance",
                           joined(body_.network.particles.position(moved_most()))));
    }
    // Before the first iteration all contact springs are open.
    const bool follows = separation_.follows_contact();
    if (next_.then == AfterIteration::end_run) return;
    const bool examines = (is_due && (ends || checks)) || (follows && checks);
    if (examines && !(follows && iteration_ == 0)) next_.then = AfterIteration::examine;
    if (!checks) return;
    observe([&] {
      observer_.on_iteration(static_cast<Index>(step_) + 1, iteration_, result_.residual);
      if (observer_.stop_requested()) end(Termination::interrupted, "interrupted");
    });
  }

  /// Returns the particle that moved most since the load step began or bonds broke.
  Index moved_most() const {
    std::size_t most = 0;
    double largest = 0.0;
    for (std::size_t slot = 0; slot < first_.size(); ++slot) {
      const double way = std::abs(body_.motion.displacement[slot] - first_[slot]);
      if (body_.is_held(slot) || way <= largest) continue;
      largest = way;
      most = slot;
    }
    return static_cast<Index>(most / body_.unknowns.width);
  }

  void examine_pieces() {
    const auto pulled = separation_.examine(body_.bonds->secants(), fractured_, factor_ != 0.0);
    if (!pulled.empty()) collapse(pulled);
  }
  void collapse(const std::string& how) {
    end(Termination::collapsed,
        fmt::format("load step {} (load factor {}): {}", step_ + 1, factor_, how));
  }

  /// Ends the run when an observer throws: exceptions must not leave a parallel region.
  template <class Action>
  void observe(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      end(Termination::failed, failure_text(error));
    }
  }

  void end(Termination termination, const std::string& reason) {
    result_.termination = termination;
    result_.reason = reason;
    next_.then = AfterIteration::end_run;
  }

  void damp(const RestSums& all) {
    double square = infinity;
    const auto consider = [&](double stiffness, double mass) {
      if (!(stiffness > 0.0 && mass > 0.0)) return;
      square = std::min(square, stiffness / mass);
    };
    if (!next_.restart) {
      consider(all.stiffness, all.mass);
      consider(all.last_stiffness, all.last_mass);
    }
    const bool known = square < infinity;
    if (known) square_ = square;
    const double rate = known ? 2.0 * std::sqrt(square) : 0.0;
    next_.keep = 1.0 / (1.0 + 0.5 * body_.time_step * rate);
    next_.lose = 1.0 - 0.5 * body_.time_step * rate;
  }

  void advance(Index block) {
    if (!next_.iterates()) return;
    const double dt = body_.time_step;
    body_.blocks.for_slots(block, [&](std::size_t slot) {
      if (body_.is_held(slot)) return;
      double& u = body_.motion.displacement[slot];
      double& v = body_.motion.velocity[slot];
      if (next_.restart) {
        first_[slot] = u;
        first_force_[slot] = body_.force[slot];
      }
      before_[slot] = body_.force[slot];
      const double push = factor_ * body_.loads[slot] - body_.force[slot];
      v = next_.keep * (next_.lose * v + dt * push / body_.mass[slot]);
      u += dt * v;
    });
  }

  /// Ends a load step.
  void rest() {
    std::fill(body_.motion.velocity.begin(), body_.motion.velocity.end(), 0.0);
    for (Index b = 0; b < body_.blocks.count(); ++b) {
      body_.sums[b].stored = body_.stored(body_.blocks.begin(b), body_.blocks.end(b));
    }
    observe([&] {
      note_row();
      if (separation_.is_due(fractured_) || separation_.follows_contact()) examine_pieces();
      if (next_.then == AfterIteration::end_run) return;
      if (separation_.is_unstrained()) {
        note_end();
        return collapse("the body is in pieces and no longer resists the displacements");
      }
      if (step_ + 1 == options_.load_factors.size()) return note_end();
      offer_checkpoint();
      // Load steps may be in equilibrium from the beginning.
      if (observer_.stop_requested()) end(Termination::interrupted, "interrupted");
    });
  }

  void offer_checkpoint() {
    if (!observer_.wants_checkpoint(record_)) return;
    TimeState state;
    state.record = record_;
    body_.save(state.bonds);
    state.relaxation = {step_ + 1,
                        result_.iterations,
                        factor_,
                        result_.peak_load,
                        fractured_,
                        largest_residual_,
                        largest_error_,
                        square_,
                        most_held_,
                        separation_.examined(),
                        separation_.is_unstrained()};
    observer_.on_checkpoint(state);
  }

  void note_row() {
    const MotionSums all = body_.total();
    const ExplicitRecord before = record_;
    record_.step = result_.iterations;
    record_.time = static_cast<double>(step_ + 1);
    record_.load_factor = factor_;
    body_.note_reactions(all, factor_, record_);
    body_.note_motion(all, factor_, record_);
    EnergyBalance& energy = record_.energy;
    energy.stored = all.stored;
    energy.fractured = all.fractured;
    energy.external_work +=
        0.5 * (record_.load + before.load) * (record_.displacement - before.displacement);
    energy.external_damping = energy.external_work - energy.stored - energy.fractured;
    largest_residual_ = std::max(largest_residual_, result_.residual);
    largest_error_ = std::max(largest_error_, result_.error);
    if (std::abs(record_.support_reaction) > std::abs(result_.peak_load)) {
      result_.peak_load = record_.support_reaction;
    }
    observer_.on_row(record_, state());
  }

  BondRunState state() {
    return body_.state([this] { return body_.reactions(factor_, 0.0, 0.0); });
  }

  void note_end() {
    const std::size_t steps = options_.load_factors.size();
    result_.reason = counted(steps, "load step") + " converged";
    result_.residual = largest_residual_;
    result_.error = largest_error_;
    observer_.on_end(record_, state());
  }

  const RelaxationOptions& options_;
  BondRunObserver& observer_;
  MovingBonds body_;
  std::vector<double> before_;               ///< internal forces of the last iteration
  std::vector<double> first_, first_force_;  ///< motion and force where damping was restarted
  std::vector<double> weight_;  ///< factors of squared forces and moments, per component
  std::vector<RestSums> rest_;  ///< per block
  Separation separation_;
  ThreadChoice threads_;
  std::size_t step_ = 0;
  Index iteration_ = 0;
  double factor_ = 0.0, first_rest_ = 0.0, fractured_ = 0.0;
  double largest_residual_ = 0.0, largest_error_ = 0.0;
  double square_ = 0.0;     ///< square of the damped frequency, latest estimate
  double most_held_ = 0.0;  ///< square of the largest loads and reactions
  Decision next_;
  ExplicitRecord record_;
  RelaxationResult result_;
};

}  // namespace

Inertia fictitious_inertia(const Network& network, Strain strain) {
  Index materials = 0;
  for (const Index material : network.particles.material) {
    if (material != no_index) materials = std::max(materials, material + 1);
  }
  return lumped_inertia(network, std::vector<double>(materials, 1.0), MassScaling::uniform, strain);
}

RelaxationResult run_dynamic_relaxation(const LoadedNetwork& problem,
                                        const RelaxationOptions& options, BondRunObserver& observer,
                                        const TimeState* from) {
  expect_nothing_embedded(problem.unknowns);
  const Inertia inertia = fictitious_inertia(problem.network, options.strain);
  Relaxation relaxation(problem, inertia, make_explicit_bonds(problem.network, options.strain),
                        options, observer);
  if (from != nullptr) relaxation.restore(*from);
  return relaxation.run();
}

}  // namespace perilink
