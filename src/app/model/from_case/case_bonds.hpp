#pragma once

#include <vector>

#include "app/model/model.hpp"
#include "calibration/calibration.hpp"
#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// How the bonds of a model are made.
struct BondOptions {
  bool draft = false;  ///< not calibrated at all
  CalibrationObserver on_search;
};

/// Whether materials differ in an elastic constant. That of trusses is the Poisson's ratio of
/// bonds, given with some digits or left out.
bool have_unlike_constants(const CaseFile& input);

/// Puts the bonds and bars of a case between the particles of its body.
/// \throws InputError where the case makes no sense for its body
void build_bonds(const CaseFile& input, const BondOptions& options, Body& body, Model& model);

}  // namespace perilink
