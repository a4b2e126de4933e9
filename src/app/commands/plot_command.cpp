#include "app/commands/plot_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/commands/commands.hpp"
#include "app/compare/run_result.hpp"
#include "app/plot/plot_bars.hpp"
#include "app/plot/plot_curve.hpp"
#include "app/plot/plot_fields.hpp"
#include "app/process/console.hpp"
#include "app/process/process_pool.hpp"
#include "app/report/report_fields.hpp"
#include "app/report/report_units.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "io/case/case_schema.hpp"
#include "io/fields/animated_png.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "io/text/toml_tree.hpp"
#include "results/history_file.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Writes the pictures, also as PNG where options ask for it.
class Pictures {
 public:
  /// \throws FileError without the program that makes PNG
  explicit Pictures(const PlotOptions& options)
      : folder_(options.out.empty() ? options.directory : options.out) {
    if (options.png || options.animation) converter_.emplace(program_in_path("rsvg-convert"), 1);
    std::error_code failure;
    fs::create_directories(folder_, failure);  // save() reports the error
  }

  void save(const Svg& svg, const std::string& name) {
    const std::string path = (folder_ / (name + ".svg")).string();
    svg.save(path);
    say(path + "\n");
    if (!converter_) return;
    const std::string picture = (folder_ / (name + ".png")).string();
    converter_->start(0, {"--zoom", "2", "--background-color", "white", "--output", picture, path});
    std::vector<FinishedProcess> ended;
    while (ended.empty()) ended = converter_->wait(1000);
    if (ended.front().exit_status != 0) {
      throw FileError(fmt::format("{}: rsvg-convert failed: {}", picture, ended.front().errors));
    }
    say(picture + "\n");
  }

  /// Joins pictures saved before as animation.png.
  void join(const std::vector<std::string>& names) const {
    std::vector<std::string> frames;
    for (const std::string& name : names) {
      frames.push_back(read_regular_file((folder_ / (name + ".png")).string()));
    }
    constexpr int shown = 200;  // ms
    const std::string path = (folder_ / "animation.png").string();
    write_whole_file(path, animated_png(frames, shown));
    say(path + "\n");
  }

 private:
  static std::string program_in_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const fs::path program = fs::path(folder) / name;
      if (!folder.empty() && ::access(program.c_str(), X_OK) == 0) return program.string();
    }
    throw FileError(
        fmt::format("PNG needs the program {}, which was not found\n"
                    "  install it (Debian: librsvg2-bin), or leave the option out: browsers and "
                    "editors open SVG",
                    name));
  }

  fs::path folder_;
  std::optional<ProcessPool> converter_;
};

/// Part of a file name: letters and digits of a text, others as underscores.
std::string file_word(std::string text) {
  const auto stays = [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80 || c == '-'; };
  std::ranges::replace_if(
      text, [&](char c) { return !stays(static_cast<unsigned char>(c)); }, '_');
  return text;
}

/// Reads a nonnegative whole number from the file data of a field file.
Index count_of(const VtuGrid& grid, const char* name, const std::string& path) {
  const double value = grid.field(name, 0.0);
  if (value >= 0.0 && value <= std::numeric_limits<Index>::max()) return static_cast<Index>(value);
  throw FileError(fmt::format("{}: {} is {}, not a whole number of at least 0", path, name, value));
}

/// A result to draw.
struct PlottedRun {
  fs::path directory;
  PlotLabels labels;
  UnitNames units;
};

/// Returns the colours of a field by its name. \throws FileError where there is none
ParticleColors colors_of(const VtuGrid& grid, const PlotBody& body, const PlottedRun& run,
                         const PlotOptions& options) {
  ParticleColors colors = usual_colors(body, run.labels);
  if (!options.field.empty()) {
    const std::vector<ReportField> fields = fields_of(grid, body.dim);
    const std::string wanted = in_words(options.field);
    auto found = std::ranges::find(fields, wanted, &ReportField::name);
    if (found == fields.end() && options.field != "displacement") {  // whose components are named
      found = std::ranges::find(fields, options.field, &ReportField::array);
    }
    if (found == fields.end()) {
      std::vector<std::string_view> names;
      for (const ReportField& field : fields) names.push_back(field.name);
      throw FileError(fmt::format("--field {}: the file of fields has no such field\n  {}",
                                  options.field, suggest(wanted, names)));
    }
    const std::vector<float> values = values_of_field(grid, *found);
    std::vector<float> meaningful;
    for (Index i = 0; i < body.size(); ++i) {
      if (body.kind[i] == 0 && !body.is_loose(i)) meaningful.push_back(values[i]);
    }
    const NumberRange range = range_of(meaningful);
    colors.values.assign(values.begin(), values.end());
    colors.grey_zero = found->array == "damage" || found->array == "crack_opening";
    colors.bar.label = with_unit(found->name, unit_of_quantity(found->array, run.units));
    if (found->array == "damage") {
      colors.bar.low = 0.0;
      colors.bar.high = 1.0;
    } else if (range.low < range.high) {
      colors.bar.low = colors.grey_zero ? std::min(0.0F, range.low) : range.low;
      colors.bar.high = range.high;
    } else if (!meaningful.empty()) {  // one value
      colors.bar.low = std::min(0.0F, range.low);
      colors.bar.high = range.low > 0.0F ? range.low : colors.bar.low + 1.0;
    }
  }
  if (!options.range.empty()) {
    colors.bar.low = options.range[0];
    colors.bar.high = options.range[1];
  }
  return colors;
}

