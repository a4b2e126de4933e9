#include "analysis/explicit_bond_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace perilink {
namespace {

constexpr Index steps_between_checks = 200;
/// Sums are made by blocks of particles, whose size depends on nothing else.
constexpr Index particles_per_block = 256;
constexpr Index blocks_per_thread = 4;

/// Sums over the particles of a block since the beginning.
struct BlockSums {
  double fractured = 0.0;
  double damping = 0.0;
  double external_work = 0.0;
  Index broken_halves = 0;
  double stored = 0.0, kinetic = 0.0;   // of the last row
  double driven = 0.0, supports = 0.0;  // of the last step
  double loaded = 0.0;                  // reference forces times displacements
};

/// Component whose motion or load is the largest, in which the reaction of supports is counted.
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

class BondRun {
 public:
  BondRun(const Network& network, const Unknowns& unknowns, const Loads& loads,
          const ReferenceLoad& reference, const Inertia& inertia, double damping_rate,
          const ExplicitOptions& options, BondRunObserver& observer)
      : network_(network),
        unknowns_(unknowns),
        loads_(loads),
        reference_(reference),
        inertia_(inertia),
        options_(options),
        observer_(observer),
        bonds_(make_explicit_bonds(network)),
        component_(main_component(unknowns, loads)) {
    if (options.duration <= 0.0) throw std::invalid_argument("the duration must be positive");
    result_.critical_time_step = inertia.critical_time_step();
    dt_ = options.time_step > 0.0 ? options.time_step : options.safety * result_.critical_time_step;
    if (dt_ > result_.critical_time_step && options.refuse_unstable) {
      throw std::invalid_argument(
          fmt::format("the time step {:.4g} is larger than the critical one, {:.4g}; take less",
                      dt_, result_.critical_time_step));
    }
    result_.time_step = dt_;
    steps_ = static_cast<Index>(std::ceil(options.duration / dt_));
    between_rows_ = std::max<Index>(1, steps_ / std::max(1, options.rows));
    keep_ = 1.0 / (1.0 + 0.5 * dt_ * damping_rate);
    lose_ = 1.0 - 0.5 * dt_ * damping_rate;
    rate_ = damping_rate;
    const std::size_t slots = unknowns.number.size();
    motion_.displacement.assign(slots, 0.0);
    motion_.velocity.assign(slots, 0.0);
    force_.assign(slots, 0.0);
    sums_.resize((network.particles.size() + particles_per_block - 1) / particles_per_block);
  }

  ExplicitResult run() {
    result_.ending = Ending::completed;
    result_.reason = "the whole duration";
    const auto blocks = static_cast<Index>(sums_.size());
    const int threads =
        std::min<Index>(options_.threads, std::max<Index>(1, blocks / blocks_per_thread));
#pragma omp parallel num_threads(threads)
    for (Index step = 0; step <= steps_ && !done_; ++step) one_step(step);
    if (failure_) std::rethrow_exception(failure_);
    return result_;
  }

