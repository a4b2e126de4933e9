#pragma once

#include <vector>

#include "analysis/quasistatic/event_run.hpp"
#include "analysis/quasistatic/peak_states.hpp"
#include "app/run/quasistatic.hpp"
#include "app/run/run_kind.hpp"
#include "app/run/run_warnings.hpp"
#include "base/csr.hpp"
#include "model/expected_events.hpp"
#include "model/face_overlap.hpp"
#include "model/symmetry_damage.hpp"

namespace perilink {

/// A run with type = "damage". Every row goes into the history. Field files hold the first, the
/// last and the requested states.
class DamageRun final : public NetworkRun {
 public:
  DamageRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls);

  void analyse() override;
  RunOutcome run_outcome() override { return {result_.termination, result_.reason}; }
  void tell(Summary& summary) const override;

  /// Writes a row, and the fields that are due. \throws FileError
  void add_row(const StepRecord& record, StateSource& source);
  /// Writes the fields of the last equilibrium, before any separation. \throws FileError
  void end(const StepRecord& last, StateSource& source);

 private:
  /// A row with the largest |load| so far, recorded where there are several regions.
  struct HighRow {
    double load = 0.0, load_factor = 0.0;
    std::vector<RegionForce>
        places;  ///< boundary regions; load regions follow from the load factor

    template <class Archive>
    void serialize(Archive& archive) {
      archive(load, load_factor, places);
    }
  };
  /// Largest compression in a field file.
  struct FieldCompression {
    CurvePoint row;
    Compression largest;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(row, largest);
    }
  };
  /// Records of the rows so far.
  struct Records {
    Index missed_releases = 0;        ///< number of restarts after a missed release
    std::vector<std::uint8_t> whole;  ///< active hosts at the start, per finite element
    Index checkpoint_rows = 0;        ///< rows between checkpoints; 0: none
    std::vector<Index> broken;        ///< bonds and bond-slip springs, in the order of breaking
    Index last_element = no_index;    ///< element that failed at the end of the last row
    Index last_events = 1;            ///< number of elements that failed with it
    Index broken_at_fields = 0;       ///< number of broken bonds in the last field file
    Index last_stage = 0;             ///< stage of the last row
    double highest = 0.0;             ///< |load| so far
    CurvePoint before;                ///< last row
    double area = 0.0;                ///< under the rows [force length]
    std::vector<double> gauges;       ///< of the last row
    std::vector<double> set_factors;  ///< per set of Model::sets, in the last row
    std::vector<GrownCrack> cracks;   ///< in the last field file
    std::vector<HighRow> high_rows;
    PeakStates peaks;
    Index written_peak = 0;  ///< row of the fields written as those of the peak so far; 0: none
    std::vector<FieldCompression> compressions;  ///< of all field files
    FaceOverlap overlap;                         ///< deepest one in all field files
    ReactionBalance balance;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(missed_releases, whole, checkpoint_rows, broken, last_element, last_events,
              broken_at_fields, last_stage, highest, before, area, gauges, set_factors, cracks,
              high_rows, peaks, written_peak, compressions, overlap, balance);
    }
  };

  void restore(const std::string& state) override;
  void follow();
  void go_on_from_checkpoint();
  double scale_of(const StepRecord& record) const;
  ModelState model_state(const StepRecord& record, const StepState& state) const;
  void note_places(const StepRecord& record, StateSource& source);
  Compression compression_at(const CurvePoint& row) const;
  std::vector<RegionForce> places_at_peak() const;
  void tell_stresses(Summary& summary, Equilibria& found) const;
  void tell_elements(Summary& summary) const;
  void begin_again(const std::vector<std::uint8_t>& whole);
  void mark_broken();
  void note_broken(const StepRecord& record, StateSource& source);
  bool wants_fields(const StepRecord& record) const;
  // Field files: damage_fields.cpp.
  VtuGrid fields_of(const StepRecord& record, const StepState& state, bool is_last);
  void write_state(const StepRecord& record, StateSource& source);
  void note_peak(const StepRecord& record, StateSource& source);
  bool write_fields_of(const PeakStates::State& peak, StateSource& source);
  void write_peak(const DamageResult& result, StateSource& source);
  void show_progress(const StepRecord& record);

  DamageOptions options_;
  std::optional<std::optional<ExpectedCrack>> crack_;  ///< expected_crack(), once it was wanted
  std::unique_ptr<EventRun> run_;
  DamageResult result_;
  Records records_;
  Csr neighbourhoods_;  ///< made with the first field file
  std::vector<std::uint8_t> is_broken_;
  std::vector<SupportRegion> places_held_;
  std::vector<std::size_t> set_of_stage_;      ///< index in Model::sets, per stage
  SoftenedEnergy softened_;                    ///< at the end
  std::optional<SymmetryDamage> on_symmetry_;  ///< at the end
};

}  // namespace perilink
