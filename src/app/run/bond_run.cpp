#include "app/run/bond_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/run/run_warnings.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/bonds.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/body/particle_model.hpp"
#include "model/from_case/lattice_case.hpp"
#include "model/gauges.hpp"
#include "model/reactions.hpp"
#include "network/builder/free_bodies.hpp"
#include "results/bar_file.hpp"
#include "results/body_cells.hpp"
#include "results/crack_file.hpp"

namespace perilink {
namespace {

std::vector<double> densities(const CaseFile& input) {
  std::vector<double> density;
  for (const MaterialSection& material : input.materials) density.push_back(*material.density);
  return density;
}

/// Counts unsupported parts of the body with at least a hundredth of its particles: no elastic
/// support and no prescribed displacement acts on them.
Index count_loose_pieces(const Model& model, const BondRunState& state) {
  const Network& network = model.network;
  const auto width = static_cast<std::size_t>(network.width());
  const auto held = held_or_sprung(network, held_components(network, model.unknowns));
  const std::vector<double> secants = state.bonds.secants();
  Index loose = 0;
  for (const Fragment& piece : connected_parts(network, secants)) {
    const bool is_held = std::any_of(piece.particles.begin(), piece.particles.end(), [&](Index i) {
      const auto own = held.begin() + static_cast<std::ptrdiff_t>(i * width);
      return std::find(own, own + static_cast<std::ptrdiff_t>(width), 1) !=
             own + static_cast<std::ptrdiff_t>(width);
    });
    const double size = static_cast<double>(piece.particles.size());
    loose += !is_held && size >= std::max(1.0, 0.01 * network.num_particles());
  }
  return loose;
}

}  // namespace

BondRunCase build_bond_run(const CaseFile& input, const Model& model) {
  BondRunCase built;
  built.rules.damping_rate = input.analysis.damping_rate;
  built.rules.strain = input.analysis.strain;
  built.rules.constant_velocity = !input.velocities.empty();
  if (model.network.has_states()) {
    built.rules.states = state_body_of(input);
    refuse_wide_bands(input, model.network.particles, built.rules.states);
  }
  built.inertia =
      lumped_inertia(model.network, densities(input), input.analysis.masses, built.rules.strain);
  choose_steps(input, built.inertia.critical_time_step(), built.options);
  return built;
}

MovingBondsRun::MovingBondsRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
    : NetworkRun(of_case, on_threads, calls),
      neighbourhoods_(bonds_of_particles(model_.network.bonds, model_.network.particles.size())) {}

void MovingBondsRun::write_state(const ExplicitRecord& record, const BondRunState& state) {
  files_->write_fields(record.step, record.time, [&] {
    if (const auto places = support_regions(input, model_); !places.empty()) {
      const ModelState now{{}, state.motion.displacement, 1.0, record.load_factor};
      files_->write_table("reactions", record.step,
                          reaction_table(places, model_, now, state.reactions()).text);
    }
    FieldMoment moment = moment_of(record, input, model_);
    moment.time = record.time;
    moment.strain = input.analysis.strain;
    const bool bonds_break = !model_.network.has_states();
    std::vector<double> motion = state.motion.displacement;
    follow_particles(model_.network, motion);  // embedded points are not unknowns of these runs
    VtuGrid grid =
        make_field_grid(model_.network, state.bonds.secants(), motion, moment,
                        bonds_break ? state.broken : std::vector<Index>{}, neighbourhoods_);
    if (bonds_break) {
      add_forces_and_cracks(grid, record, state, motion);
      if (input.output.body_cells) {
        add_body_cells(grid,
                       body_cells(model_.network, model_.lattice, model_.cells, neighbourhoods_,
                                  state.bonds.secants()),
                       model_.network.dim());
      }
      return grid;
    }
    number_cracks(grid, state.broken);
    for (VtuArray& field : grid.point_data) {
      if (field.name == "damage") field.values = state.bonds.damage();
    }
    return grid;
  });
}

/// With Green's strains bonds rotate with the body, and small-strain stresses would be wrong.
void MovingBondsRun::add_forces_and_cracks(VtuGrid& grid, const ExplicitRecord& record,
                                           const BondRunState& state,
                                           const std::vector<double>& motion) {
  const std::vector<double> secants = state.bonds.secants();
  const CrackOpenings openings = crack_openings(model_.network, neighbourhoods_, secants, motion);
  add_openings(grid, model_.network, openings, state.broken);
  cracks_ = list_cracks(model_.network, neighbourhoods_, openings, model_.lattice.spacing);
  if (!cracks_.empty()) {
    files_->write_table("cracks", record.step, crack_table(cracks_, model_.network.dim()));
  }
  if (input.analysis.strain == Strain::green) return;
  add_stresses(grid, particle_stresses(stress_input(model_, neighbourhoods_, secants), motion),
               model_.network.dim());
  if (model_.network.bars.bar.empty()) return;
  const BarState bars = bar_state(model_.network, secants, motion);
  add_bars(grid, bars);
  files_->write_table("bars", record.step, bar_table(model_.network, bars));
}

void MovingBondsRun::on_row(const ExplicitRecord& record, const BondRunState& state) {
  std::vector<double> gauges;
  if (!model_.gauges.empty()) {
    const std::vector<double> secants = state.bonds.secants();
    gauges = gauge_values(
        model_, {secants, state.motion.displacement, 1.0, record.load_factor}, neighbourhoods_,
        measures_reactions(model_.gauges) ? state.reactions() : std::vector<double>{});
    note_rule(gauges);
  }
  files_->add_row(record, gauges);
  if (files_->fields_are_due(record.time)) write_state(record, state);
  files_->show_steps(record, steps_);
}

void MovingBondsRun::on_end(const ExplicitRecord& last, const BondRunState& state) {
  write_state(last, state);
  if (input.analysis.strain == Strain::small) {
    overlap_ = deepest_overlap(model_, state.motion.displacement);
  }
  if (!input.symmetry.empty()) {
    const std::vector<double> secants = state.bonds.secants();
    on_symmetry_ = damage_on_symmetry(input, model_, secants);
  }
  if (!model_.network.has_states()) loose_pieces_ = count_loose_pieces(model_, state);
}

void MovingBondsRun::warn_of_motion(Summary& summary, bool impact) const {
  for (auto& warning : {warning_about_overlap(overlap_, model_.network.dim()),
                        warning_about_symmetry(on_symmetry_)}) {
    if (warning) summary.add_warnings({*warning});
  }
  const bool is_free = input.supports.empty() && input.displacements.empty();
  if (impact || input.analysis.strain == Strain::green || is_free) return;
  if (auto warning =
          warning_about_size(files().peaks().highest(), longest_side(model_.network.particles))) {
    summary.add_warnings({std::move(*warning)});
  }
}

void MovingBondsRun::on_iteration(Index load_step, Index iteration, double residual) {
  if (!files_->bar().is_due()) return;
  files_->bar().draw(fmt::format("load step {} of {}, iteration {}, residual {:.1e}", load_step,
                                 steps_, iteration, residual),
                     static_cast<double>(load_step - 1) / steps_);
}

bool MovingBondsRun::stop_requested() { return has_met_rule() || callbacks.asks_to_stop(); }

bool MovingBondsRun::wants_checkpoint(const ExplicitRecord& /*last*/) {
  return !has_met_rule() && checkpoint_rows_ > 0 && files_->rows() % checkpoint_rows_ == 0;
}

void MovingBondsRun::on_checkpoint(const TimeState& state) { save(pack(state)); }

void MovingBondsRun::restore(const std::string& state) { unpack(state, from_.emplace()); }

namespace {

/// A run with type = "explicit" of a body with bonds, integrated in time.
class BondRun final : public MovingBondsRun {
 public:
  BondRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
      : MovingBondsRun(of_case, on_threads, calls), built_(build_bond_run(of_case, model_)) {
    built_.options.threads = threads;
    steps_ = built_.options.steps();
    checkpoint_rows_ = rows_of_time(model_.network.num_elements(), model_.network.particles.size(),
                                    static_cast<double>(steps_) / built_.options.rows);
    plan += fmt::format(", {} of {:.4g} (critical {:.4g})", counted(steps_, "step"),
                        built_.options.time_step, built_.inertia.critical_time_step());
  }

