#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"

namespace perilink {

/// Result of calibrate_bonds().
struct KeptCalibration {
  CalibrationReport report;
  std::vector<double> shares;  ///< of the facets
  BondStiffness stiffness;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(report, shares, stiffness.axial, stiffness.bending, stiffness.inflection);
  }
};

/// Keeps results of calibrations for further bodies with equal equations.
class CalibrationStore {
 public:
  virtual ~CalibrationStore() = default;
  /// \param key  digest of all that the calibration depends on, 32 letters
  virtual std::optional<KeptCalibration> find(const std::string& key) = 0;
  virtual void keep(const std::string& key, const KeptCalibration& result) = 0;
};

/// Calls calibrate_bonds(), or takes its result from a store that has it. The store receives new
/// results. Strengths and fracture energies are no input, so bodies that differ in them only have
/// one calibration.
/// \param store  null: calibrates every body
CalibrationReport calibrate_once(CalibrationStore* store, const CalibrationInput& input,
                                 const CalibrationOptions& options, Facets& facets,
                                 BondStiffness& stiffness);

}  // namespace perilink
