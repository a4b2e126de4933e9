#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perilink {

/// Returns the default directory of the results of a case: results/<name of the case file>.
std::filesystem::path default_result_directory(const std::string& case_path);

/// Refuses a directory with results of an earlier run, unless `force` is set. Removes no file.
/// \return the files of that run, in the order of removal
/// \throws FileError
std::vector<std::filesystem::path> refuse_old_results(const std::filesystem::path& directory,
                                                      bool force);

/// Refuses a directory in which a written copy would overwrite the user's own file.
/// \param copy     name of the copy
/// \param written  "this case with its resolved form"
/// \throws FileError
void refuse_own_file(const std::filesystem::path& directory, const char* copy,
                     const std::string& own, const char* written);

/// Refuses a path that is not a result of a run and says what it is. \throws FileError
void require_result(const std::filesystem::path& directory);

/// Treatment of an existing result: refused; removed, but only files that a run writes; or kept
/// except for unfinished files of a killed run.
enum class OldResults { refused, removed, kept };

/// Locked directory of a run. The lock excludes other runs and ends with the process.
class ResultDirectory {
 public:
  /// Creates and locks the directory. \throws FileError
  ResultDirectory(const std::filesystem::path& directory, OldResults old);
  ~ResultDirectory();
  /// Removes the files of an earlier run. \throws FileError
  void remove_old_results();
  ResultDirectory(const ResultDirectory&) = delete;
  ResultDirectory& operator=(const ResultDirectory&) = delete;

 private:
  std::filesystem::path directory_;
  int lock_ = -1;  ///< descriptor of the directory
};

}  // namespace perilink
