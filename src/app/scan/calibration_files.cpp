#include "app/scan/calibration_files.hpp"

#include <optional>
#include <system_error>

#include "base/error.hpp"
#include "io/checkpoint/checkpoint.hpp"

namespace perilink {

std::string CalibrationFiles::path_for(const std::string& input) const {
  return (directory_ / (fingerprint(input) + ".calibration")).string();
}

std::string CalibrationFiles::find(const std::string& input) {
  try {
    const std::optional<Checkpoint> kept = read_checkpoint(path_for(input));
    if (kept && kept->model == input) return kept->state;
  } catch (const FileError&) {  // the calibration is made again
  }
  return {};
}

void CalibrationFiles::keep(const std::string& input, const std::string& result) {
  std::error_code fault;
  std::filesystem::create_directories(directory_, fault);  // writing reports what is wrong
  write_checkpoint(path_for(input), {"", input, result});
}

}  // namespace perilink
