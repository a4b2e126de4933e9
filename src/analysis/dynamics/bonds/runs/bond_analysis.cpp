#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/bonds/runs/run_share.hpp"
#include "analysis/dynamics/time_loop.hpp"

namespace perilink {
namespace {

std::unique_ptr<ExplicitBonds> make_bonds(const Network& network, const BondRunRules& rules,
                                          BondStencil stencil) {
  if (!network.has_states()) return make_explicit_bonds(network, rules.strain, std::move(stencil));
  const StateBody& states = rules.states;
  return make_explicit_particles(network, states.problem, states.materials, states.thickness);
}

class BondRun {
 public:
  BondRun(const LoadedNetwork& problem, const Inertia& inertia,
          std::unique_ptr<ExplicitBonds> bonds, const BondRunRules& rules,
          const ExplicitOptions& options, BondRunObserver& observer, const Shares& shares = {})
      : options_(options),
        observer_(observer),
        loop_(options, inertia.critical_time_step()),
        body_(problem, inertia, std::move(bonds), loop_.time_step()),
        shares_(shares),
        first_block_(shares.first_block()),
        past_block_(shares.past_block(body_.blocks)),
        motion_end_(rules.constant_velocity ? options.duration : 0.0),
        rate_(rules.damping_rate) {
    for (std::size_t slot = 0; slot < body_.force.size(); ++slot) {
      if (body_.is_held(slot)) held_.push_back(slot);
    }
  }

  /// Continues from a saved state.
  void restore(const TimeState& from) {
    loop_.restore(from.loop);
    record_ = from.record;
    body_.restore(from.bonds);
  }

  ExplicitResult run() {
    const int threads = shares_.own() ? 1 : body_.blocks.threads(options_.threads);
    loop_.run(
        threads, [this](Index step) { one_step(step); }, [this] { offer_checkpoint(); });
    if (shares_.leading) look_back();
    if (shares_.following) shares_.following->report(body_);
    return loop_.result();
  }

  MovingBonds& body() { return body_; }

 private:
  /// Returns the fraction of the prescribed displacements reached.
  double motion_factor(Index step) const {
    return motion_end_ > 0.0 ? step * body_.time_step / motion_end_ : loop_.load_factor(step);
  }

  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const double factor = loop_.load_factor(step);
    const double increment = motion_factor(step + 1) - motion_factor(step);
    if (shares_.own()) shares_.own()->update_ghosts(body_.motion);  // called by one thread
    if (body_.bonds->has_states()) {
#pragma omp for schedule(static)
      for (Index b = first_block_; b < past_block_; ++b) body_.prepare(b, step);
    }
#pragma omp for schedule(static)
    for (Index b = first_block_; b < past_block_; ++b) body_.find_forces(b, step);
    if (body_.bonds->has_states()) {
#pragma omp single nowait
      body_.bonds->finish_step();  // next read after the next barrier
    }
    if (loop_.is_looked_at(step)) {
#pragma omp for schedule(static)
      for (Index b = first_block_; b < past_block_; ++b) measure(b);
#pragma omp single
      look(step);
    }
#pragma omp for schedule(static)
    for (Index b = first_block_; b < past_block_; ++b) advance(b, factor, increment);
      // No barrier: its data are next used after the next barrier.
#pragma omp single nowait
    note_reactions(step);
  }

  void offer_checkpoint() {
    if (shares_.own() || !observer_.wants_checkpoint(loop_.result().last)) return;
    TimeState state;
    state.loop = loop_.state();
    state.record = record_;
    body_.save(state.bonds);
    observer_.on_checkpoint(state);
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
    const double reaction = body_.holding_force(slot, factor, faster, rate_);
    body_.add_reaction(slot, reaction, sums);
    sums.work.external += 0.5 * dt * (applied + reaction) * twice;
    sums.work.damping += 0.25 * dt * rate_ * mass * twice * twice;
    v = faster;
    body_.motion.displacement[slot] += dt * faster;
  }

  void note_reactions(Index step) {
    if (shares_.own()) return shares_.own()->note_supports(body_);
    const MotionSums all = body_.total();
    body_.note_reactions(all, loop_.load_factor(step), record_);
    note_peak(step, all.supports);
  }

  void note_peak(Index step, double supports) {
    const ReferenceLoad& reference = body_.reference;
    loop_.note_reaction(supports, reference.driven ? motion_factor(step) * reference.value : 0.0);
  }

