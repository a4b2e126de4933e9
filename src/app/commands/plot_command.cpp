#include "app/commands/plot_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/plot/plot_bars.hpp"
#include "app/plot/plot_curve.hpp"
#include "app/plot/plot_fields.hpp"
#include "app/process/console.hpp"
#include "base/error.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "results/history_file.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

void save(const Svg& svg, const fs::path& path) {
  svg.save(path.string());
  say(path.string() + "\n");
}

/// Reads a nonnegative whole number from the file data of a field file.
Index count_of(const VtuGrid& grid, const char* name, const std::string& path) {
  const double value = grid.field(name, 0.0);
  if (value >= 0.0 && value <= std::numeric_limits<Index>::max()) return static_cast<Index>(value);
  throw FileError(fmt::format("{}: {} is {}, not a whole number of at least 0", path, name, value));
}

void plot_series(const fs::path& directory, const fs::path& out, const PlotLabels& labels,
                 double scale) {
  for (const PvdEntry& entry : read_pvd((directory / "fields.pvd").string())) {
    const std::string path = (directory / entry.file).string();
    const VtuGrid grid = read_vtu(path);
    const Index step = count_of(grid, "step", path);
    FieldsCaption caption{count_of(grid, "broken_bonds", path), grid.field("load_factor", 0.0),
                          grid.field("load", 0.0)};
    if (const double time = grid.field("time", -1.0); time >= 0.0) caption.time = time;
    save(draw_fields(read_body(grid, path), caption, labels, scale),
         out / fmt::format("fields_{}.svg", step));
    const fs::path bars = directory / fmt::format("bars_{:06}.csv", step);
    if (!fs::exists(bars)) continue;
    const std::string when = caption.time ? fmt::format("time {}", short_number(*caption.time))
                                          : fmt::format("row {}", step);
    const std::string text =
        fmt::format("{}, load {}", when, in_unit(short_number(caption.load), labels.force));
    save(draw_bars(read_csv(bars.string()), bars.string(), text, labels),
         out / fmt::format("bars_{}.svg", step));
  }
}

/// Reads the first peak from the summary. The history does not say when the body failed.
std::optional<CurvePoint> first_peak_of(const std::optional<nlohmann::ordered_json>& summary) {
  if (!summary) return std::nullopt;
  const auto load = summary->find("first_peak_load");
  const auto displacement = summary->find("first_peak_displacement");
  const auto known = [&](const auto& number) {
    return number != summary->end() && number->is_number();
  };
  if (!known(load) || !known(displacement)) return std::nullopt;
  return CurvePoint{displacement->get<double>(), load->get<double>()};
}

}  // namespace

int plot_results(const PlotOptions& options) {
  const fs::path directory = options.directory;
  const fs::path out = options.out.empty() ? directory : fs::path(options.out);
  require_result(directory);
  const std::string history = (directory / "history.csv").string();
  const CsvTable table = read_csv(history);
  const std::vector<StepRecord> records = history_records(table, history);
  const PlotLabels labels = read_labels(directory);
  if (table.cut_off) complain(std::string("note: ") + cut_off_note);
  const auto summary = read_summary_file(directory);
  if (!summary || summary_text(*summary, "status", directory) == "running") {
    complain(
        "note: the run is not finished or was killed; the pictures show the "
        "rows and fields written so far");
  }
  std::error_code failure;
  fs::create_directories(out, failure);  // save() reports the error
  save(draw_load_displacement(records, labels, first_peak_of(summary)),
       out / "load_displacement.svg");
  if (fs::exists(directory / "fields.pvd")) plot_series(directory, out, labels, options.scale);
  return exit_done;
}

}  // namespace perilink