/// View common to all frames of an animation.
struct FrameView {
  double scale = 0.0;          ///< factor on the displacements
  std::optional<ViewBox> box;  ///< absent: that of each picture
};

/// Draws a file of fields.
/// \return name of the picture, without its ending
std::string plot_fields(const PvdEntry& entry, const PlottedRun& run, const PlotOptions& options,
                        const FrameView& frame, Pictures& pictures) {
  const std::string path = (run.directory / entry.file).string();
  const VtuGrid grid = read_vtu(path);
  const Index step = count_of(grid, "step", path);
  FieldsCaption caption{count_of(grid, "broken_bonds", path), grid.field("load_factor", 0.0),
                        grid.field("load", 0.0)};
  if (const double time = grid.field("time", -1.0); time >= 0.0) caption.time = time;
  const PlotBody body = read_body(grid, path);
  const std::string field = options.field.empty() ? "" : "_" + file_word(options.field);
  std::string name = fmt::format("fields_{:06}{}", step, field);
  pictures.save(draw_fields(body, caption, run.labels, frame.scale,
                            colors_of(grid, body, run, options), frame.box),
                name);
  const fs::path bars = run.directory / fmt::format("bars_{:06}.csv", step);
  if (!field.empty() || frame.box || !fs::exists(bars)) return name;
  const std::string when = caption.time ? fmt::format("time {}", short_number(*caption.time))
                                        : fmt::format("row {}", step);
  const std::string text =
      fmt::format("{}, load {}", when, in_unit(short_number(caption.load), run.labels.force));
  pictures.save(draw_bars(read_csv(bars.string()), bars.string(), text, run.labels),
                fmt::format("bars_{:06}", step));
  return name;
}

/// Returns the row of the number in a name of a field file.
Index row_of(const PvdEntry& entry) {
  const std::size_t begin = entry.file.find_first_of("0123456789");
  return begin == std::string::npos ? 0 : std::atoi(entry.file.c_str() + begin);
}

/// Returns the file of fields of a row. \throws FileError where there is none
PvdEntry entry_at(const std::vector<PvdEntry>& entries, const PlottedRun& run,
                  const std::string& at) {
  if (at == "last") return entries.back();
  const Index row = row_of_choice(run.directory.string(), at);
  const auto found = std::ranges::find(entries, row, row_of);
  if (found != entries.end()) return *found;
  std::vector<std::string> rows;
  for (const PvdEntry& entry : entries) rows.push_back(std::to_string(row_of(entry)));
  throw FileError(fmt::format(
      "--at {}: there is no file of fields of row {}\n  rows with fields: {}; more by [output] of "
      "the case",
      at, row, joined(rows)));
}

/// Draws files of fields in one view, at one scale and with one range of colours, and joins them.
void animate(const std::vector<PvdEntry>& entries, const PlottedRun& run, PlotOptions options,
             Pictures& pictures) {
  FrameView frame{options.scale, ViewBox{}};
  ColorBar range{"", infinity, -infinity};
  const auto for_each_body = [&](const auto& look) {
    for (const PvdEntry& entry : entries) {
      const std::string path = (run.directory / entry.file).string();
      const VtuGrid grid = read_vtu(path);
      look(grid, read_body(grid, path));
    }
  };
  for_each_body([&](const VtuGrid& grid, const PlotBody& body) {
    const ColorBar bar = colors_of(grid, body, run, options).bar;
    range.low = std::min(range.low, bar.low);
    range.high = std::max(range.high, bar.high);
    const bool moves = std::ranges::any_of(body.displacements,
                                           [](const Vector3& move) { return move != Vector3{}; });
    if (options.scale > 0.0 || !moves) return;
    const double own = automatic_scale(body);
    frame.scale = frame.scale > 0.0 ? std::min(frame.scale, own) : own;
  });
  if (!(frame.scale > 0.0)) frame.scale = 1.0;
  for_each_body([&](const VtuGrid&, const PlotBody& body) {
    frame.box->add(view_of_body(body, frame.scale));
  });
  options.range = {range.low, range.high};
  std::vector<std::string> names;
  for (const PvdEntry& entry : entries) {
    names.push_back(plot_fields(entry, run, options, frame, pictures));
  }
  pictures.join(names);
}

