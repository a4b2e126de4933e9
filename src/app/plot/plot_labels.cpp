#include "app/plot/plot_labels.hpp"

#include "io/text/input_text.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string directory_name(const fs::path& directory) {
  return fs::absolute(directory / ".").lexically_normal().parent_path().filename().string();
}

PlotLabels read_labels(const fs::path& directory) {
  PlotLabels labels;
  labels.title = directory_name(directory);
  const auto summary = read_summary_file(directory);
  if (!summary) return labels;
  const auto text = [&](const char* key) { return summary_text(*summary, key, directory); };
  if (!text("title").empty()) labels.title = text("title");
  labels.analysis = text("analysis");
  if (const auto stages = summary->find("stages"); stages != summary->end() && stages->is_array()) {
    const auto part = [](const auto& stage, const char* key) {
      const bool known = stage.is_object() && stage.contains(key) && stage[key].is_string();
      return known ? stage[key].template get<std::string>() : std::string();
    };
    for (const auto& stage : *stages) {
      labels.stages.push_back({part(stage, "name"), part(stage, "loads")});
    }
  }
  const std::string units = text("units");  // "kip, in, s": of force, of length, of time
  const std::size_t comma = units.find(',');
  if (comma != std::string::npos) {
    labels.force = trimmed(units.substr(0, comma));
    const std::size_t end = units.find(',', comma + 1);
    labels.length = trimmed(units.substr(comma + 1, end - comma - 1));
  }
  return labels;
}

}  // namespace perilink
