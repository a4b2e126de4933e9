#include "app/run/damage_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/run/resume.hpp"
#include "app/run/run_notes.hpp"
#include "app/run/run_warnings.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/body/strength_notes.hpp"
#include "model/expected_events.hpp"
#include "model/from_case/separated_body.hpp"
#include "model/gauges.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

/// Returns the number of rows between checkpoints by counted work: a new engine over an event.
/// \param batches  elements fail together, and a row takes several solutions
Index rows_of_events(const FactorStatistics& factor, const Network& network, bool batches) {
  constexpr double flops_per_second = 10e9, bytes_per_second = 10e9;
  constexpr double per_unknown = 3e-6, per_element = 1e-6, per_event = 5e-5;
  constexpr double per_force = 1e-8, steps_of_gradients = 12.0, solutions_of_batch = 5.0;
  constexpr Index fewest_rows = 20;
  const double elements = network.num_elements();
  const double engine = per_unknown * factor.size + per_element * elements +
                        factor.flops / flops_per_second + 4.0 * factor.bytes / bytes_per_second;
  double event = per_event + 2e-9 * elements + factor.bytes / bytes_per_second;
  if (batches) event *= solutions_of_batch;
  if (factor.subdomains > 0) event += steps_of_gradients * per_force * elements;
  return std::max(fewest_rows, rows_between_checkpoints(engine, event));
}

}  // namespace

DamageRun::DamageRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
    : NetworkRun(of_case, on_threads, calls), options_(damage_options(input, threads)) {
  options_.begins_again = true;
  options_.stop_requested = callbacks.stop_requested;
  options_.rule_met = [this] {
    const Index stage = records_.last_stage;
    return met_rule(input, stage > 0 ? input.stages[stage - 1].stop : input.stop, records_.gauges);
  };
  mark_broken();
  if (const auto note = note_of_separated_body(input, model_, threads)) notes.push_back(*note);
  if (const auto note = text_of_contacts(model_, options_.engine)) notes.push_back(*note);
  plan += ", " + counted(model_.unknowns.count, "unknown");
  places_held_ = support_regions(input, model_);
  for (const StageSection& stage : input.stages) {
    const auto earlier =
        std::find_if(input.stages.begin(), input.stages.end(),
                     [&](const StageSection& s) { return s.loads == stage.loads; });
    const auto number = static_cast<std::size_t>(earlier - input.stages.begin());
    const bool is_new = number == set_of_stage_.size();
    set_of_stage_.push_back(is_new ? records_.set_factors.size() : set_of_stage_[number]);
    if (is_new) records_.set_factors.push_back(0.0);
  }
}

void DamageRun::analyse() {
  if (!run_) run_ = std::make_unique<EventRun>(model_, options_);
  follow();
  while (run_->missed_release()) {
    begin_again(*run_->missed_release());
    run_ = std::make_unique<EventRun>(model_, options_);
    follow();
  }
  result_ = run_->result();
}

/// Follows the analysis to its end. A failure to write ends it with the results so far.
void DamageRun::follow() {
  if (records_.checkpoint_rows == 0) {
    records_.checkpoint_rows = input.output.checkpoint_every.value_or(rows_of_events(
        run_->factor_statistics(), model_.network, options_.engine.event_tolerance > 0.0));
  }
  try {
    while (const StepRecord* row = run_->next()) {
      add_row(*row, *run_);
      const Index every = records_.checkpoint_rows;
      if (every > 0 && row->step % every == 0) go_on_from_checkpoint();
    }
    if (run_->missed_release()) return;
    const DamageResult result = run_->result();
    if (result.termination == Termination::failed) return;
    write_peak(result, *run_);
    end(result.last, *run_);
  } catch (const std::exception& error) {
    if (!run_) throw;
    failure = std::current_exception();
    run_->fail(error);
  }
}

/// Saves the state, and goes on from it as a run that is taken up again does.
void DamageRun::go_on_from_checkpoint() {
  DamageState state = run_->save();
  if (state.path.over) return;  // a stop rule or a signal ended the run within a load step
  const std::string bytes = pack(records_, state);
  if (2.0 * run_->factor_statistics().bytes > available_memory()) {
    result_ = run_->result();
    run_.reset();
  }
  try {
    run_ = std::make_unique<EventRun>(model_, options_, std::move(state));
  } catch (const SolverError&) {
    // A body that is about to separate may lack digits for a new factor. Without a checkpoint it
    // goes on with the present one.
    if (run_) return;
    throw;
  }
  if (ranks() == nullptr) save(bytes);
}

void DamageRun::restore(const std::string& saved) {
  DamageState state;
  unpack(saved, records_, state);
  if (model_.embedded && !records_.whole.empty()) begin_with_hosts(model_, records_.whole);
  mark_broken();
  run_ = std::make_unique<EventRun>(model_, options_, std::move(state));
}

