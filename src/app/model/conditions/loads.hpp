#pragma once

#include "app/model/model.hpp"

namespace perilink {

/// All loads of a case on the particles of its model.
struct AppliedLoads {
  Loads loads;
  std::vector<LoadRegion> places;
  std::vector<std::string> notes;  ///< point loads that had to move
};

/// Loads at load factor 1; docs/theory/loads.md says how each is shared among particles.
/// \param width  components of a particle's motion; forces fill the first dim of them
/// \param stage  the loads of this stage alone; empty: all
/// \throws InputError  for regions that catch no particle or no facet, and points
///                     outside the body
AppliedLoads collect_loads(const CaseFile& input, const Model& model, int width,
                           const std::string& stage = "");

}  // namespace perilink
