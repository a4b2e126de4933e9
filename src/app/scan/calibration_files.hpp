#pragma once

#include <filesystem>
#include <string>

#include "calibration/kept/kept_calibration.hpp"

namespace perilink {

/// Calibrations in the files of a directory, for runs that differ in strengths, loads or stop rules
/// only. Several processes may share the directory.
class CalibrationFiles final : public CalibrationStore {
 public:
  /// Makes the directory. \throws FileError
  explicit CalibrationFiles(std::filesystem::path directory);

  /// A damaged file, or one of another version of the program, counts as none.
  std::optional<KeptCalibration> find(const std::string& key) override;
  /// Without room for the file the result is not kept.
  void keep(const std::string& key, const KeptCalibration& result) override;

 private:
  std::string path_for(const std::string& key) const;

  std::filesystem::path directory_;
};

}  // namespace perilink