/// Marks the broken elements, and the contact springs of pre-cracks.
void DamageRun::mark_broken() {
  is_broken_.assign(static_cast<std::size_t>(model_.network.num_elements()), 0);
  for (const Index element : model_.network.contacts()) is_broken_[element] = 1;
  for (const Index element : records_.broken) is_broken_[element] = 1;
}

/// Restarts the run with the elements released so far.
void DamageRun::begin_again(const std::vector<std::uint8_t>& whole) {
  std::filesystem::remove(directory_ / checkpoint_name);  // before the files that it refers to
  begin_with_hosts(model_, whole);
  files_->begin_again();
  Records anew;
  anew.missed_releases = records_.missed_releases + 1;
  anew.whole = whole;
  anew.set_factors.assign(records_.set_factors.size(), 0.0);
  records_ = std::move(anew);
  mark_broken();
}

void DamageRun::tell(Summary& summary) const {
  Equilibria found(result_);
  found.places = places_at_peak();
  const CurvePoint peak{result_.peak_displacement, result_.peak_load};
  const double length = longest_side(model_.network.particles);
  if (result_.beyond_small_strains) {
    found.warnings.push_back(warning_about_crushing(result_.peaks.highest()));
  } else if (auto warning = warning_about_size(peak, length)) {
    found.warnings.push_back(std::move(*warning));
  } else if (auto end = warning_about_end(result_.last.displacement, length)) {
    found.warnings.push_back(std::move(*end));
  }
  for (auto& warning :
       {records_.balance.warning(), warning_about_overlap(records_.overlap, model_.network.dim()),
        warning_about_symmetry(on_symmetry_)}) {
    if (warning) found.warnings.push_back(*warning);
  }
  const bool forced =
      !input.loads.empty() || !input.tractions.empty() || !input.point_loads.empty();
  if (input.analysis.control == LoadControl::steps && !(model_.reference.driven && forced)) {
    if (auto text = warning_about_steps(result_.last, records_.area)) {
      found.warnings.push_back(std::move(*text));
    }
  }
  if (records_.missed_releases > 0) {
    summary.add_note(
        fmt::format("{}: a bond was past its limit before its host element "
                    "released it. Each time the run was restarted with these elements "
                    "released from the beginning. A smaller `alert` in [elements] avoids "
                    "restarts",
                    counted(records_.missed_releases, "missed release")));
  }
  summary.add_note(note_of_clamps(model_, records_.broken));
  if (const auto text = text_of_peaks(result_, model_, records_.broken)) {
    (input.rebar.empty() ? found.warnings : summary.notes).push_back(*text);
  }
  const bool ended = result_.termination == Termination::completed ||
                     result_.termination == Termination::nothing_breaks;
  if (ended && result_.last.step > 1 && result_.last.load == result_.peak_load) {
    summary.add_note(
        "the load was still growing at the end: peak_load is the load of the last row, not a "
        "strength");
  }
  if (input.output.fields_at_peak && peak.load != 0.0 && records_.peaks.find(peak) == nullptr) {
    summary.add_note(
        "there are no fields at the peak: the load climbed on without a fall behind it, or fell "
        "deeper behind other rows");
  }
  tell_stresses(summary, found);
  tell_quasistatic(summary, input, model_, found, seconds.analysis);
  tell_stages(summary, input, result_.stages);
  tell_cracks(summary, records_.cracks);
  if (model_.embedded) tell_elements(summary);
}

/// Reports quantities of the bonds at the peak and at the end, with warnings.
void DamageRun::tell_stresses(Summary& summary, Equilibria& found) const {
  constexpr double round_off = 1e-6;
  const Compression at_peak = compression_at({result_.peak_displacement, result_.peak_load});
  if (at_peak.times > round_off) summary.add("largest_compression", at_peak.stress);
  if (softened_.cracks + softened_.diffuse > 0.0) {
    summary.add("diffuse_energy", softened_.diffuse);
  }
  const bool short_horizon = std::ranges::any_of(
      model_.network.report.strengths,
      [&](const MaterialStrength& strength) { return is_short_horizon(model_.horizon, strength); });
  for (auto& warning : {warning_about_compression(compression_at(result_.peaks.highest())),
                        warning_about_diffuse_softening(softened_, short_horizon)}) {
    if (warning) found.warnings.push_back(*warning);
  }
}

void DamageRun::tell_elements(Summary& summary) const {
  summary.add("elements_at_end", result_.elements);
  summary.add("conversions", result_.conversions);
  summary.add("late_conversions", records_.missed_releases);
  summary.add("unknowns_at_end", result_.unknowns);
  summary.add("freed_energy", result_.last.constraint_energy);
  const double work = std::abs(result_.last.external_work);
  summary.line("conversions", "{}: {} at the end, with {}; freed {:.2g} of the work",
               result_.conversions, counted(result_.elements, "element"),
               counted(result_.unknowns, "unknown"),
               work > 0.0 ? result_.last.constraint_energy / work : 0.0);
}

