#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perilink {

/// A stage of a run.
struct StageLabel {
  std::string name;
  std::string loads;  ///< stage whose loads change; empty: unknown
};

/// Labels of a figure from the summary.
struct PlotLabels {
  std::string title;
  std::string force;          ///< unit; empty: none is known
  std::string length;         ///< unit; empty: none is known
  std::string analysis = {};  ///< analysis type; empty: written by an earlier version
  std::vector<StageLabel> stages = {};

  /// Returns the unit of stress, "N/mm²"; empty: none is known.
  std::string stress() const {
    return force.empty() || length.empty() ? "" : force + "/" + length + "²";
  }
};

/// Returns the last part of a path to a directory, "beam" for "results/beam/".
std::string directory_name(const std::filesystem::path& directory);

/// Reads labels from DIR/summary.json; without a title the directory name is used.
/// \throws FileError where it cannot be read
PlotLabels read_labels(const std::filesystem::path& directory);

/// Returns "load (kip)", or "load" without a unit.
inline std::string with_unit(const std::string& quantity, const std::string& unit) {
  return unit.empty() ? quantity : quantity + " (" + unit + ")";
}

/// Returns "12.5 kip", or "12.5" without a unit.
inline std::string in_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace perilink