  void analyse() override {
    result_ = run_explicit_bonds(model_, built_.inertia, built_.rules, built_.options, *this,
                                 from_ ? &*from_ : nullptr);
    complete_by_rule(run_outcome());
  }

  RunOutcome run_outcome() override { return {result_.termination, result_.reason}; }

  void tell(Summary& summary) const override {
    MotionExtras extras;
    if (model_.particle_fit) extras.constants = fit_json(*model_.particle_fit);
    tell_motion(summary, input, files(), result_, extras);
    tell_cracks(summary, cracks_);
    tell_body(summary, model_);
    summary.rate = bond_rate(result_.steps);
    const double length = longest_side(model_.network.particles);
    RunFacts facts = run_facts(input, length, files().peaks().highest().load);
    facts.loose_pieces = loose_pieces_;
    if (!model_.modulus.empty()) facts.wave_time /= std::sqrt(std::ranges::max(model_.modulus));
    summary.add_warnings(warnings_about(result_, facts));
    warn_of_motion(summary, facts.impact);
  }

 private:
  BondRunCase built_;
  ExplicitResult result_;
};

}  // namespace

std::unique_ptr<RunKind> make_bond_run(const CaseFile& input, int threads,
                                       const RunCallbacks& calls) {
  return std::make_unique<BondRun>(input, threads, calls);
}

}  // namespace perilink
