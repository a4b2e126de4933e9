#include "app/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/commands.hpp"
#include "app/history_file.hpp"
#include "app/plot_curve.hpp"
#include "app/plot_fields.hpp"
#include "io/vtu.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

std::string trim(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

/// Labels from summary.json. A run that was killed leaves none, and its results are worth a look.
PlotLabels read_labels(const fs::path& directory) {
  PlotLabels labels;
  labels.title = fs::absolute(directory / ".").lexically_normal().parent_path().filename().string();
  std::ifstream file(directory / "summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file, nullptr, false);
  if (!summary.is_object()) return labels;
  const auto text = [&](const char* key) {
    const auto found = summary.find(key);
    return found != summary.end() && found->is_string() ? found->get<std::string>() : "";
  };
  if (!text("title").empty()) labels.title = text("title");
  const std::string units = text("units");  // "kip, in": of force, of length
  const std::size_t comma = units.find(',');
  if (comma != std::string::npos) {
    labels.force = trim(units.substr(0, comma));
    labels.length = trim(units.substr(comma + 1));
  }
  return labels;
}

void save(const Svg& svg, const fs::path& path) {
  svg.save(path.string());
  fmt::print("{}\n", path.string());
}

void plot_series(const fs::path& directory, const fs::path& out, const PlotLabels& labels,
                 double scale) {
  std::set<long> drawn;
  for (const PvdEntry& entry : read_pvd((directory / "fields.pvd").string())) {
    const std::string path = (directory / entry.file).string();
    const VtuGrid grid = read_vtu(path);
    const FieldsCaption caption{static_cast<Index>(grid.field("broken_bonds", 0.0)),
                                grid.field("load_factor", 0.0), grid.field("load", 0.0)};
    // Load steps without a break share the count.
    const bool again = !drawn.insert(caption.broken_bonds).second;
    const std::string name = again ? fmt::format("fields_{}_step_{}.svg", caption.broken_bonds,
                                                 std::lround(grid.field("step", 0.0)))
                                   : fmt::format("fields_{}.svg", caption.broken_bonds);
    save(draw_fields(read_body(grid, path), caption, labels, scale), out / name);
  }
}

}  // namespace

int plot_results(const PlotOptions& options) {
  const fs::path directory = options.directory;
  const fs::path out = options.out.empty() ? directory : fs::path(options.out);
  const std::vector<StepRecord> records = read_history((directory / "history.csv").string());
  const PlotLabels labels = read_labels(directory);
  std::error_code failure;
  fs::create_directories(out, failure);  // saving reports what is wrong with it
  save(draw_load_displacement(records, labels), out / "load_displacement.svg");
  if (fs::exists(directory / "fields.pvd")) plot_series(directory, out, labels, options.scale);
  return exit_done;
}

}  // namespace perilink
