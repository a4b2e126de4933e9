#pragma once

#include <cstdint>
#include <vector>

#include "app/configure.hpp"

namespace perilink {

/// Displacements and rotations that are prescribed.
struct Prescription {
  std::vector<std::uint8_t> held;  ///< shape (particles, width)
  std::vector<double> value;       ///< at load factor 1 [length], of rotations [-]
};

/// Supports and driven displacements of a case.
/// \throws InputError  for regions without particles and entries that contradict each other
Prescription collect_prescriptions(const CaseFile& input, const Model& model);

}  // namespace perilink
