#pragma once

#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/process/run_callbacks.hpp"
#include "app/run/run_files.hpp"
#include "app/run/summary.hpp"
#include "base/timer.hpp"
#include "model/body/mesh_input.hpp"
#include "model/from_case/configure.hpp"
#include "model/reactions.hpp"

namespace perilink {

/// Wall seconds of the phases of a run.
struct PhaseSeconds {
  double set_up = 0.0;    ///< reading, particles, bonds, constants
  double analysis = 0.0;  ///< assembly, factorisation, events or steps
  double output = 0.0;    ///< field files
  std::vector<std::pair<std::string, double>> parts = {};  ///< parts of the first two
};

/// Termination status and reason in the result of a run.
struct RunOutcome {
  Termination& termination;
  std::string& reason;
};

/// A run of one analysis type, with an interface common to all. Constructors build the model and
/// collect notes known before the analysis.
class RunKind {
 public:
  /// \param of_case  must outlive the run
  RunKind(const CaseFile& of_case, int on_threads, RunCallbacks to_call = {})
      : input(of_case),
        meshes(mesh_checksum(of_case)),
        threads(on_threads),
        callbacks(std::move(to_call)) {}
  virtual ~RunKind() = default;

  /// Opens the files in the directory of the run.
  /// \param saved  state to go on from; empty: the run begins
  /// \throws FileError
  void open(const std::filesystem::path& directory, const RunCallbacks& calls,
            const std::string& saved = {});
  RunFiles& files() const { return *files_; }
  /// Runs the analysis. Its termination status is in run_outcome().
  virtual void analyse() = 0;
  virtual RunOutcome run_outcome() = 0;
  /// Returns a text that identifies the model; empty if runs of this type are not saved.
  virtual std::string model_fingerprint() const { return {}; }
  /// Returns the point fields of supports and loads, condition_fields().
  virtual std::vector<VtuArray> constant_fields() const { return {}; }
  /// Adds the results of this analysis type to the summary.
  virtual void tell(Summary& summary) const = 0;

  const CaseFile& input;
  const std::string meshes;  ///< mesh_checksum() before the model is built
  const int threads;
  const RunCallbacks callbacks;
  std::string plan;                        ///< sizes and steps to come, for the log
  std::vector<std::string> notes;          ///< known before the analysis
  std::optional<std::string> calibration;  ///< result of the bond calibration, if there is one
  PhaseSeconds seconds;
  std::exception_ptr failure;  ///< exception that ended the analysis, if one did

 protected:
  /// Writes a checkpoint. \param state  bytes of pack() \throws FileError
  void save(const std::string& state);
  /// Goes on from the bytes given to save(). \throws FileError
  virtual void restore(const std::string& /*state*/) {}
  /// Returns the number of rows between checkpoints of a run over time: as the case says, else by
  /// counted work; 0: none.
  /// \param elements   number of bonds that each step visits
  /// \param particles  number of particles in a saved state
  /// \param steps      between two rows
  Index rows_of_time(double elements, double particles, double steps) const;
  /// Notes whether a row of a run over time has met the rule of [stop] by a gauge.
  void note_rule(std::span<const double> gauges);
  /// Whether a row of a run over time has met this rule, after which there are no checkpoints.
  bool has_met_rule() const { return met_rule_.has_value(); }
  /// Makes a run over time complete that was stopped by this rule.
  void complete_by_rule(RunOutcome run_outcome) const;

  std::filesystem::path directory_;
  Timer since_opened_;
  std::unique_ptr<RunFiles> files_;

 private:
  std::optional<std::string> met_rule_;  ///< why the run is complete
};

/// A run on a network of bonds, or on linear elements.
class NetworkRun : public RunKind {
 public:
  NetworkRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls);
  std::string model_fingerprint() const override;
  std::vector<VtuArray> constant_fields() const override { return condition_fields(model_); }

 protected:
  /// Returns a rate, "3.2 M bond-steps/s".
  std::string bond_rate(Index steps) const;
  /// Writes reactions_STEP.csv of an equilibrium and checks that its sum vanishes, to 1e-8 or to
  /// the bound from the residual of the equilibrium.
  void write_reactions(const StepRecord& row, const std::vector<SupportRegion>& places,
                       const ModelState& state, ReactionBalance& balance);

  Model model_;
};

/// Builds the model of a case and its run.
/// \param input  must outlive the run
/// \throws InputError where the case does not fit its body
std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, const RunCallbacks& calls);

/// Builds a run of one analysis type, see make_run().
std::unique_ptr<RunKind> make_elastic_run(const CaseFile& input, int threads,
                                          const RunCallbacks& calls);
std::unique_ptr<RunKind> make_relaxation_run(const CaseFile& input, int threads,
                                             const RunCallbacks& calls);
std::unique_ptr<RunKind> make_bond_run(const CaseFile& input, int threads,
                                       const RunCallbacks& calls);
std::unique_ptr<RunKind> make_lattice_run(const CaseFile& input, int threads,
                                          const RunCallbacks& calls);

/// Formats a rate, "3.2 M particle-steps/s"; zero for no time.
std::string rate_text(double count, double seconds, const std::string& unit);

/// Returns the summary of a run at its end.
Summary summary_of(RunKind& run, const std::filesystem::path& directory);

/// Calls build_model() and shows the progress of the calibration on a terminal.
Model build_model_visibly(const CaseFile& input, const RunCallbacks& calls);

}  // namespace perilink
