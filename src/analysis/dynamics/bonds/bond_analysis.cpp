#include "analysis/dynamics/bonds/bond_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/bonds/break_order.hpp"
#include "analysis/dynamics/bonds/free_motion.hpp"
#include "analysis/dynamics/bonds/particle_blocks.hpp"
#include "analysis/dynamics/time_loop.hpp"

namespace perilink {
namespace {

/// Sums over the particles of a block since the beginning.
struct BlockSums {
  double fractured = 0.0;
  double damping = 0.0;
  double external_work = 0.0;
  double stored = 0.0, kinetic = 0.0;   // in the last row
  double driven = 0.0, supports = 0.0;  // in the last step
  double loaded = 0.0;                  // reference forces times displacements
};

std::unique_ptr<ExplicitBonds> make_bonds(const Network& network, const BondRunRules& rules) {
  if (!network.has_states()) return make_explicit_bonds(network, rules.strain);
  const StateBody& states = rules.states;
  return make_explicit_particles(network, states.problem, states.materials, states.thickness);
}

class BondRun {
 public:
  BondRun(const LoadedNetwork& problem, const Inertia& inertia, const BondRunRules& rules,
          const ExplicitOptions& options, BondRunObserver& observer)
      : network_(problem.network),
        unknowns_(problem.unknowns),
        loads_(problem.loads),
        reference_(problem.reference),
        inertia_(inertia),
        options_(options),
        observer_(observer),
        bonds_(make_bonds(network_, rules)),
        component_(main_component(unknowns_, loads_)),
        blocks_(network_.particles.size(), unknowns_.width),
        broken_(blocks_.count()),
        loop_(options, inertia.critical_time_step()),
        dt_(loop_.time_step()),
        motion_end_(rules.constant_velocity ? options.duration : 0.0),
        rate_(rules.damping_rate) {
    const std::size_t slots = unknowns_.number.size();
    motion_.displacement.assign(slots, 0.0);
    motion_.velocity.assign(slots, 0.0);
    force_.assign(slots, 0.0);
    sums_.resize(static_cast<std::size_t>(blocks_.count()));
    for (std::size_t slot = 0; slot < slots; ++slot) {
      if (unknowns_.number[slot] == no_index) held_.push_back(slot);
    }
  }

  ExplicitResult run() {
    return loop_.run(blocks_.threads(options_.threads), [this](Index step) { one_step(step); });
  }

