#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/quasistatic/load_curve.hpp"
#include "app/model/model.hpp"
#include "app/run/run_files.hpp"
#include "assembly/results/crack_state.hpp"

namespace perilink {

/// What a run tells at its end: quantities under the keys of summary.json, and lines for people.
/// Where a quantity is added its line is written too.
struct Summary {
  nlohmann::ordered_json json;
  std::string text;
  std::vector<std::string> notes;     ///< what is worth knowing
  std::vector<std::string> warnings;  ///< what makes the numbers doubtful, a sentence each
  std::string outcome;                ///< steps and cracks, for the log
  std::string rate;                   ///< how fast the analysis was: "0.2 ms per row"; may be empty

  /// A key that is there keeps its place.
  void add(const std::string& key, nlohmann::ordered_json value) { json[key] = std::move(value); }
  void add_note(const std::optional<std::string>& note) {
    if (note) notes.push_back(*note);
  }
  void add_warnings(const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  /// \param label  what the line is about; empty: the same as the line above
  template <class... Args>
  void line(const std::string& label, fmt::format_string<Args...> format, Args&&... args) {
    text += fmt::format("  {:<14} {}\n", label, fmt::format(format, std::forward<Args>(args)...));
  }
};

/// The peak, and the largest load of all rows.
/// \param reaction  largest of the supports, of runs over time [force]
void tell_peaks(Summary& summary, const CaseFile& input, const PeakWatch& peaks,
                std::optional<double> reaction = {});

/// The text of the peaks of a run over time, among doubts or notes.
void tell_residual_strength(Summary& summary, const CaseFile& input, const PeakWatch& peaks);

/// Where the energy of a run over time is at its end.
void tell_energies(Summary& summary, const EnergyBalance& energy);

/// What only some bodies that move have.
struct MotionExtras {
  double fundamental_period = 0.0;     ///< 0: nothing asks for it [time]
  bool yields = false;                 ///< particles flow
  nlohmann::ordered_json constants{};  ///< how well those of state-based particles were found
};

/// What explicit runs tell, of bonds and of lattices, but for the sizes of their bodies.
void tell_motion(Summary& summary, const CaseFile& input, const RunFiles& files,
                 const ExplicitResult& result, const MotionExtras& extras);

/// A crack as the summary tells it.
struct ToldCrack {
  CrackState state;
  std::vector<double> at;  ///< middle of its widest bond, size dim [length]
};

/// The cracks of the most bonds, ten at most.
std::vector<ToldCrack> widest_cracks(const Network& network, const CrackOpenings& openings);

/// Nothing where there are none.
void tell_cracks(Summary& summary, const std::vector<ToldCrack>& cracks);

/// How many particles and bonds a model has, and how they were made.
/// \param more  behind the line: ", 60 unknowns"
void tell_body(Summary& summary, const Model& model, const std::string& more = "");

/// "45 particles, 1234 bonds" or "45 particles, 1234 linear elements".
std::string size_text(const Model& model);

/// Peak memory of this process [bytes].
double peak_memory_bytes();

}  // namespace perilink
