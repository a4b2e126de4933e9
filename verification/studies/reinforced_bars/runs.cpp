#include "runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "app/commands/commands.hpp"
#include "app/commands/plot_command.hpp"
#include "app/plot/plot_bars.hpp"
#include "base/timer.hpp"
#include "io/text/csv.hpp"

namespace perilink::verification {
namespace {

namespace fs = std::filesystem;

std::vector<CurveRow> read_history(const fs::path& directory) {
  const CsvTable table = read_csv((directory / "history.csv").string());
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(table.column(name));
  };
  const std::size_t load = column("load"), displacement = column("displacement"),
                    work = column("external_work"), dissipated = column("dissipated_energy"),
                    broken = column("broken_bonds");
  std::vector<CurveRow> rows;
  for (const auto& row : table.rows) {
    rows.push_back({row[load], row[displacement], row[work], row[dissipated], row[broken]});
  }
  return rows;
}

/// The row that is in the name of a file, bars_000123.csv.
std::size_t row_of_file(const fs::path& path) {
  const std::string stem = path.stem().string();
  return std::stoul(stem.substr(stem.find('_') + 1)) - 1;
}

BarFrame read_frame(const fs::path& path) {
  const CsvTable table = read_csv(path.string());
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(table.column(name));
  };
  const std::size_t x = column("x"), y = column("y"), distance = column("distance"),
                    strain = column("axial_strain"), stress = column("axial_stress"),
                    slip = column("slip");
  BarFrame frame{row_of_file(path), {}};
  for (const auto& row : table.rows) {
    frame.segments.push_back({static_cast<int>(row[0]), row[x], row[y], row[distance], row[strain],
                              row[stress], row[slip]});
  }
  return frame;
}

std::vector<fs::path> files_like(const fs::path& directory, const std::string& beginning,
                                 const std::string& end) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(beginning) && name.ends_with(end)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return row_of_file(a) < row_of_file(b); });
  return files;
}

std::string reason_in(const fs::path& summary) {
  std::ifstream file(summary);
  const std::string key = "\"reason\": \"";
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(key);
    if (at == std::string::npos) continue;
    return line.substr(at + key.size(), line.rfind('"') - at - key.size());
  }
  return "";
}

}  // namespace

std::string changed_case(const std::string& name, const Changes& changes) {
  std::ifstream file(fmt::format("{}/{}.toml", PERILINK_STUDY_DIR, name));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const auto& [key, value] : changes) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("\n" + key + " = ", at)) != std::string::npos; ++at) {
      const std::string line = value.empty() ? "" : "\n" + key + " = " + value;
      text.replace(at, text.find('\n', at + 1) - at, line);
      ++count;
    }
    if (count == 0) throw std::logic_error(name + " has no " + key);
  }
  return text;
}

BarRun run_bars(const std::string& label, const std::string& case_text) {
  const fs::path folder = fs::temp_directory_path() / "perilink_reinforced_bars";
  fs::create_directories(folder);
  const fs::path case_path = folder / (label + ".toml");
  std::ofstream(case_path) << case_text;
  BarRun run;
  run.directory = folder / label;
  Timer timer;
  run_case({case_path.string(), run.directory.string(), 1, true, OldResults::removed});
  run.seconds = timer.seconds();
  run.rows = read_history(run.directory);
  for (const fs::path& path : files_like(run.directory, "bars_", ".csv")) {
    run.frames.push_back(read_frame(path));
  }
  run.reason = reason_in(run.directory / "summary.json");
  fmt::print("{}: {} rows, {:.0f} s, {}\n", label, run.rows.size(), run.seconds, run.reason);
  return run;
}

void draw_run(const BarRun& run, const std::string& file_name, double scale, double displacement) {
  std::vector<fs::path> fields = files_like(run.directory, "fields_", ".vtu");
  while (fields.size() > 1 && run.rows[row_of_file(fields.back())].displacement > displacement) {
    fields.pop_back();
  }
  const fs::path one = run.directory / "one";
  fs::remove_all(one);
  fs::create_directories(one);
  std::ifstream index(run.directory / "fields.pvd");
  std::ofstream index_of_one(one / "fields.pvd");
  const std::string name = fields.back().filename().string();
  for (std::string line; std::getline(index, line);) {
    const bool other = line.find("<DataSet") != std::string::npos;
    if (!other || line.find(name) != std::string::npos) index_of_one << line << "\n";
  }
  index_of_one.close();
  for (const fs::path& file :
       {run.directory / "history.csv", run.directory / "summary.json", fields.back()}) {
    fs::copy_file(file, one / file.filename());
  }
  plot_results({one.string(), one.string(), scale});
  fs::copy_file(files_like(one, "fields_", ".svg").back(), fs::path(PERILINK_STUDY_DIR) / file_name,
                fs::copy_options::overwrite_existing);
}

void draw_stresses(const BarRun& run, const std::string& file_name) {
  const std::string table = files_like(run.directory, "bars_", ".csv").back().string();
  const std::string caption = fmt::format("load {:.4g}", run.rows.back().load);
  draw_bars(read_csv(table), table, caption, read_labels(run.directory))
      .save(PERILINK_STUDY_DIR "/" + file_name);
}

double largest_load(const BarRun& run, std::size_t row) {
  double largest = 0.0;
  for (std::size_t k = 0; k <= row; ++k) largest = std::max(largest, run.rows[k].load);
  return largest;
}

const Segment& most_strained(const BarFrame& frame) {
  return *std::max_element(frame.segments.begin(), frame.segments.end(),
                           [](const Segment& a, const Segment& b) {
                             return (a.bar == 1 ? a.strain : -1.0) < (b.bar == 1 ? b.strain : -1.0);
                           });
}

double mean_strain(const BarFrame& frame, double distance, double length) {
  double sum = 0.0;
  int count = 0;
  for (const Segment& segment : frame.segments) {
    if (segment.bar != 1 || std::abs(segment.distance - distance) > 0.5 * length) continue;
    sum += segment.strain;
    ++count;
  }
  return sum / count;
}

const BarFrame& last_loaded_frame(const BarRun& run, double part) {
  double largest = 0.0;
  std::size_t row = 0;
  const BarFrame* last = &run.frames.front();
  for (const BarFrame& frame : run.frames) {
    for (; row <= frame.row; ++row) largest = std::max(largest, run.rows[row].load);
    if (run.rows[frame.row].load >= part * largest) last = &frame;
  }
  return *last;
}

}  // namespace perilink::verification
