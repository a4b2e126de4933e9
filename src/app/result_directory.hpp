#pragma once

#include <filesystem>
#include <string>

namespace perilink {

/// Default place of the results of a case: results/<name of the case file>.
std::filesystem::path default_result_directory(const std::string& case_path);

/// Makes the directory of a run. An existing result is refused unless `force` is set; then the files
/// that a run writes, and only those, are removed.
/// \throws FileError
void prepare_result_directory(const std::filesystem::path& directory, bool force);

}  // namespace perilink
