#include "app/scan/calibration_files.hpp"

#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/checkpoint/pack.hpp"

namespace perilink {

CalibrationFiles::CalibrationFiles(std::filesystem::path directory)
    : directory_(std::move(directory)) {
  std::error_code fault;
  std::filesystem::create_directories(directory_, fault);
  if (std::filesystem::is_directory(directory_, fault)) return;
  throw FileError("--calibrations: '" + directory_.string() +
                  "' is no directory, and none can be made there");
}

std::string CalibrationFiles::path_for(const std::string& key) const {
  return (directory_ / (key + ".calibration")).string();
}

std::optional<KeptCalibration> CalibrationFiles::find(const std::string& key) {
  try {
    const std::optional<Checkpoint> file = read_checkpoint(path_for(key));
    if (!file || file->model != key) return std::nullopt;
    KeptCalibration kept;
    unpack(file->state, kept);
    return kept;
  } catch (const FileError&) {  // the calibration is made again
    return std::nullopt;
  }
}

void CalibrationFiles::keep(const std::string& key, const KeptCalibration& result) {
  try {
    write_checkpoint(path_for(key), {"", key, pack(result)});
  } catch (const FileError&) {  // the run has its calibration
  }
}

}  // namespace perilink
