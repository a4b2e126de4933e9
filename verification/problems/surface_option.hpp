#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace perilink::verification {

/// Takes `--surface calibrated` or `--surface none` out of a program's arguments: the bonds of the
/// block that a study breaks. \return calibrated where the arguments say nothing
inline std::string take_surface_option(std::vector<std::string>& arguments) {
  const auto option = std::find(arguments.begin(), arguments.end(), "--surface");
  if (option == arguments.end()) return "calibrated";
  if (option + 1 == arguments.end() || (option[1] != "calibrated" && option[1] != "none")) {
    throw std::invalid_argument("--surface must be followed by calibrated or none");
  }
  std::string surface = option[1];
  arguments.erase(option, option + 2);
  return surface;
}

/// File of a study's folder that holds the table of these bonds.
inline std::string result_file(const std::string& surface) {
  return surface == "calibrated" ? "result.csv" : "result_" + surface + ".csv";
}

}  // namespace perilink::verification
