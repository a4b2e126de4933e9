#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/from_case/configure.hpp"
#include "app/model/reactions.hpp"
#include "app/run/run_files.hpp"
#include "app/run/summary.hpp"

namespace perilink {

/// Wall seconds of the phases of a run.
struct PhaseSeconds {
  double set_up = 0.0;    ///< reading, particles, bonds, constants
  double analysis = 0.0;  ///< assembly, factorisation, events or steps
  double output = 0.0;    ///< field files
  std::vector<std::pair<std::string, double>> parts = {};  ///< what is in the first two
};

/// How a run ended, in its result.
struct RunOutcome {
  Termination& termination;
  std::string& reason;
};

/// One kind of run: `perilink run` takes all kinds through the same frame. Constructors build the
/// model of the case and tell what is known before the analysis.
class RunKind {
 public:
  /// \param of_case  must outlive the run
  RunKind(const CaseFile& of_case, int on_threads) : input(of_case), threads(on_threads) {}
  virtual ~RunKind() = default;

  /// Opens the files in the directory of the run. \throws FileError
  RunFiles& open(const std::filesystem::path& directory, bool quiet) {
    return *(files_ = std::make_unique<RunFiles>(input, directory, quiet));
  }
  RunFiles& files() const { return *files_; }
  /// Runs the analysis; an ending that it tells itself is in verdict().
  virtual void analyse() = 0;
  virtual RunOutcome run_outcome() = 0;
  /// Adds what this kind of run tells, between what all kinds tell.
  virtual void tell(Summary& summary) const = 0;

  const CaseFile& input;
  const int threads;
  std::string plan;                        ///< sizes and steps to come, for the log
  std::vector<std::string> notes;          ///< what is worth knowing before the analysis
  std::optional<std::string> calibration;  ///< what that of the bonds reached, where there is one
  PhaseSeconds seconds;

 protected:
  std::unique_ptr<RunFiles> files_;
};

/// A run on a network of bonds, or on linear elements.
class NetworkRun : public RunKind {
 public:
  NetworkRun(const CaseFile& of_case, int on_threads, bool quiet);

 protected:
  /// "3.2 M bond-steps/s".
  std::string bond_rate(Index steps) const;
  /// Writes reactions_STEP.csv of an equilibrium and compares its sum with zero: to 1e-8, or what
  /// the residual of the equilibrium can leave.
  void write_reactions(const StepRecord& row, const std::vector<SupportRegion>& places,
                       const ModelState& state);

  Model model_;
  ReactionBalance balance_;
};

/// Builds the model of a case for the kind of run that it asks for.
/// \param input  must outlive the run
/// \throws InputError where the case makes no sense for its body
std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet);

/// Single kinds.
std::unique_ptr<RunKind> make_elastic_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_relaxation_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_bond_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_lattice_run(const CaseFile& input, int threads);

/// "3.2 M particle-steps/s"; zero of no time.
std::string rate_text(double count, double seconds, const std::string& unit);

/// What a run tells at its end.
Summary summary_of(RunKind& run, const std::filesystem::path& directory);

/// build_model(), while people at a terminal see how the calibration of the bonds comes along.
Model build_model_visibly(const CaseFile& input, bool quiet);

}  // namespace perilink