  /// Does the work of note_reactions() for the steps since the last synchronisation.
  void look_back() {
    for (const double supports : shares_.leading->collect(body_)) note_peak(noted_++, supports);
    if (noted_ > 0) {
      body_.note_reactions(body_.total(), loop_.load_factor(noted_ - 1), record_);
    }
  }

  void look(Index step) {
    if (shares_.following) {
      if (!shares_.following->meet(body_)) loop_.leave();
      return;
    }
    if (shares_.leading) look_back();
    const MotionSums all = body_.total();
    record_.energy = {all.kinetic,      all.stored,    0.0,
                      all.work.damping, all.fractured, all.work.external};
    const auto reactions = [&] {
      const double increment = motion_factor(step + 1) - motion_factor(step);
      return body_.reactions(loop_.load_factor(step), increment, rate_);
    };
    loop_.look(step, record_, observer_, body_.state(reactions), [&](ExplicitRecord& record) {
      body_.note_motion(all, motion_factor(step), record);
      if (shares_.leading) shares_.leading->collect_motion(body_);
    });
    if (shares_.leading) shares_.leading->end_meeting(!loop_.is_done());
  }

  const ExplicitOptions& options_;
  BondRunObserver& observer_;
  ExplicitLoop loop_;
  MovingBonds body_;
  Shares shares_;
  Index first_block_, past_block_;  ///< blocks that this process moves
  Index noted_ = 0;                 ///< steps recorded by look_back()
  std::vector<std::size_t> held_;   ///< prescribed components, ascending
  double motion_end_;               ///< end of constant velocities [time]; zero: none
  double rate_;
  ExplicitRecord record_;
};

/// Rules and options of a run, sent to a worker.
struct RunOrder {
  double damping_rate;
  Strain strain;
  bool constant_velocity;
  double frequency_bound;
  ExplicitOptions options;
};

/// Sends the workers their parts of the body and runs the part of the root.
ExplicitResult run_with_ranks(const LoadedNetwork& problem, const Inertia& inertia,
                              const BondRunRules& rules, const ExplicitOptions& options,
                              BondRunObserver& observer) {
  Ranks& ranks = *options.ranks;
  BondStencil stencil = stencil_for(problem.network, rules.strain);
  const ParticleBlocks blocks(problem.network.particles.size(), problem.unknowns.width);
  const Partition partition(problem.network, blocks, ranks.count());
  return lead(ranks, [&] {
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel order;
      order.put(Service::move_bonds);
      order.put(RunOrder{rules.damping_rate, rules.strain, rules.constant_velocity,
                         inertia.frequency_bound, options});
      cut_part(problem, inertia.mass, stencil, partition, rank).pack(order);
      ranks.send(rank, order.bytes());
    }
    LeadingShare share(ranks, problem, partition);
    auto bonds = leading_bonds(make_bonds(problem.network, rules, std::move(stencil)), share);
    ExplicitResult result =
        BondRun(problem, inertia, std::move(bonds), rules, options, observer, {&share}).run();
    result.ranks = ranks.count();
    return result;
  });
}

}  // namespace

ExplicitResult run_explicit_bonds(const LoadedNetwork& problem, const Inertia& inertia,
                                  const BondRunRules& rules, const ExplicitOptions& options,
                                  BondRunObserver& observer, const TimeState* from) {
  expect_nothing_embedded(problem.unknowns);
  if (can_be_shared(problem, options.ranks)) {
    if (from != nullptr) {
      throw std::invalid_argument("several processes cannot continue a saved run");
    }
    return run_with_ranks(problem, inertia, rules, options, observer);
  }
  auto bonds = make_bonds(problem.network, rules, stencil_for(problem.network, rules.strain));
  BondRun run(problem, inertia, std::move(bonds), rules, options, observer);
  if (from != nullptr) run.restore(*from);
  return run.run();
}

void move_bonds_along(Ranks& ranks, Parcel& order) {
  const auto rest = order.get<RunOrder>();
  BondPart own = BondPart::unpack(order);
  const BondRunRules rules{rest.damping_rate, rest.strain, rest.constant_velocity};
  const Inertia inertia{std::move(own.mass), rest.frequency_bound};
  FollowingShare share(ranks, own.part);
  BondRunObserver nobody;
  const LoadedNetwork& body = own.part.body;
  BondRun run(body, inertia, make_bonds(body.network, rules, std::move(own.stencil)), rules,
              rest.options, nobody, {nullptr, &share});
  run.body().component = own.component;
  run.run();
}

}  // namespace perilink
