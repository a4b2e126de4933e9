#include "analysis/dynamics/bonds/bond_analysis.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/time_loop.hpp"

namespace perilink {
namespace {

std::unique_ptr<ExplicitBonds> make_bonds(const Network& network, const BondRunRules& rules) {
  if (!network.has_states()) return make_explicit_bonds(network, rules.strain);
  const StateBody& states = rules.states;
  return make_explicit_particles(network, states.problem, states.materials, states.thickness);
}

class BondRun {
 public:
  BondRun(const LoadedNetwork& problem, const Inertia& inertia,
          std::unique_ptr<ExplicitBonds> bonds, const BondRunRules& rules,
          const ExplicitOptions& options, BondRunObserver& observer)
      : options_(options),
        observer_(observer),
        loop_(options, inertia.critical_time_step()),
        body_(problem, inertia, std::move(bonds), loop_.time_step()),
        motion_end_(rules.constant_velocity ? options.duration : 0.0),
        rate_(rules.damping_rate) {
    for (std::size_t slot = 0; slot < body_.force.size(); ++slot) {
      if (body_.is_held(slot)) held_.push_back(slot);
    }
  }

  ExplicitResult run() {
    return loop_.run(body_.blocks.threads(options_.threads),
                     [this](Index step) { one_step(step); });
  }

 private:
  /// Part of the prescribed displacements that is reached.
  double motion_factor(Index step) const {
    return motion_end_ > 0.0 ? step * body_.time_step / motion_end_ : loop_.load_factor(step);
  }

  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const Index blocks = body_.blocks.count();
    const double factor = loop_.load_factor(step);
    const double increment = motion_factor(step + 1) - motion_factor(step);
    if (body_.bonds->has_states()) {
#pragma omp for schedule(static)
      for (Index b = 0; b < blocks; ++b) body_.prepare(b, step);
    }
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) body_.find_forces(b, step);
    if (body_.bonds->has_states()) {
#pragma omp single nowait
      body_.bonds->finish_step();  // read again behind the next barrier only
    }
    if (loop_.is_looked_at(step)) {
#pragma omp for schedule(static)
      for (Index b = 0; b < blocks; ++b) measure(b);
#pragma omp single
      look(step);
    }
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) advance(b, factor, increment);
      // Nobody waits for this: what it reads and writes is used again behind the next barrier only.
#pragma omp single nowait
    note_reactions(step);
  }

  void measure(Index block) {
    MotionSums& sums = body_.sums[block];
    sums.stored = body_.stored(body_.blocks.begin(block), body_.blocks.end(block));
    sums.kinetic = sums.loaded = 0.0;
    body_.blocks.for_slots(block, [&](std::size_t slot) {
      const double v = body_.motion.velocity[slot];
      sums.kinetic += 0.5 * body_.mass[slot] * v * v;
      sums.loaded += body_.loads[slot] * body_.motion.displacement[slot];
    });
  }

  void advance(Index block, double factor, double increment) {
    MotionSums& sums = body_.sums[block];
    sums.driven = sums.supports = 0.0;
    std::size_t next = body_.blocks.first_slot(block);
    const std::size_t last = body_.blocks.last_slot(block);
    auto held = std::lower_bound(held_.begin(), held_.end(), next);
    for (; held != held_.end() && *held < last; ++held) {
      advance_free(next, *held, factor, sums);
      advance_held(*held, factor, increment, sums);
      next = *held + 1;
    }
    advance_free(next, last, factor, sums);
  }

  void advance_free(std::size_t first, std::size_t last, double factor, MotionSums& sums) {
    const auto part = [&](auto& values) { return std::span(values).subspan(first, last - first); };
    const MotionWork work =
        move_freely({body_.time_step, factor, rate_}, part(body_.loads), part(body_.force),
                    part(body_.mass), part(body_.motion.velocity), part(body_.motion.displacement));
    sums.work.external += work.external;
    sums.work.damping += work.damping;
  }

  void advance_held(std::size_t slot, double factor, double increment, MotionSums& sums) {
    double& v = body_.motion.velocity[slot];
    const double dt = body_.time_step, mass = body_.mass[slot];
    const double applied = factor * body_.loads[slot];
    const double faster = body_.unknowns.prescribed[slot] * increment / dt, twice = v + faster;
    const double reaction =
        mass * (faster - v) / dt + 0.5 * rate_ * mass * twice + body_.force[slot] - applied;
    body_.add_reaction(slot, reaction, sums);
    sums.work.external += 0.5 * dt * (applied + reaction) * twice;
    sums.work.damping += 0.25 * dt * rate_ * mass * twice * twice;
    v = faster;
    body_.motion.displacement[slot] += dt * faster;
  }

  void note_reactions(Index step) {
    const MotionSums all = body_.total();
    body_.note_reactions(all, loop_.load_factor(step), record_);
    const ReferenceLoad& reference = body_.reference;
    loop_.note_reaction(all.supports,
                        reference.driven ? motion_factor(step) * reference.value : 0.0);
  }

  void look(Index step) {
    const MotionSums all = body_.total();
    record_.energy = {all.kinetic,      all.stored,    0.0,
                      all.work.damping, all.fractured, all.work.external};
    loop_.look(step, record_, observer_, body_.state(), [&](ExplicitRecord& record) {
      body_.note_motion(all, motion_factor(step), record);
    });
  }

  const ExplicitOptions& options_;
  BondRunObserver& observer_;
  ExplicitLoop loop_;
  MovingBonds body_;
  std::vector<std::size_t> held_;  ///< prescribed components, ascending
  double motion_end_;              ///< when constant velocities end [time]; zero: there are none
  double rate_;
  ExplicitRecord record_;
};

}  // namespace

ExplicitResult run_explicit_bonds(const LoadedNetwork& problem, const Inertia& inertia,
                                  const BondRunRules& rules, const ExplicitOptions& options,
                                  BondRunObserver& observer) {
  expect_nothing_carried(problem.unknowns);
  return BondRun(problem, inertia, make_bonds(problem.network, rules), rules, options, observer)
      .run();
}

}  // namespace perilink
