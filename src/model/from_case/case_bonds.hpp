#pragma once

#include <vector>

#include "calibration/calibration.hpp"
#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"
#include "material/strength/property_field.hpp"
#include "model/model.hpp"

namespace perilink {

/// Options for building bonds.
struct BondOptions {
  bool draft = false;  ///< skips the calibration
  CalibrationCalls calibration = {};
};

/// Whether materials differ in an elastic constant. The Poisson's ratio of trusses counts as equal
/// whether it is left out or given with few digits.
bool have_unlike_constants(const CaseFile& input);

/// Builds the bonds and bars of a case between the particles of its body.
/// \param fields  property_fields() of the case
/// \throws InputError where the case does not fit its body
void build_bonds(const CaseFile& input, const BondOptions& options,
                 std::vector<PropertyField> fields, Body& body, Model& model);

}  // namespace perilink
