#include "app/run/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// Part of a requested time by which a step may fall short of it.
constexpr double round_off = 1e-9;

std::string table_name(const char* kind, Index step) {
  return fmt::format("{}_{:06}.csv", kind, step);
}

std::string field_file_name(Index step) { return fmt::format("fields_{:06}.vtu", step); }

bool is_relaxation(const CaseFile& input) {
  return input.analysis.type == AnalysisType::relaxation;
}

}  // namespace

std::string cracks_text(const CaseFile& input, const ExplicitRecord& record) {
  return has_state_based_particles(input.body)
             ? counted(record.cracked_particles, "cracked particle")
             : counted(record.broken_bonds, "broken bond");
}

RunFiles::RunFiles(const CaseFile& input, std::filesystem::path directory, RunCallbacks calls)
    : input_(input),
      callbacks_(std::move(calls)),
      directory_(std::move(directory)),
      bar_(callbacks_.quiet),
      history_(std::in_place, directory_.string(), input) {
  state_.peaks = PeakWatch(is_relaxation(input) ? 1 : vibrating_rows);
}

RunFiles::RunFiles(const CaseFile& input, std::filesystem::path directory, RunCallbacks calls,
                   const State& saved)
    : input_(input),
      callbacks_(std::move(calls)),
      directory_(std::move(directory)),
      bar_(callbacks_.quiet),
      history_(std::in_place, directory_.string(), input, saved.sizes),
      state_(saved) {
  write_series();
  remove_later_files();
}

/// Removes field files and tables that are not of the series.
void RunFiles::remove_later_files() const {
  const auto is_known = [&](const std::string& name) {
    return std::ranges::any_of(state_.series, [&](const PvdEntry& entry) {
      constexpr std::size_t before = std::string_view("fields_").size();
      const std::string step =
          entry.file.substr(before, entry.file.size() - before - std::string_view(".vtu").size());
      return name == entry.file || std::ranges::any_of(tables, [&](const char* kind) {
               return name == fmt::format("{}_{}.csv", kind, step);
             });
    });
  };
  for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
    const std::string name = entry.path().filename().string();
    const std::size_t begin = name.find('_') + 1, end = name.find_first_not_of("0123456789", begin);
    const bool is_numbered = begin > 0 && end != std::string::npos && end >= begin + 6;
    const std::string kind = name.substr(0, begin), suffix = is_numbered ? name.substr(end) : "";
    const bool is_table = suffix == ".csv" && std::ranges::any_of(tables, [&](const char* table) {
                            return kind == std::string(table) + "_";
                          });
    const bool is_field_file = (kind == "fields_" && suffix == ".vtu") || is_table;
    if (is_field_file && !is_known(name)) std::filesystem::remove(entry.path());
  }
}

RunFiles::State RunFiles::save() {
  history_->finish();
  state_.sizes = history_->sizes();
  return state_;
}

void RunFiles::add_row(const StepRecord& record, std::span<const double> gauges) {
  history_->append(record, gauges);
  ++state_.rows;
  note_values(record.displacement, gauges);
  if (!callbacks_.on_row) return;
  callbacks_.on_row({state_.rows, record.step, 0.0, record.load_factor, record.load,
                     record.displacement, record.broken_bonds});
}

void RunFiles::add_row(const ExplicitRecord& record, std::span<const double> gauges) {
  history_->append(record, gauges);
  ++state_.rows;
  note_values(record.displacement, gauges);
  const bool intact = record.broken_bonds == 0 && record.cracked_particles == 0;
  state_.peaks.add({record.displacement, record.load}, intact);
  if (!callbacks_.on_row) return;
  callbacks_.on_row({state_.rows, record.step, record.time, record.load_factor, record.load,
                     record.displacement, record.broken_bonds + record.cracked_particles});
}

/// A value is reached where the quantity has come from zero to it, or passed it, with its sign.
void RunFiles::note_values(double displacement, std::span<const double> gauges) {
  reaches_value_ = false;
  std::size_t number = 0;
  const auto look = [&](double now, const std::vector<double>& values) {
    for (const double value : values) {
      if (number == state_.reached.size()) state_.reached.push_back(0);
      std::uint8_t& reached = state_.reached[number++];
      if (reached != 0 || (value < 0.0 ? now > value : now < value)) continue;
      reached = 1;
      reaches_value_ = true;
    }
  };
  look(std::abs(displacement), input_.output.fields_at_displacement);
  for (std::size_t k = 0; k < gauges.size(); ++k) look(gauges[k], input_.gauges[k].fields_at);
}

void RunFiles::begin_again() {
  history_.reset();
  history_.emplace(directory_.string(), input_);
  std::filesystem::remove(directory_ / "fields.pvd");  // before the files that it names
  for (const PvdEntry& entry : state_.series) {
    std::filesystem::remove(directory_ / entry.file);
    for (const char* kind : tables) {
      std::filesystem::remove(directory_ / table_name(kind, static_cast<Index>(entry.time)));
    }
  }
  state_.series.clear();
  state_.reached.clear();
  state_.rows = 0;
}

bool RunFiles::fields_are_due(double time) {
  const std::vector<double>& times = input_.output.fields_times;
  bool due = state_.rows == 1 || is_relaxation(input_) || reaches_value_;
  const double now = time * (1.0 + round_off);
  for (; state_.next_time < times.size() && times[state_.next_time] <= now; ++state_.next_time)
    due = true;
  return due;
}

bool RunFiles::write_fields(Index step, double at, const std::function<VtuGrid()>& make_grid) {
  const std::string name = field_file_name(step);
  if (std::ranges::find(state_.series, name, &PvdEntry::file) != state_.series.end()) return false;
  const Timer timer;
  VtuGrid grid = make_grid();
  grid.point_data.insert(grid.point_data.end(), constant_fields_.begin(), constant_fields_.end());
  write_vtu((directory_ / name).string(), grid);
  const auto after = std::ranges::upper_bound(state_.series, at, {}, &PvdEntry::time);
  state_.series.insert(after, {at, name});
  write_series();
  seconds_writing_ += timer.seconds();
  return true;
}

void RunFiles::remove_fields(Index step) {
  const std::string name = field_file_name(step);
  std::erase_if(state_.series, [&](const PvdEntry& entry) { return entry.file == name; });
  write_series();  // before the files that it names
  std::filesystem::remove(directory_ / name);
  for (const char* kind : tables) std::filesystem::remove(directory_ / table_name(kind, step));
}

void RunFiles::write_series() const {
  write_pvd((directory_ / "fields.pvd").string(), state_.series);
}

void RunFiles::write_table(const char* kind, Index step, const std::string& text) {
  write_whole_file((directory_ / table_name(kind, step)).string(), text);
}

void RunFiles::show_steps(const ExplicitRecord& record, Index steps) {
  if (!bar_.is_due()) return;
  bar_.draw(fmt::format("step {} of {}, load factor {:.4g}, {}", record.step, steps,
                        record.load_factor, cracks_text(input_, record)),
            static_cast<double>(record.step) / steps);
}

void RunFiles::finish() {
  bar_.finish();
  history_->finish();
}

}  // namespace perilink
