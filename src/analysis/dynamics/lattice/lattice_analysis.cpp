#include "analysis/dynamics/lattice/lattice_analysis.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "analysis/dynamics/lattice/body/lattice_loads.hpp"
#include "analysis/dynamics/lattice/lattice_changes.hpp"
#include "analysis/dynamics/lattice/rows/row_energy.hpp"
#include "analysis/dynamics/lattice/rows/row_kernels.hpp"
#include "analysis/dynamics/lattice/rows/row_sweep.hpp"
#include "analysis/dynamics/time_loop.hpp"

namespace perilink {
namespace {

constexpr Index particles_per_thread = 4000;

/// Computes the energies of a row, for steps that are recorded.
void measure_row(const ExplicitModel& model, ExplicitState& state, Index r, double dt) {
  RowSums& sums = state.sums[r];
  sums.stored = half_step_energy(model, state, r, dt);
  sums.kinetic = kinetic_energy(model, state, r);
  sums.cracked = sums.yielded = 0;
  const LatticeRow& row = model.lattice.rows[r];
  const std::vector<double>& stretch = state.flow.stretch;
  for (Index slot = row.first; slot < row.first + row.size; ++slot) {
    sums.cracked += state.damage[slot] > 0.0 ? 1 : 0;
    bool yielded = false;
    for (std::size_t at = slot; at < stretch.size() && !yielded; at += state.damage.size()) {
      yielded = stretch[at] != 0.0;
    }
    sums.yielded += yielded ? 1 : 0;
  }
}

EnergyBalance energy_balance(const std::vector<RowSums>& rows) {
  EnergyBalance energy;
  for (const RowSums& row : rows) {
    energy.kinetic += row.kinetic;
    energy.stored += row.stored;
    energy.internal_damping += row.internal_damping;
    energy.external_damping += row.external_damping;
    energy.fractured += row.fractured;
    energy.plastic += row.plastic;
    energy.external_work += row.external_work;
  }
  return energy;
}

class ExplicitRun {
 public:
  ExplicitRun(const ExplicitModel& model, ExplicitState& state, const ExplicitOptions& options,
              double critical, ExplicitObserver& observer)
      : model_(model),
        state_(state),
        options_(options),
        observer_(observer),
        rows_(static_cast<Index>(model.lattice.rows.size())),
        loop_(options, critical) {
    if (model.alters()) changes_.emplace(model);
  }

  /// Continues from a saved state.
  void restore(const TimeState& from) {
    expect_equal_sizes(from.lattice.displacement.size(), state_.displacement.size());
    expect_equal_sizes(from.lattice.crack_at.size(), state_.crack_at.size());
    expect_equal_sizes(from.lattice.flow.yield.size(), state_.flow.yield.size());
    expect_equal_sizes(from.lattice.sums.size(), state_.sums.size());
    loop_.restore(from.loop);
    record_ = from.record;
    static_cast<LatticeState&>(state_) = from.lattice;
    if (changes_) changes_->rebuild(state_);
  }

  ExplicitResult run() {
    // A step has three barriers, so a thread pays only with enough particles.
    const Index useful = std::max<Index>(1, model_.lattice.particles() / particles_per_thread);
    const Index threads = std::min<Index>(options_.threads, useful);
    prepare_passing(threads);
    return loop_.run(
        threads, [this](Index step) { one_step(step); }, [this] { offer_checkpoint(); });
  }

 private:
  /// Stages of damage and flow, between stretches and forces; none for bodies that never change.
  auto changes(double dt) {
    const Index reach = model_.lattice.reach, flow = model_.material.yields ? reach : 0;
    const auto stage = [this](Index behind, Index ahead, const auto& work) {
      return RowStage{changes_ ? behind : 0, changes_ ? ahead : 0, [this, work](Index r) {
                        if (changes_) work(r);
                      }};
    };
    return std::tuple{
        stage(reach, reach, [this](Index r) { changes_->look(state_, r); }),
        stage(reach, reach, [this, dt](Index r) { changes_->commit(state_, r, dt); }),
        stage(0, flow, [this](Index r) { changes_->update_plastic_bonds(state_, r); }),
        stage(flow, 0, [this, dt](Index r) { changes_->update_plastic_sums(state_, r, dt); }),
        stage(0, reach, [this](Index r) { changes_->update_factors(state_, r); }),
        stage(reach, 0, [this, dt](Index r) { changes_->update_sums(state_, r, dt); })};
  }

  /// Own bonds end in the row itself or in later rows, so sums need the bonds of earlier rows.
  auto stretches(double dt) {
    return std::tuple{
        RowStage{0, 0, [this, dt](Index r) { measure_bonds(model_, state_, r, dt); }},
        RowStage{model_.lattice.reach, 0, [this](Index r) { sum_stretches(model_, state_, r); }}};
  }

