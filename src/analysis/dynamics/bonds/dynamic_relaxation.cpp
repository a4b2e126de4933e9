#include "analysis/dynamics/bonds/dynamic_relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/bonds/break_order.hpp"
#include "analysis/dynamics/bonds/particle_blocks.hpp"
#include "base/memory.hpp"

namespace perilink {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Index iterations_between_checks = 200;
/// A residual that has grown so much since the first one will not shrink any more.
constexpr double largest_growth = 1e12;

/// Sums over the particles of a block in an iteration, but for what broke, which is summed up since
/// the beginning.
struct BlockSums {
  double push = 0.0, size = 0.0;       // squares r'M^-1 r and u'M u
  double residual = 0.0, held = 0.0;   // squares of residual forces, of loads and reactions
  double stiffness = 0.0, mass = 0.0;  // over the motion since the load step began
  double last_stiffness = 0.0, last_mass = 0.0;  // over the last step
  double driven = 0.0, supports = 0.0, loaded = 0.0;
  double fractured = 0.0;
};

class Relaxation {
 public:
  Relaxation(const LoadedNetwork& problem, const RelaxationOptions& options,
             BondRunObserver& observer)
      : network_(problem.network),
        unknowns_(problem.unknowns),
        loads_(problem.loads),
        reference_(problem.reference),
        options_(options),
        observer_(observer),
        bonds_(make_explicit_bonds(network_, options.strain)),
        inertia_(fictitious_inertia(network_, options.strain)),
        dt_(options.safety * inertia_.critical_time_step()),
        component_(main_component(unknowns_, loads_)),
        blocks_(network_.particles.size(), unknowns_.width),
        broken_(blocks_.count()) {
    const std::size_t slots = unknowns_.number.size();
    motion_.displacement.assign(slots, 0.0);
    motion_.velocity.assign(slots, 0.0);
    force_ = before_ = first_force_ = first_ = motion_.velocity;
    sums_.resize(static_cast<std::size_t>(blocks_.count()));
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const std::size_t own =
          slot - slot % unknowns_.width;  // moments become forces of like energy
      weight_.push_back(inertia_.mass[own] / inertia_.mass[slot]);
    }
  }

  RelaxationResult run() {
    for (step_ = 0; step_ < options_.load_factors.size() && !done_; ++step_) {
      start(options_.load_factors[step_]);
      iteration_ = 0;
      at_rest_ = false;
#pragma omp parallel num_threads(blocks_.threads(options_.threads))
      while (!at_rest_ && !done_) iterate();
      if (at_rest_) observe([&] { note_row(); });
    }
    if (!done_) {
      result_.reason = fmt::format("{} load step{} at rest", options_.load_factors.size(),
                                   options_.load_factors.size() == 1 ? "" : "s");
      result_.residual = largest_residual_;
      result_.error = largest_error_;
      observe([&] { observer_.on_end(record_, state()); });
    }
    result_.last = record_;
    result_.displacement = motion_.displacement;
    return std::move(result_);
  }

 private:
  BondRunState state() { return {network_, motion_, *bonds_, broken_.so_far()}; }

  /// Where the body is in proportion to the last equilibrium, at rest.
  void start(double factor) {
    const double growth = factor_ != 0.0 ? factor / factor_ : 0.0;
    factor_ = factor;
    for (std::size_t slot = 0; slot < motion_.displacement.size(); ++slot) {
      const bool free = unknowns_.number[slot] != no_index;
      double& u = motion_.displacement[slot];
      u = free ? growth * u : factor * unknowns_.prescribed[slot];
      motion_.velocity[slot] = 0.0;
    }
    starts_ = true;
  }

