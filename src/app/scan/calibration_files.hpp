#pragma once

#include <filesystem>
#include <string>

#include "calibration/kept/kept_calibration.hpp"

namespace perilink {

/// Calibrations in the files of a directory, for runs that differ in strengths, loads or stop rules
/// only. Several processes may share the directory.
class CalibrationFiles final : public CalibrationStore {
 public:
  /// \param directory  made when the first calibration is kept
  explicit CalibrationFiles(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// A damaged file, or one of another version of the program, counts as none.
  std::string find(const std::string& input) override;
  /// \throws FileError
  void keep(const std::string& input, const std::string& result) override;

 private:
  std::string path_for(const std::string& input) const;

  std::filesystem::path directory_;
};

}  // namespace perilink