/// \param last  last row of an animation
void plot_series(const PlottedRun& run, const PlotOptions& options, Index last,
                 Pictures& pictures) {
  const fs::path list = run.directory / "fields.pvd";
  std::vector<PvdEntry> entries;
  if (fs::exists(list)) entries = read_pvd(list.string());
  if ((options.animation || !options.at.empty()) && entries.empty()) {
    throw FileError(fmt::format("{}: has no files of fields", run.directory.string()));
  }
  if (!options.at.empty()) entries = {entry_at(entries, run, options.at)};
  if (options.animation) {
    std::erase_if(entries, [&](const PvdEntry& entry) { return row_of(entry) > last; });
    return animate(entries, run, options, pictures);
  }
  for (const PvdEntry& entry : entries) {
    plot_fields(entry, run, options, {options.scale, {}}, pictures);
  }
}

/// Whether a column is zero in the undeformed state. Gauges are.
bool begins_at_zero(const std::string& name) {
  const HistoryColumn* column = find_history_column(name);
  return column == nullptr || column->begins_at_zero;
}

/// Draws a column of the history over another. \throws FileError where one is missing
/// \param rows  drawn
void plot_columns(const CsvTable& table, std::size_t rows, const PlottedRun& run,
                  const PlotOptions& options, Pictures& pictures) {
  const std::string x = options.x.empty() ? "displacement" : options.x;
  const std::string y = options.y.empty() ? "load" : options.y;
  const fs::path case_path = run.directory / "case.toml";
  const TomlValue root = fs::exists(case_path)
                             ? parse_toml(read_regular_file(case_path.string()), case_path.string())
                             : TomlValue{};
  const auto column = [&](const char* option, const std::string& name) {
    const int place = table.column(name);
    if (place >= 0) return static_cast<std::size_t>(place);
    throw FileError(fmt::format("{} {}: history.csv has no such column\n  {}", option, name,
                                suggest(name, {table.columns.begin(), table.columns.end()})));
  };
  const std::size_t at_x = column("--x", x), at_y = column("--y", y);
  ColumnCurve curve;
  curve.x_label = with_unit(in_words(x), unit_of_column(x, root, run.units));
  curve.y_label = with_unit(in_words(y), unit_of_column(y, root, run.units));
  for (const std::vector<double>& row : std::span(table.rows).first(rows)) {
    curve.points.push_back({row[at_x], row[at_y]});
  }
  curve.from_origin = begins_at_zero(x) && begins_at_zero(y);
  curve.note = note_of_tail(table.rows.size() - rows);
  pictures.save(draw_columns(curve, run.labels.title),
                fmt::format("{}_over_{}", file_word(y), file_word(x)));
}

/// Reads a peak from the summary: "peak", or "first_peak". The history does not say when the body
/// failed.
std::optional<CurvePoint> peak_of(const std::optional<nlohmann::ordered_json>& summary,
                                  const std::string& name) {
  if (!summary) return std::nullopt;
  const auto load = summary->find(name + "_load");
  const auto displacement = summary->find(name + "_displacement");
  const auto known = [&](const auto& number) {
    return number != summary->end() && number->is_number();
  };
  if (!known(load) || !known(displacement)) return std::nullopt;
  return CurvePoint{displacement->get<double>(), load->get<double>()};
}

/// Returns the number of rows of the curves.
std::size_t rows_drawn(std::span<const CurvePoint> curve, const PlottedRun& run,
                       const std::optional<CurvePoint>& peak, bool whole) {
  if (whole) return curve.size();
  const std::size_t rows = rows_before_tail(curve);
  return peak && run.labels.stages.empty() ? std::min(rows, rows_before_drift(curve, *peak)) : rows;
}

}  // namespace

int plot_results(const PlotOptions& options) {
  if (!options.range.empty() && !(options.range[0] < options.range[1])) {
    throw FileError(fmt::format("--range {} {}: the first number must be below the second",
                                options.range[0], options.range[1]));
  }
  require_result(options.directory);
  PlottedRun run{options.directory, {}, {}};
  const std::string history = (run.directory / "history.csv").string();
  const CsvTable table = read_csv(history);
  const std::vector<StepRecord> records = history_records(table, history);
  run.labels = read_labels(run.directory);
  if (table.cut_off) complain(std::string("note: ") + cut_off_note);
  const auto summary = read_summary_file(run.directory);
  if (summary) run.units = UnitNames::of(summary_text(*summary, "units", run.directory));
  if (!summary || summary_text(*summary, "status", run.directory) == "running") {
    complain(
        "note: the run is not finished or was killed; the pictures show the "
        "rows and fields written so far");
  }
  Pictures pictures(options);
  const std::size_t rows =
      rows_drawn(points_of(records), run, peak_of(summary, "peak"), options.whole);
  const bool columns = !options.x.empty() || !options.y.empty();
  const bool body =
      options.animation || !options.at.empty() || !options.field.empty() || !options.range.empty();
  if (columns) {
    plot_columns(table, rows, run, options, pictures);
  } else if (!body) {
    pictures.save(draw_load_displacement(records, run.labels, peak_of(summary, "first_peak"), rows),
                  "load_displacement");
  }
  if (body || !columns) {
    plot_series(run, options, rows == 0 ? 0 : records[rows - 1].step, pictures);
  }
  return exit_done;
}

}  // namespace perilink
