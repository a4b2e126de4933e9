#pragma once

#include <filesystem>
#include <vector>

#include "analysis/dynamics/bonds/bond_analysis.hpp"
#include "analysis/quasistatic/load_curve.hpp"
#include "app/model/from_case/configure.hpp"
#include "app/process/progress.hpp"
#include "app/results/explicit_history.hpp"
#include "app/run/summary.hpp"
#include "base/csr.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// What an explicit case of bonds adds to its model.
struct BondRunCase {
  Inertia inertia;
  BondRunRules rules;
  ExplicitOptions options;  ///< threads left at one
  Index steps = 0;
};

/// "3 broken bonds" or, of state-based particles, "3 cracked particles".
std::string cracks_text(const Model& model, const ExplicitRecord& record);

/// Masses and steps of a case with type = "explicit" whose body has bonds.
/// \throws InputError for a time step above the critical one, or too many steps
BondRunCase build_bond_run(const CaseFile& input, const Model& model);

/// Turns what happens in the run into files and progress: every row into the history, the states at
/// the times that the case asks for (and the first and the last) into field files, of a dynamic
/// relaxation those of all rows.
class BondRunFiles final : public BondRunObserver {
 public:
  /// \param steps  in the whole run, for the progress
  BondRunFiles(const CaseFile& input, const Model& model, Index steps,
               std::filesystem::path directory, bool quiet);

  void on_row(const ExplicitRecord& record, const BondRunState& state) override;
  void on_end(const ExplicitRecord& last, const BondRunState& state) override;
  void on_iteration(Index load_step, Index iteration, double residual) override;
  bool stop_requested() override;

  /// Brings everything to the disk, ends the progress line.
  void finish();
  Index rows() const { return rows_; }
  const PeakWatch& peaks() const { return peaks_; }
  std::vector<std::string> doubts(const ExplicitResult& result) const;
  double seconds_writing() const { return seconds_writing_; }

 private:
  void write_fields(const ExplicitRecord& record, const BondRunState& state);

  const CaseFile& input_;
  const Model& model_;
  Index steps_;
  std::filesystem::path directory_;
  ExplicitHistory history_;
  ProgressBar bar_;
  Csr families_;
  Index rows_ = 0;
  Index loose_pieces_ = 0;  ///< at the end
  PeakWatch peaks_;
  std::size_t next_time_ = 0;  ///< next entry of the case's output.fields_times
  std::vector<PvdEntry> series_;
  double seconds_writing_ = 0.0;
};

/// Writes DIR/summary.json. \throws FileError
void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const ExplicitResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds, int threads);

/// The same for people, on standard output.
void print_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const ExplicitResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds);

}  // namespace perilink