 private:
  /// Part of the prescribed displacements that is reached.
  double motion_factor(Index step) const {
    return motion_end_ > 0.0 ? step * dt_ / motion_end_ : loop_.load_factor(step);
  }

  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const Index blocks = blocks_.count();
    const double factor = loop_.load_factor(step);
    const double increment = motion_factor(step + 1) - motion_factor(step);
    if (bonds_->has_states()) {
#pragma omp for schedule(static)
      for (Index b = 0; b < blocks; ++b) {
        lose(b, step, bonds_->prepare(blocks_.begin(b), blocks_.end(b), dt_, motion_));
      }
    }
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) {
      lose(b, step, bonds_->forces(blocks_.begin(b), blocks_.end(b), dt_, motion_, force_));
    }
    if (bonds_->has_states()) {
#pragma omp single nowait
      bonds_->finish_step();  // read again behind the next barrier only
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

  void lose(Index block, Index step, const BondLosses& losses) {
    sums_[block].fractured += losses.fractured;
    broken_.add(block, step, losses.broken);
  }

  void measure(Index block) {
    BlockSums& sums = sums_[block];
    sums.stored = bonds_->stored(blocks_.begin(block), blocks_.end(block), dt_, motion_);
    sums.kinetic = sums.loaded = 0.0;
    blocks_.for_slots(block, [&](std::size_t slot) {
      const double u = motion_.displacement[slot], v = motion_.velocity[slot];
      sums.kinetic += 0.5 * inertia_.mass[slot] * v * v;
      sums.loaded += loads_.forces[slot] * u;
      if (network_.support_stiffness.empty()) return;
      sums.stored += 0.5 * network_.support_stiffness[slot] * u * (u - dt_ * v);
    });
  }

  void advance(Index block, double factor, double increment) {
    BlockSums& sums = sums_[block];
    sums.driven = sums.supports = 0.0;
    if (!network_.support_stiffness.empty()) {
      blocks_.for_slots(block, [&](std::size_t slot) {
        force_[slot] += network_.support_stiffness[slot] * motion_.displacement[slot];
      });
    }
    std::size_t next = blocks_.first_slot(block);
    const std::size_t last = blocks_.last_slot(block);
    auto held = std::lower_bound(held_.begin(), held_.end(), next);
    for (; held != held_.end() && *held < last; ++held) {
      advance_free(next, *held, factor, sums);
      advance_held(*held, factor, increment, sums);
      next = *held + 1;
    }
    advance_free(next, last, factor, sums);
  }

  void advance_free(std::size_t first, std::size_t last, double factor, BlockSums& sums) {
    const std::size_t count = last - first;
    const auto part = [&](auto& values) { return std::span(values).subspan(first, count); };
    const MotionWork work =
        move_freely({dt_, factor, rate_}, part(loads_.forces), part(force_), part(inertia_.mass),
                    part(motion_.velocity), part(motion_.displacement));
    sums.external_work += work.external;
    sums.damping += work.damping;
  }

  void advance_held(std::size_t slot, double factor, double increment, BlockSums& sums) {
    double& v = motion_.velocity[slot];
    const double mass = inertia_.mass[slot], applied = factor * loads_.forces[slot];
    const double faster = unknowns_.prescribed[slot] * increment / dt_, twice = v + faster;
    const double reaction =
        mass * (faster - v) / dt_ + 0.5 * rate_ * mass * twice + force_[slot] - applied;
    sums.driven += reaction * unknowns_.prescribed[slot];
    const bool is_support = unknowns_.prescribed[slot] == 0.0;
    if (is_support && static_cast<int>(slot % unknowns_.width) == component_) {
      sums.supports += reaction;
    }
    sums.external_work += 0.5 * dt_ * (applied + reaction) * twice;
    sums.damping += 0.25 * dt_ * rate_ * mass * twice * twice;
    v = faster;
    motion_.displacement[slot] += dt_ * faster;
  }

  void note_reactions(Index step) {
    double driven = 0.0, supports = 0.0;
    for (const BlockSums& block : sums_) {
      driven += block.driven;
      supports += block.supports;
    }
    const double factor = loop_.load_factor(step);
    record_.load = reference_.driven ? driven / reference_.value : factor * reference_.value;
    record_.support_reaction = supports;
    loop_.note_reaction(supports, reference_.driven ? motion_factor(step) * reference_.value : 0.0);
  }

  void look(Index step) {
    BlockSums all;
    for (const BlockSums& block : sums_) {
      all.stored += block.stored;
      all.kinetic += block.kinetic;
      all.damping += block.damping;
      all.fractured += block.fractured;
      all.external_work += block.external_work;
      all.loaded += block.loaded;
    }
    record_.energy = {all.kinetic, all.stored, 0.0, all.damping, all.fractured, all.external_work};
    const BondRunState state{network_, motion_, *bonds_, broken_.so_far()};
    loop_.look(step, record_, observer_, state, [&](ExplicitRecord& record) {
      record.displacement = reference_.driven ? motion_factor(step) * reference_.value
                                              : all.loaded / reference_.value;
      (bonds_->has_states() ? record.cracked_particles : record.broken_bonds) =
          static_cast<Index>(state.broken.size());
    });
  }

  const Network& network_;
  const Unknowns& unknowns_;
  const Loads& loads_;
  const ReferenceLoad& reference_;
  const Inertia& inertia_;
  const ExplicitOptions& options_;
  BondRunObserver& observer_;
  std::unique_ptr<ExplicitBonds> bonds_;
  int component_;
  ParticleBlocks blocks_;
  BreakOrder broken_;
  ExplicitLoop loop_;
  double dt_;
  double motion_end_;  ///< when constant velocities end [time]; zero: there are none
  double rate_;
  BondMotion motion_;
  std::vector<double> force_;      ///< K u
  std::vector<std::size_t> held_;  ///< prescribed components, ascending
  std::vector<BlockSums> sums_;
  ExplicitRecord record_;
};

}  // namespace

int main_component(const Unknowns& unknowns, const Loads& loads) {
  std::vector<double> driven(unknowns.width, 0.0), loaded(unknowns.width, 0.0);
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    double& largest = driven[slot % unknowns.width];
    largest = std::max(largest, std::abs(unknowns.prescribed[slot]));
    loaded[slot % unknowns.width] += loads.forces[slot];
  }
  const auto motion = std::max_element(driven.begin(), driven.end());
  if (*motion > 0.0) return static_cast<int>(motion - driven.begin());
  const auto force = std::max_element(loaded.begin(), loaded.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<int>(force - loaded.begin());
}

ExplicitResult run_explicit_bonds(const LoadedNetwork& problem, const Inertia& inertia,
                                  const BondRunRules& rules, const ExplicitOptions& options,
                                  BondRunObserver& observer) {
  expect_nothing_carried(problem.unknowns);
  return BondRun(problem, inertia, rules, options, observer).run();
}

}  // namespace perilink
