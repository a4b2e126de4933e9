#include "app/run/run_kind.hpp"

#include <algorithm>
#include <cmath>

#include "app/process/progress.hpp"
#include "app/run/resume.hpp"
#include "app/run/run_warnings.hpp"
#include "base/build_info.hpp"
#include "base/files.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/gauges.hpp"
#include "results/calibration_text.hpp"
#include "results/state_file.hpp"
#include "results/summary_file.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {

void RunKind::open(const std::filesystem::path& directory, const RunCallbacks& calls,
                   const std::string& saved) {
  directory_ = directory;
  since_opened_.restart();
  if (saved.empty()) {
    files_ = std::make_unique<RunFiles>(input, directory, calls);
    files_->add_to_fields(constant_fields());
    return;
  }
  RunFiles::State files;
  std::string state;
  unpack(saved, files, seconds.analysis, state);
  files_ = std::make_unique<RunFiles>(input, directory, calls, files);
  files_->add_to_fields(constant_fields());
  restore(state);
}

void RunKind::save(const std::string& state) {
  const RunFiles::State files = files_->save();
  sync_files(directory_.string());  // the checkpoint counts on them
  write_checkpoint((directory_ / checkpoint_name).string(),
                   {resumable_case(input, meshes), model_fingerprint(),
                    pack(files, seconds.analysis + since_opened_.seconds(), state)});
}

Index RunKind::rows_of_time(double elements, double particles, double steps) const {
  if (ranks() != nullptr) return 0;
  if (input.output.checkpoint_every) return *input.output.checkpoint_every;
  constexpr double per_element = 2e-9, per_particle = 5e-7;  // of a step, of a state [s]
  const double row = std::max(1.0, steps) * per_element * std::max(1.0, elements);
  return rows_between_checkpoints(per_particle * particles, row);
}

void RunKind::note_rule(std::span<const double> gauges) {
  if (!met_rule_) met_rule_ = met_rule(input, input.stop, gauges);
}

void RunKind::complete_by_rule(RunOutcome run_outcome) const {
  if (!met_rule_ || run_outcome.termination != Termination::interrupted) return;
  run_outcome.termination = Termination::completed;
  run_outcome.reason = *met_rule_;
}

std::string NetworkRun::model_fingerprint() const { return fingerprint_of(model_); }

NetworkRun::NetworkRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
    : RunKind(of_case, on_threads, calls), model_(build_model_visibly(of_case, calls)) {
  plan = size_text(model_);
  notes = model_.notes;
  if (!model_.network.report.calibration) return;
  calibration = calibration_line(*model_.network.report.calibration);
  seconds.parts.emplace_back("calibration", model_.network.report.calibration->seconds);
}

std::string NetworkRun::bond_rate(Index steps) const {
  return rate_text(1.0 * model_.network.num_elements() * steps, seconds.analysis, "bond-steps");
}

void NetworkRun::write_reactions(const StepRecord& row, const std::vector<SupportRegion>& places,
                                 const ModelState& state, ReactionBalance& balance) {
  if (places.empty()) return;
  const ReactionTable table = reaction_table(places, model_, state);
  files_->write_table("reactions", row.step, table.text);
  // A sum of n numbers is at most sqrt(n) times the root of the sum of their squares.
  const double numbers = static_cast<double>(model_.unknowns.number.size());
  balance.add(row.step, table.sum, longest_side(model_.network.particles),
              std::max(1e-8, std::sqrt(numbers) * row.residual), table.round_off);
}

std::string rate_text(double count, double seconds, const std::string& unit) {
  return fmt::format("{:.3g} M {}/s", seconds > 0.0 ? count / seconds / 1e6 : 0.0, unit);
}

Summary summary_of(RunKind& run, const std::filesystem::path& directory) {
  const RunOutcome run_outcome = run.run_outcome();
  const PhaseSeconds& seconds = run.seconds;
  const std::string status = to_string(run_outcome.termination);
  Summary summary;
  summary.notes = run.notes;
  summary.json = summary_head(run.input, run.meshes, status, run_outcome.reason);
  summary.text = (run.input.title.empty() ? run.input.source.path : run.input.title) + "\n";
  summary.line("ended", "{}{}", status,
               run_outcome.reason == status ? "" : " (" + run_outcome.reason + ")");
  run.tell(summary);

  summary.add("notes", summary.notes);
  summary.add("warnings", summary.warnings);
  nlohmann::ordered_json phases = {
      {"set_up", seconds.set_up}, {"analysis", seconds.analysis}, {"output", seconds.output}};
  for (const auto& [part, time] : seconds.parts) phases[part] = time;
  summary.add("seconds", phases);
  const std::string rate = summary.rate.empty() ? "" : fmt::format(" ({})", summary.rate);
  summary.line("time", "set-up {:.2f} s, analysis {:.2f} s{}, output {:.2f} s", seconds.set_up,
               seconds.analysis, rate, seconds.output);
  summary.add("peak_memory_bytes", peak_memory_bytes());
  summary.add("threads", run.threads);
  summary.add("version", program_version());
  summary.add("commit", program_commit());
  for (const std::string& note : summary.notes) summary.line("note", "{}", note);
  for (const std::string& warning : summary.warnings) summary.line("warning", "{}", warning);
  summary.line("results", "{}", directory.string());
  return summary;
}

Model build_model_visibly(const CaseFile& input, const RunCallbacks& calls) {
  CalibrationProgress progress(calls.quiet);
  const auto on_search = [&](int search, double unbalanced) {
    progress.update(search, unbalanced);
    if (calls.on_calibration) calls.on_calibration(search, unbalanced);
  };
  return build_model(input, {on_search, calls.calibrations});
}

}  // namespace perilink
