#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/from_case/configure.hpp"
#include "app/run/run_files.hpp"
#include "app/run/summary.hpp"

namespace perilink {

/// Wall seconds of the phases of a run.
struct PhaseSeconds {
  double set_up = 0.0;    ///< reading, particles, bonds, constants
  double analysis = 0.0;  ///< assembly, factorisation, events or steps
  double output = 0.0;    ///< field files
  std::vector<std::pair<std::string, double>> parts = {};  ///< of the first two
};

/// How a run ended, in its result.
struct Verdict {
  Ending& ending;
  std::string& reason;
};

/// One kind of run, from the model of its case to its summary. `perilink run` takes all kinds
/// through the same frame, which calls these functions in their order. Constructors build the model
/// and fill in what is known before the analysis.
class RunKind {
 public:
  RunKind(const CaseFile& input, int threads) : input_(input), threads_(threads) {}
  virtual ~RunKind() = default;

  /// Opens the files of the run in its directory. \throws FileError
  virtual RunFiles& open(const std::filesystem::path& directory, bool quiet) = 0;
  /// Runs the analysis; an ending that it tells itself is in verdict().
  virtual void analyse() = 0;
  virtual Verdict verdict() = 0;
  /// What is worth knowing and only known at the end.
  virtual std::vector<std::optional<std::string>> late_notes() const { return {}; }
  /// What makes the numbers doubtful, a sentence each.
  virtual std::vector<std::string> doubts() const { return {}; }
  /// Steps and cracks, for the log.
  virtual std::string outcome() const = 0;
  /// Adds the quantities of this kind of run, which stand between those of all kinds.
  virtual void tell(Summary& summary) const = 0;
  /// How fast the analysis was: "0.2 ms per row".
  virtual std::string rate() const = 0;

  const CaseFile& input() const { return input_; }
  int threads() const { return threads_; }

  std::string plan;                        ///< sizes and steps to come, for the log
  std::vector<std::string> notes;          ///< what is worth knowing
  std::optional<std::string> calibration;  ///< what that of the bonds reached, where there is one
  PhaseSeconds seconds;

 protected:
  /// Notes and calibration of a model of bonds.
  void take_notes(const Model& model);

  const CaseFile& input_;
  const int threads_;
};

/// "3.2 M bond-steps/s"; zero of no time.
std::string rate_text(double count, double seconds, const std::string& unit);

/// What a run tells at its end, as JSON and as text.
Summary summary_of(RunKind& run, const std::filesystem::path& directory);

/// build_model(), while people at a terminal see how the calibration of the bonds comes along.
Model build_model_visibly(const CaseFile& input, bool quiet);

}  // namespace perilink
