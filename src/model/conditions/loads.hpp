#pragma once

#include "model/model.hpp"

namespace perilink {

/// Loads of a case on the particles of its model.
struct AppliedLoads {
  Loads loads;
  std::vector<LoadRegion> places;
  std::vector<std::string> notes;  ///< on point loads that were moved to a particle
};

/// Collects the loads at load factor 1; docs/theory/loads.md gives the distribution among
/// particles.
/// \param width  components of a particle's motion; forces are the first dim of them
/// \param stage  only the loads of this stage; empty: all
/// \throws InputError  for regions without particles or facets, and points
///                     outside the body
AppliedLoads collect_loads(const CaseFile& input, const Model& model, int width,
                           const std::string& stage = "");

}  // namespace perilink