 private:
  double load_factor(Index step) const { return ramped_load_factor(step * dt_, options_.ramp); }
  bool is_row(Index step) const { return step % between_rows_ == 0 || step == steps_; }
  Index begin(Index block) const { return block * particles_per_block; }
  Index end(Index block) const {
    return std::min(network_.particles.size(), begin(block) + particles_per_block);
  }

  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const auto blocks = static_cast<Index>(sums_.size());
    const bool looked_at = is_row(step) || step % steps_between_checks == 0;
    const double factor = load_factor(step), next = load_factor(step + 1);
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) {
      const BondLosses losses = bonds_->forces(begin(b), end(b), dt_, motion_, force_);
      sums_[b].fractured += losses.fractured;
      sums_[b].broken_halves += losses.broken_halves;
    }
    if (looked_at) {
#pragma omp for schedule(static)
      for (Index b = 0; b < blocks; ++b) measure(b);
#pragma omp single
      look(step);
    }
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) advance(b, factor, next - factor);
#pragma omp single
    note_reactions(step);
  }

  void measure(Index block) {
    BlockSums& sums = sums_[block];
    sums.stored = bonds_->stored(begin(block), end(block), dt_, motion_);
    sums.kinetic = sums.loaded = 0.0;
    for_slots(block, [&](std::size_t slot) {
      const double u = motion_.displacement[slot], v = motion_.velocity[slot];
      sums.kinetic += 0.5 * inertia_.mass[slot] * v * v;
      sums.loaded += loads_.forces[slot] * u;
      if (network_.support_stiffness.empty()) return;
      sums.stored += 0.5 * network_.support_stiffness[slot] * u * (u - dt_ * v);
    });
  }

  template <class Visit>
  void for_slots(Index block, Visit visit) {
    const auto width = static_cast<std::size_t>(unknowns_.width);
    for (std::size_t slot = begin(block) * width; slot < end(block) * width; ++slot) visit(slot);
  }

  void advance(Index block, double factor, double increment) {
    BlockSums& sums = sums_[block];
    sums.driven = sums.supports = 0.0;
    for_slots(block, [&](std::size_t slot) {
      double& u = motion_.displacement[slot];
      double& v = motion_.velocity[slot];
      const double mass = inertia_.mass[slot], applied = factor * loads_.forces[slot];
      double inner = force_[slot];
      if (!network_.support_stiffness.empty()) inner += network_.support_stiffness[slot] * u;
      double work = applied, faster = 0.0;
      if (unknowns_.number[slot] != no_index) {
        faster = keep_ * (lose_ * v + dt_ * (applied - inner) / mass);
      } else {
        faster = unknowns_.prescribed[slot] * increment / dt_;
        const double reaction =
            mass * (faster - v) / dt_ + 0.5 * rate_ * mass * (faster + v) + inner - applied;
        work += reaction;
        sums.driven += reaction * unknowns_.prescribed[slot];
        const bool held = unknowns_.prescribed[slot] == 0.0;
        if (held && static_cast<int>(slot % unknowns_.width) == component_) {
          sums.supports += reaction;
        }
      }
      const double twice = v + faster;
      sums.external_work += 0.5 * dt_ * work * twice;
      sums.damping += 0.25 * dt_ * rate_ * mass * twice * twice;
      v = faster;
      u += dt_ * faster;
    });
  }

  void note_reactions(Index step) {
    double driven = 0.0, supports = 0.0;
    for (const BlockSums& block : sums_) {
      driven += block.driven;
      supports += block.supports;
    }
    const double factor = load_factor(step);
    record_.load = reference_.driven ? driven / reference_.value : factor * reference_.value;
    record_.support_reaction = supports;
    if (std::abs(supports) > std::abs(result_.peak_load)) {
      result_.peak_load = supports;
      result_.peak_displacement = reference_.driven ? factor * reference_.value : 0.0;
    }
  }

  void look(Index step) {
    BlockSums all;
    for (const BlockSums& block : sums_) {
      all.stored += block.stored;
      all.kinetic += block.kinetic;
      all.damping += block.damping;
      all.fractured += block.fractured;
      all.external_work += block.external_work;
      all.broken_halves += block.broken_halves;
      all.loaded += block.loaded;
    }
    record_.energy = {all.kinetic, all.stored, 0.0, all.damping, all.fractured, all.external_work};
    check_growth(step);
    guarded([&] { stop_on_request(); });
    if (!is_row(step) && !done_) return;
    record_.step = step;
    record_.time = step * dt_;
    record_.load_factor = load_factor(step);
    record_.displacement =
        reference_.driven ? record_.load_factor * reference_.value : all.loaded / reference_.value;
    record_.broken_bonds = all.broken_halves / 2;
    result_.steps = step;
    result_.last = record_;
    largest_surplus_ = std::max(largest_surplus_, std::abs(record_.energy.surplus()));
    result_.largest_surplus = largest_surplus_ / std::max(supplied_, smallest_);
    const bool last = done_ || step == steps_;
    guarded([&] {
      const BondRunState state{network_, motion_, *bonds_};
      observer_.on_row(record_, state);
      if (last) observer_.on_end(record_, state);
    });
  }

  void stop_on_request() {
    if (done_ || !observer_.stop_requested()) return;
    result_.ending = Ending::interrupted;
    result_.reason = "interrupted";
    done_ = true;
  }

  /// Exceptions must not leave a parallel region: the run ends and run() throws them again.
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (...) {
      failure_ = std::current_exception();
      done_ = true;
    }
  }

  /// Only work from outside can raise kinetic and stored energy.
  void check_growth(Index step) {
    const EnergyBalance& energy = record_.energy;
    const double held = energy.kinetic + energy.stored;
    supplied_ = std::max(supplied_, std::abs(energy.external_work));
    if (held <= 2.0 * supplied_ + smallest_) return;  // false for NaN
    result_.ending = Ending::failed;
    result_.reason = fmt::format(
        "the motion grew out of nothing at step {} (energy {:.3g}, supplied {:.3g}): the time step "
        "{:.4g} is too large; the critical one of the intact body is {:.4g}",
        step, held, supplied_, dt_, result_.critical_time_step);
    done_ = true;
  }

  static constexpr double smallest_ = 1e-290;  ///< keeps bodies at rest from dividing by zero

  const Network& network_;
  const Unknowns& unknowns_;
  const Loads& loads_;
  const ReferenceLoad& reference_;
  const Inertia& inertia_;
  const ExplicitOptions& options_;
  BondRunObserver& observer_;
  std::unique_ptr<ExplicitBonds> bonds_;
  int component_;
  BondMotion motion_;
  std::vector<double> force_;  ///< K u
  std::vector<BlockSums> sums_;
  ExplicitResult result_;
  ExplicitRecord record_;
  double dt_ = 0.0, rate_ = 0.0, keep_ = 1.0, lose_ = 1.0;
  double supplied_ = 0.0, largest_surplus_ = 0.0;
  Index steps_ = 0, between_rows_ = 1;
  bool done_ = false;
  std::exception_ptr failure_;
};

}  // namespace

ExplicitResult run_explicit_bonds(const Network& network, const Unknowns& unknowns,
                                  const Loads& loads, const ReferenceLoad& reference,
                                  const Inertia& inertia, double damping_rate,
                                  const ExplicitOptions& options, BondRunObserver& observer) {
  return BondRun(network, unknowns, loads, reference, inertia, damping_rate, options, observer)
      .run();
}

}  // namespace perilink
