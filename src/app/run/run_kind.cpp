#include "app/run/run_kind.hpp"

#include "app/process/progress.hpp"
#include "app/results/calibration_text.hpp"
#include "app/results/summary_file.hpp"
#include "base/build_info.hpp"

namespace perilink {

void RunKind::take_notes(const Model& model) {
  notes = model.notes;
  if (!model.network.calibration) return;
  calibration = calibration_line(*model.network.calibration);
  seconds.parts.emplace_back("calibration", model.network.calibration->seconds);
}

std::string rate_text(double count, double seconds, const std::string& unit) {
  return fmt::format("{:.3g} M {}/s", seconds > 0.0 ? count / seconds / 1e6 : 0.0, unit);
}

Summary summary_of(RunKind& run, const std::filesystem::path& directory) {
  const Verdict verdict = run.verdict();
  const PhaseSeconds& seconds = run.seconds;
  const std::vector<std::string> doubts = run.doubts();
  Summary summary;
  summary.json = summary_head(run.input(), to_string(verdict.ending), verdict.reason);
  summary.text = (run.input().title.empty() ? run.input().path : run.input().title) + "\n";
  summary.line("ended", "{} ({})", to_string(verdict.ending), verdict.reason);
  run.tell(summary);

  summary.add("notes", run.notes);
  summary.add("doubts", doubts);
  nlohmann::ordered_json phases = {
      {"set_up", seconds.set_up}, {"analysis", seconds.analysis}, {"output", seconds.output}};
  for (const auto& [part, time] : seconds.parts) phases[part] = time;
  summary.add("seconds", phases);
  summary.line("time", "set-up {:.2f} s, analysis {:.2f} s ({}), output {:.2f} s", seconds.set_up,
               seconds.analysis, run.rate(), seconds.output);
  summary.add("peak_memory_bytes", peak_memory_bytes());
  summary.add("threads", run.threads());
  summary.add("version", program_version());
  summary.add("commit", program_commit());
  for (const std::string& note : run.notes) summary.line("note", "{}", note);
  for (const std::string& doubt : doubts) summary.line("doubt", "{}", doubt);
  summary.line("results", "{}", directory.string());
  return summary;
}

Model build_model_visibly(const CaseFile& input, bool quiet) {
  CalibrationProgress progress(quiet);
  return build_model(input,
                     [&](int search, double unbalanced) { progress.update(search, unbalanced); });
}

}  // namespace perilink
