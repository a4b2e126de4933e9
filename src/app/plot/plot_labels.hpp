#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perilink {

/// A stage of a run.
struct StageLabel {
  std::string name;
  std::string loads;  ///< name of the stage whose loads change; empty: not known
};

/// What a summary tells a figure beside its data.
struct PlotLabels {
  std::string title;
  std::string force;          ///< unit; empty: none is known
  std::string length;         ///< unit; empty: none is known
  std::string analysis = {};  ///< kind of the run; empty: an earlier version did not tell
  std::vector<StageLabel> stages = {};
};

/// Last part of a path to a directory, "beam" of "results/beam/".
std::string directory_name(const std::filesystem::path& directory);

/// Labels from DIR/summary.json; the title is that of the directory where there is none.
/// \throws FileError where it cannot be read
PlotLabels read_labels(const std::filesystem::path& directory);

/// "load (kip)", or "load" without a unit.
inline std::string with_unit(const std::string& quantity, const std::string& unit) {
  return unit.empty() ? quantity : quantity + " (" + unit + ")";
}

/// "12.5 kip", or "12.5" without a unit.
inline std::string in_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace perilink
