#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/model/model.hpp"
#include "app/process/progress.hpp"
#include "app/results/field_file.hpp"
#include "app/results/history_file.hpp"
#include "io/case/case_file.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// What a run of any kind leaves while it goes on: rows of the history with their gauges, field
/// files and a progress line. The kinds of runs say what is in them.
class RunFiles {
 public:
  /// \param directory  which must be there
  /// \throws FileError
  RunFiles(const CaseFile& input, std::filesystem::path directory, bool quiet);

  /// \param gauges  their values, in the order of the case
  void add_row(const StepRecord& record, std::span<const double> gauges);
  void add_row(const ExplicitRecord& record, std::span<const double> gauges);
  /// Takes back all rows and field files. \throws FileError
  void begin_again();
  /// Whether the row over time that was added last is one whose fields the case asks for: the
  /// first, the first at or after each of output.fields_times, of a relaxation every one.
  bool fields_are_due(double time);
  /// Writes fields_STEP.vtu, unless it is there.
  /// \param at         place of the file in the series of fields.pvd
  /// \param make_grid  makes what is in it
  void write_fields(Index step, double at, const std::function<VtuGrid()>& make_grid);
  /// Writes KIND_STEP.csv beside the fields, KIND one of `tables`.
  void write_table(const char* kind, Index step, const std::string& text);
  static constexpr std::array<const char*, 2> tables = {"bars", "reactions"};
  /// Draws the progress of a run in steps, where it is time to.
  void show_steps(const ExplicitRecord& record, Index steps);
  ProgressBar& bar() { return bar_; }
  bool has_fields() const { return !series_.empty(); }
  /// Brings everything to the disk and ends the progress line. \throws FileError
  void finish();
  Index rows() const { return rows_; }
  /// What the rows over time tell so far.
  const PeakWatch& peaks() const { return peaks_; }
  double seconds_writing() const { return seconds_writing_; }

 private:
  void add_to_series(double at, const std::string& name, const std::function<void()>& write);

  const CaseFile& input_;
  std::filesystem::path directory_;
  ProgressBar bar_;
  std::optional<HistoryFile> history_;
  Index rows_ = 0;
  PeakWatch peaks_;
  std::size_t next_time_ = 0;  ///< next entry of the case's output.fields_times
  std::vector<PvdEntry> series_;
  double seconds_writing_ = 0.0;
};

/// "3 broken bonds" or, of state-based particles, "3 cracked particles".
std::string cracks_text(const CaseFile& input, const ExplicitRecord& record);

/// What a field file says of the row that it belongs to.
template <class Record>
FieldMoment moment_of(const Record& record, const CaseFile& input, const Model& model) {
  FieldMoment moment{record.step, record.broken_bonds, record.load_factor, record.load,
                     model.lattice.spacing};
  if (model.network.dim() == 2 || model.network.shell) moment.thickness = input.body.thickness;
  return moment;
}

}  // namespace perilink
