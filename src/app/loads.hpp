#pragma once

#include "app/configure.hpp"

namespace perilink {

/// All loads of a case on the particles of its model.
struct AppliedLoads {
  Loads loads;
  /// Largest resultant of an entry [force]. An entry that is in balance by itself, such as a
  /// pressure all around, counts with the sum of its forces' sizes.
  double reference = 0.0;
  std::vector<std::string> notes;  ///< point loads that had to move
};

/// Loads at load factor 1; docs/theory/loads.md says how each is shared among particles.
/// \param width  components of a particle's motion; forces fill the first dim of them
/// \throws InputError  for regions that catch no particle or no facet, and points
///                     outside the body
AppliedLoads collect_loads(const CaseFile& input, const Model& model, int width);

}  // namespace perilink