  /// Run by every thread; loops end in barriers.
  void iterate() {
    const Index blocks = blocks_.count();
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) {
      const BondLosses losses =
          bonds_->forces(blocks_.begin(b), blocks_.end(b), dt_, motion_, force_);
      sums_[b].fractured += losses.fractured;
      broken_.add(b, result_.iterations, losses.broken);
      measure(b);
    }
#pragma omp single
    decide();
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) advance(b);
  }

  double internal(std::size_t slot) const {
    if (network_.support_stiffness.empty()) return force_[slot];
    return force_[slot] + network_.support_stiffness[slot] * motion_.displacement[slot];
  }

  void measure(Index block) {
    BlockSums& sums = sums_[block];
    sums.push = sums.size = sums.residual = sums.held = sums.stiffness = sums.mass =
        sums.last_stiffness = sums.last_mass = sums.driven = sums.supports = sums.loaded = 0.0;
    blocks_.for_slots(block, [&](std::size_t slot) {
      const double u = motion_.displacement[slot], applied = factor_ * loads_.forces[slot];
      const double inner = internal(slot), rest = inner - applied;
      force_[slot] = inner;
      sums.loaded += loads_.forces[slot] * u;
      sums.size += u * inertia_.mass[slot] * u;
      sums.held += weight_[slot] * applied * applied;
      if (unknowns_.number[slot] == no_index) {
        sums.held += weight_[slot] * rest * rest;
        sums.driven += rest * unknowns_.prescribed[slot];
        const bool held = unknowns_.prescribed[slot] == 0.0;
        const bool counts = static_cast<int>(slot % unknowns_.width) == component_;
        if (held && counts) sums.supports += rest;
        return;
      }
      sums.residual += weight_[slot] * rest * rest;
      sums.push += rest * rest / inertia_.mass[slot];
      const double way = u - first_[slot], last = dt_ * motion_.velocity[slot];
      sums.stiffness += way * (inner - first_force_[slot]);
      sums.mass += way * inertia_.mass[slot] * way;
      sums.last_stiffness += last * (inner - before_[slot]);
      sums.last_mass += last * inertia_.mass[slot] * last;
    });
  }

  /// Is the body at rest, and how is it damped? By one thread.
  void decide() {
    BlockSums all;
    for (const BlockSums& block : sums_) {
      all.push += block.push;
      all.size += block.size;
      all.residual += block.residual;
      all.held += block.held;
      all.stiffness += block.stiffness;
      all.mass += block.mass;
      all.last_stiffness += block.last_stiffness;
      all.last_mass += block.last_mass;
      all.fractured += block.fractured;
      all.driven += block.driven;
      all.supports += block.supports;
      all.loaded += block.loaded;
    }
    const double rest = std::sqrt(all.residual);
    result_.residual = all.held > 0.0 ? rest / std::sqrt(all.held) : rest > 0.0 ? 1.0 : 0.0;
    if (starts_) first_rest_ = rest;
    const bool gave_way = all.fractured != fractured_;
    fractured_ = all.fractured;
    restart_ = starts_ || gave_way;  // forces of other bonds tell nothing about the present ones
    damp(all);
    // What is left of the way, r'K^-2 r, against the way itself: no vibration is much slower than
    // the one that is damped.
    result_.error = all.push > 0.0 ? std::sqrt(all.push / all.size) / square_ : 0.0;
    at_rest_ = !gave_way && std::max(result_.residual, result_.error) <= options_.tolerance;
    if (at_rest_) sums_of_row_ = all;
    look(rest);
    starts_ = false;
    ++iteration_;
    ++result_.iterations;
  }

  void look(double rest) {
    if (at_rest_) return;
    const bool grows = !(rest <= largest_growth * std::max(first_rest_, 1e-290));
    if (grows || iteration_ >= options_.most_iterations) {
      end(Ending::failed,
          fmt::format("load step {} (load factor {}): {} after {} iterations; the residual force "
                      "is {:.2e} of the loads and reactions, what is left of the way {:.2e}; the "
                      "tolerance of both is {:.2e}",
                      step_ + 1, factor_, grows ? "the motion grows" : "not at rest", iteration_,
                      result_.residual, result_.error, options_.tolerance));
    }
    if (iteration_ % iterations_between_checks != 0 || done_) return;
    observe([&] {
      observer_.on_iteration(static_cast<Index>(step_) + 1, iteration_, result_.residual);
      if (observer_.stop_requested()) end(Ending::interrupted, "interrupted");
    });
  }

  /// What an observer throws ends the run with all that was found so far; nothing may leave a
  /// parallel region.
  template <class Action>
  void observe(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      end(Ending::failed, failure_text(error));
    }
  }

  void end(Ending ending, const std::string& reason) {
    result_.ending = ending;
    result_.reason = reason;
    done_ = true;
  }

  void damp(const BlockSums& all) {
    double square = infinity;
    const auto consider = [&](double stiffness, double mass) {
      if (!(stiffness > 0.0 && mass > 0.0)) return;
      square = std::min(square, stiffness / mass);
    };
    if (!restart_) {
      consider(all.stiffness, all.mass);
      consider(all.last_stiffness, all.last_mass);
    }
    const bool known = square < infinity;
    if (known) square_ = square;
    const double rate = known ? 2.0 * std::sqrt(square) : 0.0;
    keep_ = 1.0 / (1.0 + 0.5 * dt_ * rate);
    lose_ = 1.0 - 0.5 * dt_ * rate;
  }

  void advance(Index block) {
    if (at_rest_ || done_) return;
    blocks_.for_slots(block, [&](std::size_t slot) {
      if (unknowns_.number[slot] == no_index) return;
      double& u = motion_.displacement[slot];
      double& v = motion_.velocity[slot];
      if (restart_) {
        first_[slot] = u;
        first_force_[slot] = force_[slot];
      }
      before_[slot] = force_[slot];
      const double push = factor_ * loads_.forces[slot] - force_[slot];
      v = keep_ * (lose_ * v + dt_ * push / inertia_.mass[slot]);
      u += dt_ * v;
    });
  }

  void note_row() {
    std::fill(motion_.velocity.begin(), motion_.velocity.end(), 0.0);
    const ExplicitRecord before = record_;
    record_.step = result_.iterations;
    record_.time = static_cast<double>(step_ + 1);
    record_.load_factor = factor_;
    const double value = reference_.value;
    record_.load = reference_.driven ? sums_of_row_.driven / value : factor_ * value;
    record_.support_reaction = sums_of_row_.supports;
    record_.displacement = reference_.driven ? factor_ * value : sums_of_row_.loaded / value;
    record_.broken_bonds = static_cast<Index>(broken_.so_far().size());
    EnergyBalance& energy = record_.energy;
    energy.stored = bonds_->stored(0, network_.particles.size(), 0.0, motion_);
    for (std::size_t slot = 0; slot < network_.support_stiffness.size(); ++slot) {
      const double u = motion_.displacement[slot];
      energy.stored += 0.5 * network_.support_stiffness[slot] * u * u;
    }
    energy.fractured = sums_of_row_.fractured;
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

  const Network& network_;
  const Unknowns& unknowns_;
  const Loads& loads_;
  const ReferenceLoad& reference_;
  const RelaxationOptions& options_;
  BondRunObserver& observer_;
  std::unique_ptr<ExplicitBonds> bonds_;
  Inertia inertia_;
  double dt_;
  int component_;
  ParticleBlocks blocks_;
  BreakOrder broken_;
  BondMotion motion_;
  std::vector<double> force_, before_;       ///< internal forces now and an iteration ago
  std::vector<double> first_, first_force_;  ///< where the damping began to be measured
  std::vector<double> weight_;  ///< factors of squares of forces and moments, per component
  std::vector<BlockSums> sums_;
  std::size_t step_ = 0;
  Index iteration_ = 0;
  double factor_ = 0.0, first_rest_ = 0.0, fractured_ = 0.0;
  double largest_residual_ = 0.0, largest_error_ = 0.0;
  double keep_ = 1.0, lose_ = 1.0;
  double square_ = 0.0;  ///< square of the damped frequency, as last known
  bool at_rest_ = false, done_ = false, starts_ = true, restart_ = true;
  BlockSums sums_of_row_;
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
                                        const RelaxationOptions& options,
                                        BondRunObserver& observer) {
  expect_nothing_carried(problem.unknowns);
  return Relaxation(problem, options, observer).run();
}

}  // namespace perilink
