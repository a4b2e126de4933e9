#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/quasistatic/load_curve.hpp"
#include "app/run/run_files.hpp"
#include "assembly/results/crack_list.hpp"
#include "model/model.hpp"

namespace perilink {

/// Summary of a run: quantities under the keys of summary.json, and the lines printed for them.
struct Summary {
  nlohmann::ordered_json json;
  std::string text;
  std::vector<std::string> notes;     ///< notes for the user
  std::vector<std::string> warnings;  ///< warnings about the results, a sentence each
  std::string outcome;                ///< steps and cracks, for the log
  std::string rate;                   ///< speed of the analysis, "0.2 ms per row"; may be empty

  /// Sets a key; an existing key keeps its position.
  void add(const std::string& key, nlohmann::ordered_json value) { json[key] = std::move(value); }
  void add_note(const std::optional<std::string>& note) {
    if (note) notes.push_back(*note);
  }
  void add_warnings(const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  /// \param label  subject of the line; empty: as the line above
  template <class... Args>
  void line(const std::string& label, fmt::format_string<Args...> format, Args&&... args) {
    text += fmt::format("  {:<14} {}\n", label, fmt::format(format, std::forward<Args>(args)...));
  }
};

/// Reports the peak, and the largest load of all rows.
/// \param reaction  largest reaction of the supports, in time-dependent runs [force]
void tell_peaks(Summary& summary, const CaseFile& input, const PeakWatch& peaks,
                std::optional<double> reaction = {});

/// Adds the text on the peaks of a time-dependent run to the warnings or notes.
void tell_residual_strength(Summary& summary, const CaseFile& input, const PeakWatch& peaks);

/// Reports the energies at the end of a time-dependent run.
void tell_energies(Summary& summary, const EnergyBalance& energy);

/// Optional results of time-dependent runs.
struct MotionExtras {
  double fundamental_period = 0.0;     ///< 0: not computed [time]
  bool yields = false;                 ///< particles flow
  nlohmann::ordered_json constants{};  ///< fit of the constants of state-based particles
};

/// Reports the results of explicit runs of bonds and lattices, without the sizes of their bodies.
void tell_motion(Summary& summary, const CaseFile& input, const RunFiles& files,
                 const ExplicitResult& result, const MotionExtras& extras);

/// Reports the widest of the grown cracks, ten at most; does nothing without cracks.
void tell_cracks(Summary& summary, std::span<const GrownCrack> cracks);

/// Reports the numbers of particles and bonds of a model, and its calibration.
/// \param more  end of the line, ", 60 unknowns"
void tell_body(Summary& summary, const Model& model, const std::string& more = "");

/// Returns "45 particles, 1234 bonds" or "45 particles, 1234 linear elements".
std::string size_text(const Model& model);

/// Returns the peak memory of this process [bytes].
double peak_memory_bytes();

}  // namespace perilink
