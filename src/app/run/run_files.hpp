#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/process/progress.hpp"
#include "app/process/run_callbacks.hpp"
#include "io/case/case_file.hpp"
#include "io/fields/vtu.hpp"
#include "model/model.hpp"
#include "results/field_file.hpp"
#include "results/history_file.hpp"

namespace perilink {

/// Output files of a run of any analysis type: history with gauges, field files and a progress
/// line. The analysis types supply the contents.
class RunFiles {
 public:
  /// State of the files, to go on with them.
  struct State {
    HistoryFile::Sizes sizes;
    Index rows = 0;
    PeakWatch peaks;
    std::size_t next_time = 0;          ///< next entry of the case's output.fields_times
    std::vector<std::uint8_t> reached;  ///< per value that asks for fields
    std::vector<PvdEntry> series;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(sizes, rows, peaks, next_time, reached, series);
    }
  };

  /// \param directory  existing directory
  /// \throws FileError
  RunFiles(const CaseFile& input, std::filesystem::path directory, RunCallbacks calls);
  /// Goes on with the files of a saved run; what was written later is removed.
  /// \throws FileError
  RunFiles(const CaseFile& input, std::filesystem::path directory, RunCallbacks calls,
           const State& saved);

  /// Syncs all files and returns their state. \throws FileError
  State save();

  /// \param gauges  gauge values, in the order of the case
  void add_row(const StepRecord& record, std::span<const double> gauges);
  void add_row(const ExplicitRecord& record, std::span<const double> gauges);
  /// Removes all rows and field files. \throws FileError
  void begin_again();
  /// Whether fields are due at the last time row. They are due at the first row and at the first
  /// one at or after each of output.fields_times or that reaches a value; in a relaxation at every
  /// row.
  bool fields_are_due(double time);
  /// Whether the last row is the first to reach a value of output.fields_at_displacement or of
  /// `fields_at` of a gauge.
  bool reaches_value() const { return reaches_value_; }
  /// Adds point fields to all field files.
  void add_to_fields(std::vector<VtuArray> constant) { constant_fields_ = std::move(constant); }
  /// Writes fields_STEP.vtu, unless it exists.
  /// \param at         time or load factor of the file in fields.pvd
  /// \param make_grid  returns the contents
  /// \return whether it was written
  bool write_fields(Index step, double at, const std::function<VtuGrid()>& make_grid);
  /// Removes fields_STEP.vtu and the tables beside it. \throws FileError
  void remove_fields(Index step);
  /// Writes KIND_STEP.csv next to the field file; KIND is one of `tables`.
  void write_table(const char* kind, Index step, const std::string& text);
  static constexpr std::array<const char*, 3> tables = {"bars", "cracks", "reactions"};
  /// Updates the progress bar, unless it was drawn a moment ago.
  /// \param steps  number of steps of the whole run
  void show_steps(const ExplicitRecord& record, Index steps);
  ProgressBar& bar() { return bar_; }
  bool has_fields() const { return !state_.series.empty(); }
  /// Flushes all files and ends the progress line. \throws FileError
  void finish();
  Index rows() const { return state_.rows; }
  /// Returns the peaks of the time rows so far.
  const PeakWatch& peaks() const { return state_.peaks; }
  double seconds_writing() const { return seconds_writing_; }

 private:
  void note_values(double displacement, std::span<const double> gauges);
  void write_series() const;
  void remove_later_files() const;

  const CaseFile& input_;
  RunCallbacks callbacks_;
  std::filesystem::path directory_;
  ProgressBar bar_;
  std::optional<HistoryFile> history_;
  State state_;
  std::vector<VtuArray> constant_fields_;
  bool reaches_value_ = false;
  double seconds_writing_ = 0.0;
};

/// Returns "3 broken bonds" or, for state-based particles, "3 cracked particles".
std::string cracks_text(const CaseFile& input, const ExplicitRecord& record);

/// Returns the state values of a row for its field file.
template <class Record>
FieldMoment moment_of(const Record& record, const CaseFile& input, const Model& model) {
  FieldMoment moment{record.step, record.broken_bonds, record.load_factor, record.load,
                     model.lattice.spacing};
  if (model.network.dim() == 2 || model.network.shell) moment.thickness = input.body.thickness;
  return moment;
}

}  // namespace perilink