/// Returns the factor on StepState::displacement.
double DamageRun::scale_of(const StepRecord& record) const {
  return input.stages.empty() ? record.load_factor : 1.0;
}

/// Records the element that failed in the last row. Several failures of one load step are ordered
/// by number.
void DamageRun::note_broken(const StepRecord& record, StateSource& source) {
  const std::size_t count = static_cast<std::size_t>(record.broken_bonds);
  if (count == records_.broken.size()) return;
  if (count == records_.broken.size() + 1 && records_.last_element != no_index &&
      records_.last_events == 1 && input.analysis.control == LoadControl::events) {
    records_.broken.push_back(records_.last_element);
    is_broken_[records_.last_element] = 1;
    return;
  }
  const Secants secants = source.secants();
  for (Index e = 0; e < model_.network.num_elements(); ++e) {
    if (secants[e] != 0.0 || is_broken_[e]) continue;
    records_.broken.push_back(e);
    is_broken_[e] = 1;
  }
}

void DamageRun::note_places(const StepRecord& record, StateSource& source) {
  if (!input.stages.empty() || !has_several_places(model_) ||
      !(std::abs(record.load) > records_.highest))
    return;
  records_.highest = std::abs(record.load);
  records_.high_rows.push_back({records_.highest, record.load_factor, {}});
  if (model_.prescribed_regions.empty()) return;  // reading the state may cost a solve
  const StepState state = source.state();
  records_.high_rows.back().places =
      region_forces(model_, record.load_factor, state.secants, state.displacement, {}, state.whole);
}

std::vector<RegionForce> DamageRun::places_at_peak() const {
  for (const HighRow& row : records_.high_rows) {
    if (row.load != std::abs(result_.peak_load)) continue;
    return model_.prescribed_regions.empty() ? region_forces(model_, row.load_factor, {}, {})
                                             : row.places;
  }
  return {};
}

void DamageRun::show_progress(const StepRecord& record) {
  if (!files_->bar().is_due()) return;
  const StopSection& stop = input.stop;
  std::optional<double> done;
  if (stop.broken_bonds && *stop.broken_bonds > 0) {
    done = static_cast<double>(record.broken_bonds) / *stop.broken_bonds;
  }
  if (stop.displacement && *stop.displacement > 0.0) {
    done = std::max(done.value_or(0.0), std::abs(record.displacement) / *stop.displacement);
  }
  if (!crack_) {
    const bool has_bars = model_.network.first_slip_spring < model_.network.num_elements();
    crack_ = has_bars ? std::nullopt : expected_crack(model_.network);
  }
  if (*crack_) {
    const double events = record.broken_bonds + record.yield_events;
    const double left = (*crack_)->events_left(record.released_energy);
    if (events > 0.0) done = std::max(done.value_or(0.0), events / (events + left));
  }
  if (done) done = std::clamp(*done, 0.0, 1.0);
  std::string state = counted(record.broken_bonds, "broken bond");
  if (record.yield_events > 0) {
    state += ", " + counted(record.yield_events, "yield or softening event");
  }
  state += fmt::format(", load factor {:.4g}", record.load_factor);
  if (record.stage > 0) {
    const std::string& name = input.stages[static_cast<std::size_t>(record.stage - 1)].name;
    state = fmt::format("{}: {}", name, state);
  }
  if (model_.embedded) state += ", " + counted(record.elements, "element");
  files_->bar().draw(state, done);
}

void DamageRun::add_row(const StepRecord& record, StateSource& source) {
  if (record.stage > 0) records_.set_factors[set_of_stage_[record.stage - 1]] = record.load_factor;
  note_broken(record, source);
  note_places(record, source);
  if (!model_.gauges.empty()) {
    records_.gauges = gauge_values(model_, model_state(record, source.state()), neighbourhoods_);
  }
  files_->add_row(record, records_.gauges);
  show_progress(record);
  if (input.output.fields_at_peak) note_peak(record, source);
  if (wants_fields(record)) write_state(record, source);
  const CurvePoint now{record.displacement, record.load};
  records_.area +=
      0.5 * (records_.before.load + now.load) * (now.displacement - records_.before.displacement);
  records_.before = now;
  records_.last_element = record.element;
  records_.last_events = record.events;
  records_.last_stage = record.stage;
}

void DamageRun::end(const StepRecord& last, StateSource& source) {
  if (last.yield_events > 0) softened_ = softened_energy(model_.network, source.secants());
  if (!input.symmetry.empty()) on_symmetry_ = damage_on_symmetry(input, model_, source.secants());
  if (last.step > 0) write_state(last, source);
}

}  // namespace perilink
