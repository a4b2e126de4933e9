#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/types.hpp"
#include "io/case/case_file.hpp"
#include "io/checkpoint/checkpoint.hpp"

/// \file
/// Runs that go on from a checkpoint, `perilink run CASE --resume`.

namespace perilink {

/// Name of the file with the state of a run, in its directory.
inline constexpr const char* checkpoint_name = "checkpoint.bin";

/// Returns the number of rows between checkpoints for which they take about 2 % of the run time. A
/// run of some seconds has none.
/// \param checkpoint  estimated time of a checkpoint [s]
/// \param row         estimated time of a row [s]
Index rows_between_checkpoints(double checkpoint, double row);

/// Returns the text of a case with a checksum in place of mesh paths. It lacks the rules that may
/// change before a run is taken up again: its stop rules, or those of the last stage.
/// \param meshes  mesh_checksum()
std::string resumable_case(const CaseFile& input, const std::string& meshes);

/// Returns whether results in a directory, if there are any, are of a run, which may have been
/// killed as it began.
bool holds_a_run(const std::filesystem::path& directory);

/// Results that `--resume` finds in a directory.
struct Resumed {
  bool is_finished = false;              ///< this case has been run to its end
  std::optional<Checkpoint> checkpoint;  ///< empty: the run begins anew
};

/// Looks for results of a case to go on with. \throws FileError if the directory holds results of
/// another case or mesh, lacks a history, or the checkpoint cannot be used
Resumed find_results(const CaseFile& input, const std::filesystem::path& directory);

/// Refuses a state that was saved with another model of the case. \throws FileError
void require_same_model(const Checkpoint& checkpoint, const std::string& fingerprint,
                        const std::filesystem::path& directory);

}  // namespace perilink
