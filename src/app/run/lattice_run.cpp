#include <algorithm>

#include "analysis/dynamics/time_state.hpp"
#include "app/run/run_kind.hpp"
#include "app/run/run_warnings.hpp"
#include "base/plain_text.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/from_case/lattice_case.hpp"
#include "model/gauges.hpp"
#include "model/reactions.hpp"
#include "results/lattice_fields.hpp"

namespace perilink {
namespace {

/// A run with type = "explicit" of a body with model = "lattice".
class LatticeRun final : public RunKind, private ExplicitObserver {
 public:
  LatticeRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
      : RunKind(of_case, on_threads, calls), built_(build_explicit_case(of_case)) {
    built_.options.threads = threads;
    checkpoint_rows_ =
        rows_of_time(static_cast<double>(built_.bonds), built_.model.lattice.particles(),
                     static_cast<double>(built_.options.steps()) / built_.options.rows);
    notes = built_.notes;
    plan = fmt::format("{}, {}, {} of {:.4g} (critical {:.4g})",
                       counted(built_.model.lattice.particles(), "particle"),
                       counted(built_.bonds, "bond"), counted(built_.options.steps(), "step"),
                       built_.options.time_step, built_.critical_time_step);
  }

  void analyse() override {
    ExplicitState state(built_.model);
    result_ = run_explicit_analysis(built_.model, state, built_.options, *this,
                                    from_ ? &*from_ : nullptr);
  }

  std::string model_fingerprint() const override {
    const ExplicitModel& model = built_.model;
    std::vector<double> loads;
    for (const auto& row : model.prescribed) {
      for (const PrescribedMotion& motion : row) {
        loads.insert(loads.end(), {1.0 * motion.slot, 1.0 * motion.component, motion.amplitude});
      }
    }
    for (const auto& row : model.applied) {
      for (const AppliedForce& force : row) {
        loads.insert(loads.end(), {1.0 * force.slot, 1.0 * force.component, force.value});
      }
    }
    return fingerprint(model.lattice.positions, model.mass, model.volume, loads);
  }

  RunOutcome run_outcome() override { return {result_.termination, result_.reason}; }

  void tell(Summary& summary) const override {
    const LatticeRows& lattice = built_.model.lattice;
    const double steps = 1.0 * lattice.particles() * result_.steps;
    tell_motion(summary, input, files(), result_,
                {built_.fundamental_period, built_.model.material.yields});
    summary.add("particles", lattice.particles());
    summary.add("bonds", built_.bonds);
    summary.line("size", "{}, {}", counted(lattice.particles(), "particle"),
                 counted(built_.bonds, "bond"));
    summary.add("spacing", lattice.spacing);
    summary.add("particle_steps_per_second",
                seconds.analysis > 0.0 ? steps / seconds.analysis : 0.0);
    summary.rate = rate_text(steps, seconds.analysis, "particle-steps");
    const double length = longest_side(lattice.dim, lattice.particles(), [&](Index i, int axis) {
      return lattice.positions[lattice.at(axis, lattice.particle_slot[i])];
    });
    summary.add_warnings(
        warnings_about(result_, run_facts(input, length, files().peaks().highest().load)));
  }

 private:
  void on_row(const ExplicitRecord& record, const ExplicitState& state) override {
    const LatticeRows& lattice = built_.model.lattice;
    std::vector<double> gauges;
    for (const Gauge& gauge : built_.gauges) {
      gauges.push_back(gauge_value(gauge, lattice.dim, [&](Index particle, int axis) {
        return state.displacement[lattice.at(axis, lattice.particle_slot[particle])];
      }));
    }
    files_->add_row(record, gauges);
    if (files_->fields_are_due(record.time)) write_state(record, state);
    files_->show_steps(record, built_.options.steps());
  }

  void on_end(const ExplicitRecord& last, const ExplicitState& state) override {
    write_state(last, state);
  }

  bool stop_requested() override { return callbacks.asks_to_stop(); }
  bool wants_checkpoint(const ExplicitRecord& /*last*/) override {
    return checkpoint_rows_ > 0 && files_->rows() % checkpoint_rows_ == 0;
  }
  void on_checkpoint(const TimeState& state) override { save(pack(state)); }
  void restore(const std::string& state) override { unpack(state, from_.emplace()); }

  void write_state(const ExplicitRecord& record, const ExplicitState& state) {
    files_->write_fields(record.step, record.time, [&] {
      write_reactions(record, state);
      return make_lattice_grid(built_.model, state, record);
    });
  }

  /// Writes the forces of the previous step, as in the history.
  void write_reactions(const ExplicitRecord& record, const ExplicitState& state) {
    const std::vector<SupportRegion> held = support_regions(input, built_.places);
    if (held.empty()) return;
    const LatticeRows& lattice = built_.model.lattice;
    std::vector<double> forces;
    for (const Index slot : lattice.particle_slot) {
      for (int a = 0; a < lattice.dim; ++a) forces.push_back(state.holding[lattice.at(a, slot)]);
    }
    const double before = std::max(0.0, record.time - built_.options.time_step);
    const ModelState then{{}, {}, 1.0, ramped_load_factor(before, built_.options.ramp)};
    files_->write_table("reactions", record.step,
                        reaction_table(held, built_.places, then, std::move(forces)).text);
  }

  ExplicitCase built_;
  ExplicitResult result_;
  Index checkpoint_rows_ = 0;      ///< rows between checkpoints; 0: none
  std::optional<TimeState> from_;  ///< state to go on from
};

}  // namespace

std::unique_ptr<RunKind> make_lattice_run(const CaseFile& input, int threads,
                                          const RunCallbacks& calls) {
  return std::make_unique<LatticeRun>(input, threads, calls);
}

}  // namespace perilink
