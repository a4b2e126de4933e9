#pragma once

#include <filesystem>
#include <vector>

#include "app/run/quasistatic_run.hpp"
#include "app/run/run_notes.hpp"
#include "base/csr.hpp"

namespace perilink {

/// Turns what happens in a damage run into files and progress: every row into the history, the
/// states that the case asks for (and the first and the last) into field files.
class DamageObserver final : public StepObserver, public RunFiles {
 public:
  DamageObserver(const CaseFile& input, const Model& model, std::filesystem::path directory,
                 bool quiet);

  void on_step(const StepRecord& record, StateSource& source) override;
  void on_end(const StepRecord& last, StateSource& source) override;
  bool stop_requested() override;

  /// Broken bonds and ties of the last row, in the order of breaking.
  const std::vector<Index>& broken() const { return broken_; }
  /// Forces of the places, where there are several, in the row of the largest |load|.
  const std::vector<PlaceForce>& places() const { return places_; }

 private:
  void note_places(const StepRecord& record, StateSource& source);
  void note_broken(const StepRecord& record, StateSource& source);
  bool wants_fields(Index broken_bonds) const;
  void write_state(const StepRecord& record, StateSource& source);
  void show_progress(const StepRecord& record);

  const Model& model_;
  Csr families_;               ///< made with the first field file
  std::vector<Index> broken_;  ///< in the order of breaking
  std::vector<std::uint8_t> is_broken_;
  Index last_element_ = no_index;  ///< that failed at the end of the last row
  Index broken_at_fields_ = 0;     ///< number of broken bonds in the last field file
  double highest_ = 0.0;           ///< |load| so far
  std::vector<PlaceForce> places_;
};

Equilibria found_by(const DamageResult& result);

/// A run with type = "damage".
class DamageRun final : public QuasistaticRun {
 public:
  using QuasistaticRun::QuasistaticRun;
  RunFiles& open(const std::filesystem::path& directory, bool quiet) override {
    return observer_.emplace(input_, model_, directory, quiet);
  }
  void analyse() override {
    result_ = run_damage_analysis(model_, damage_options(input_, threads_), *observer_);
  }
  Verdict verdict() override { return {result_.ending, result_.reason}; }
  std::vector<std::optional<std::string>> late_notes() const override {
    return {note_of_grips(model_, observer_->broken()),
            note_of_peaks(result_, model_, observer_->broken())};
  }

 protected:
  Equilibria found() const override { return found_by(result_); }
  const std::vector<PlaceForce>& places() const override { return observer_->places(); }

 private:
  std::optional<DamageObserver> observer_;
  DamageResult result_;
};

}  // namespace perilink
