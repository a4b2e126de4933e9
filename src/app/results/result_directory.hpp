#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perilink {

/// Default place of the results of a case: results/<name of the case file>.
std::filesystem::path default_result_directory(const std::string& case_path);

/// Refuses a directory that holds results of an earlier run, unless `force` is set; changes
/// nothing.
/// \return the files of that run, in the order in which they go
/// \throws FileError
std::vector<std::filesystem::path> refuse_old_results(const std::filesystem::path& directory,
                                                      bool force);

/// Refuses a directory in which a copy that is written there would take the place of the user's own
/// file.
/// \param copy     name of the copy
/// \param written  "this case with its resolved form"
/// \throws FileError
void refuse_own_file(const std::filesystem::path& directory, const char* copy,
                     const std::string& own, const char* written);

/// Refuses what is no result of a run, and says what it is instead. \throws FileError
void require_result(const std::filesystem::path& directory);

/// The directory of a run while it writes. An existing result is refused unless `force` is set;
/// then the files that a run writes, and only those, are removed. No second run can have the
/// directory at the same time; when the process ends, in whatever way, it is free again.
class ResultDirectory {
 public:
  /// Makes the directory. \throws FileError
  ResultDirectory(const std::filesystem::path& directory, bool force);
  ~ResultDirectory();
  ResultDirectory(const ResultDirectory&) = delete;
  ResultDirectory& operator=(const ResultDirectory&) = delete;

 private:
  int lock_ = -1;  ///< descriptor of the directory
};

}  // namespace perilink
