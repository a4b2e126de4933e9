#pragma once

#include <filesystem>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/model/from_case/lattice_case.hpp"
#include "app/process/progress.hpp"
#include "app/results/explicit_history.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// Turns what happens in an explicit run into files and progress: every row into the history, the
/// states at the times that the case asks for (and the first and the last) into field files.
class ExplicitRunObserver final : public ExplicitObserver {
 public:
  ExplicitRunObserver(const CaseFile& input, const ExplicitCase& built,
                      std::filesystem::path directory, bool quiet);

  void on_row(const ExplicitRecord& record, const ExplicitState& state) override;
  void on_end(const ExplicitRecord& last, const ExplicitState& state) override;
  bool stop_requested() override;

  /// Brings everything to the disk and ends the progress line.
  void finish();
  Index rows() const { return rows_; }
  const PeakWatch& peaks() const { return peaks_; }
  std::vector<std::string> doubts(const ExplicitResult& result) const;
  double seconds_writing() const { return seconds_writing_; }

 private:
  /// Displacements of the case's gauges.
  std::vector<double> gauge_values(const ExplicitState& state) const;
  void write_fields(const ExplicitRecord& record, const ExplicitState& state);

  const CaseFile& input_;
  const ExplicitCase& built_;
  std::filesystem::path directory_;
  ExplicitHistory history_;
  ProgressBar bar_;
  Index rows_ = 0;
  PeakWatch peaks_{vibrating_rows};
  std::size_t next_time_ = 0;  ///< next entry of the case's output.fields_times
  std::vector<PvdEntry> series_;
  double seconds_writing_ = 0.0;
};

}  // namespace perilink
