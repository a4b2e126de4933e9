#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perilink {

/// Default place of the results of a case: results/<name of the case file>.
std::filesystem::path default_result_directory(const std::string& case_path);

/// Refuses a directory that holds results of an earlier run, unless `force` is set; changes
/// nothing.
/// \return the files of that run
/// \throws FileError
std::vector<std::filesystem::path> refuse_old_results(const std::filesystem::path& directory,
                                                      bool force);

/// Makes the directory of a run. An existing result is refused unless `force` is set; then the
/// files that a run writes, and only those, are removed.
/// \throws FileError
void prepare_result_directory(const std::filesystem::path& directory, bool force);

}  // namespace perilink