  /// Forces need the sums of later rows, motion the forces of earlier rows.
  auto motion(double dt, double factor, double increment) {
    const Index reach = model_.lattice.reach;
    return std::tuple{RowStage{0, reach, [this](Index r) { bond_forces(model_, state_, r); }},
                      RowStage{reach, 0, [this, dt, factor, increment](Index r) {
                                 advance(model_, state_, r, dt, factor, increment);
                               }}};
  }

  auto all_stages(double dt, double factor, double increment) {
    return std::tuple_cat(stretches(dt), changes(dt), motion(dt, factor, increment));
  }

  /// Prepares cache-blocked sweep buffers for steps that are not recorded.
  void prepare_passing(Index threads) {
    const SweepReach reach = reach_of(all_stages(0.0, 0.0, 0.0));
    PassingRows passing;
    passing.blocks = threads;
    passing.alive = reach.ahead + reach.widest + 1;
    // Upper bound: rows left to the edge, rows these read, and the mean over neighbours.
    passing.edge = reach.shortest() + 2 * reach.widest;
    RowPlaces places = passing_places(model_.lattice, passing);
    if (places.slots >= model_.lattice.slots) return;
    passing_ = make_step_numbers(model_, std::move(places));
    passing_blocks_ = threads;
  }

  bool is_passing(Index step) const {
    return passing_blocks_ == omp_get_num_threads() && !loop_.is_looked_at(step);
  }

  /// Run by every thread.
  void one_step(Index step) {
    const double dt = loop_.time_step();
    const double factor = loop_.load_factor(step);
    const double increment = loop_.load_factor(step + 1) - factor;
    const bool passes = is_passing(step);
    if (passes != passed_) {
#pragma omp single
      std::swap(state_.now, passing_);
    }
    if (loop_.is_looked_at(step)) {
      sweep_rows(rows_, stretches(dt));
      look(step);
      sweep_rows(rows_, std::tuple_cat(changes(dt), motion(dt, factor, increment)));
    } else {
      sweep_rows(rows_, all_stages(dt, factor, increment));
    }
#pragma omp single
    note_reactions(step, passes);
  }

  void offer_checkpoint() {
    if (!observer_.wants_checkpoint(loop_.result().last)) return;
    TimeState state;
    state.loop = loop_.state();
    state.record = record_;
    state.lattice = state_;
    observer_.on_checkpoint(state);
  }

  void note_reactions(Index step, bool passes) {
    passed_ = passes;
    state_.step = step + 1;
    note_loads(step);
  }

  /// Writes the loads of a step into the record.
  void note_loads(Index step) {
    double driven = 0.0, supports = 0.0;
    for (const RowReactions& row : state_.reactions) {
      driven += row.driven;
      supports += row.supports;
    }
    const double factor = loop_.load_factor(step);
    record_.load = options_.driven ? driven / options_.reference : factor * options_.reference;
    record_.support_reaction = supports;
    loop_.note_reaction(supports, options_.driven ? factor * options_.reference : 0.0);
  }

  void look(Index step) {
    const double dt = loop_.time_step();
#pragma omp for schedule(static)
    for (Index r = 0; r < rows_; ++r) measure_row(model_, state_, r, dt);
#pragma omp single
    note_row(step);
  }

  void note_row(Index step) {
    record_.energy = energy_balance(state_.sums);
    loop_.look(step, record_, observer_, state_, [this](ExplicitRecord& record) {
      record.displacement = options_.driven ? record.load_factor * options_.reference
                                            : loaded_work(model_, state_) / options_.reference;
      record.cracked_particles = record.yielded_particles = 0;
      for (const RowSums& row : state_.sums) {
        record.cracked_particles += row.cracked;
        record.yielded_particles += row.yielded;
      }
    });
  }

  const ExplicitModel& model_;
  ExplicitState& state_;
  const ExplicitOptions& options_;
  ExplicitObserver& observer_;
  Index rows_;
  std::optional<LatticeChanges> changes_;
  ExplicitLoop loop_;
  ExplicitRecord record_;
  /// step values not in use by the state: sweep buffers, or the whole lattice
  StepNumbers passing_;
  Index passing_blocks_ = 0;  ///< zero: buffers would save no memory traffic
  /// the last step used the buffers; rounds of steps may differ in their threads
  bool passed_ = false;
};

}  // namespace

ExplicitResult run_explicit_analysis(const ExplicitModel& model, ExplicitState& state,
                                     const ExplicitOptions& options, ExplicitObserver& observer,
                                     const TimeState* from) {
  ExplicitRun run(model, state, options, critical_time_step(model), observer);
  if (from != nullptr) run.restore(*from);
  return run.run();
}

}  // namespace perilink
