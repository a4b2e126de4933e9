#pragma once

#include <vector>

#include "app/run/quasistatic.hpp"
#include "app/run/run_kind.hpp"
#include "app/run/run_warnings.hpp"
#include "base/csr.hpp"

namespace perilink {

/// A run with type = "damage". Every row goes into the history. Field files hold the first, the
/// last and the requested states.
class DamageRun final : public NetworkRun, public StepObserver {
 public:
  DamageRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls);

  void analyse() override;
  RunOutcome run_outcome() override { return {result_.termination, result_.reason}; }
  void tell(Summary& summary) const override;

  void on_step(const StepRecord& record, StateSource& source) override;
  void on_end(const StepRecord& last, StateSource& source) override;
  bool stop_requested() override;

 private:
  double scale_of(const StepRecord& record) const;
  ModelState model_state(const StepRecord& record, const StepState& state) const;
  void note_places(const StepRecord& record, StateSource& source);
  void note_compression(const StepRecord& record, const VtuGrid& grid);
  std::vector<RegionForce> places_at_peak() const;
  void tell_stresses(Summary& summary, Equilibria& found) const;
  void tell_elements(Summary& summary) const;
  void begin_again(const MissedRelease& late);
  void note_broken(const StepRecord& record, StateSource& source);
  bool wants_fields(const StepRecord& record) const;
  void write_state(const StepRecord& record, StateSource& source);
  void show_progress(const StepRecord& record);

  DamageResult result_;
  Index missed_releases_ = 0;  ///< number of restarts after a missed release
  Csr neighbourhoods_;         ///< made with the first field file
  std::vector<Index> broken_;  ///< bonds and bond-slip springs, in the order of breaking
  std::vector<std::uint8_t> is_broken_;
  Index last_element_ = no_index;  ///< element that failed at the end of the last row
  Index last_events_ = 1;          ///< number of elements that failed with it
  Index broken_at_fields_ = 0;     ///< number of broken bonds in the last field file
  Index last_stage_ = 0;           ///< stage of the last row
  double highest_ = 0.0;           ///< |load| so far
  std::vector<SupportRegion> places_held_;
  std::vector<std::size_t> set_of_stage_;  ///< index in Model::sets, per stage
  std::vector<double> set_factors_;        ///< per set, in the last row
  std::vector<ToldCrack> cracks_;          ///< in the last field file
  /// A row with the largest |load| so far, recorded where there are several regions.
  struct HighRow {
    double load, load_factor;
    std::vector<RegionForce>
        places;  ///< boundary regions; load regions follow from the load factor
  };
  std::vector<HighRow> high_rows_;
  Compression compression_;  ///< at unit load; with stages the largest of all field files
  SoftenedEnergy softened_;  ///< at the end
};

}  // namespace perilink
