#pragma once

#include <string>

#include "calibration/calibration.hpp"

namespace perilink {

/// Keeps results of calibrations as bytes, for further bodies with equal equations.
class CalibrationStore {
 public:
  virtual ~CalibrationStore() = default;
  /// Returns the result kept for exactly this input; empty: none.
  virtual std::string find(const std::string& input) = 0;
  virtual void keep(const std::string& input, const std::string& result) = 0;
};

/// Calls calibrate_bonds(), or takes its result from a store that has it. The store receives new
/// results. Strengths and fracture energies are no input, so bodies that differ in them only have
/// one calibration.
/// \param store  null: calibrates every body
CalibrationReport calibrate_once(CalibrationStore* store, const CalibrationInput& input,
                                 const CalibrationOptions& options, Facets& facets,
                                 BondStiffness& stiffness);

}  // namespace perilink
