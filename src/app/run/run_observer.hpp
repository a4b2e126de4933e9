#pragma once

#include <filesystem>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/model/from_case/configure.hpp"
#include "app/process/progress.hpp"
#include "app/results/history_file.hpp"
#include "base/csr.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// Turns what happens in a run into files and progress: every row into the history, the states that
/// the case asks for (and the first and the last) into field files.
class RunObserver final : public StepObserver {
 public:
  RunObserver(const CaseFile& input, const Model& model, std::filesystem::path directory,
              bool quiet);

  void on_step(const StepRecord& record, StateSource& source) override;
  void on_end(const StepRecord& last, StateSource& source) override;
  bool stop_requested() override;

  /// Brings everything to the disk and ends the progress line.
  void finish();
  /// Broken bonds and ties of the last row, in the order of breaking.
  const std::vector<Index>& broken() const { return broken_; }
  /// Forces of the places, where there are several, in the row of the largest |load|.
  const std::vector<PlaceForce>& places() const { return places_; }
  double seconds_writing() const { return seconds_writing_; }

 private:
  void note_places(const StepRecord& record, StateSource& source);
  void note_broken(const StepRecord& record, StateSource& source);
  bool wants_fields(Index broken_bonds) const;
  VtuGrid make_grid(const StepRecord& record, StateSource& source);
  void write_fields(const StepRecord& record, StateSource& source);

  const CaseFile& input_;
  const Model& model_;
  std::filesystem::path directory_;
  HistoryFile history_;
  Progress progress_;
  Csr families_;               ///< made with the first field file
  std::vector<Index> broken_;  ///< in the order of breaking
  std::vector<std::uint8_t> is_broken_;
  Index last_element_ = no_index;  ///< that failed at the end of the last row
  std::vector<PvdEntry> series_;   ///< field files by rows
  Index broken_at_fields_ = 0;     ///< number of broken bonds in the last of them
  double highest_ = 0.0;           ///< |load| so far
  std::vector<PlaceForce> places_;
  double seconds_writing_ = 0.0;
};

}  // namespace perilink
