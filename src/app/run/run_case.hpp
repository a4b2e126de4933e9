#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "analysis/quasistatic/observer.hpp"
#include "app/process/run_callbacks.hpp"
#include "app/run/summary.hpp"
#include "io/case/case_file.hpp"
#include "results/result_directory.hpp"

namespace perilink {

struct RunSettings {
  int threads = 1;  ///< number of threads, see set_threads()
  /// Kept: the run goes on from the checkpoint of results of the same case.
  OldResults old_results = OldResults::refused;
  RunCallbacks callbacks = {};
};

/// End of a run that began. Its files are complete, whatever the termination.
struct RunEnd {
  Termination termination = Termination::completed;
  std::string reason = {};
  Summary summary = {};           ///< contents of summary.json
  std::exception_ptr error = {};  ///< the failure, where the run failed by an exception
  bool ran = true;  ///< false: the directory held the whole run, which was not repeated
};

/// Runs a case of any analysis type and writes its results.
/// \param directory  made where it does not exist, locked during the run
/// \throws InputError  where the case does not fit its body
/// \throws FileError   where the directory has results that are refused, or cannot be written
RunEnd run_case(const CaseFile& input, const std::filesystem::path& directory,
                const RunSettings& settings = {});

}  // namespace perilink
