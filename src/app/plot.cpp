#include "app/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "app/commands.hpp"
#include "app/history_file.hpp"
#include "app/plot_curve.hpp"
#include "app/plot_fields.hpp"
#include "io/vtu.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

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
    FieldsCaption caption{static_cast<Index>(grid.field("broken_bonds", 0.0)),
                          grid.field("load_factor", 0.0), grid.field("load", 0.0)};
    if (const double time = grid.field("time", -1.0); time >= 0.0) {
      caption.time = time;
      const std::string name = fmt::format("fields_{}.svg", std::lround(grid.field("step", 0.0)));
      save(draw_fields(read_body(grid, path), caption, labels, scale), out / name);
      continue;
    }
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
