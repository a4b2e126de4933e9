#pragma once

#include <string>
#include <vector>

#include "app/model/model.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// What to tell of a strength that is out of all proportion to the stiffness of its material, or of
/// a process zone that is so to the horizon or the body: a sentence each.
/// \param youngs_modulus  [force/length^2]
/// \param horizon         [length]
/// \param body            longest side of the body [length]
std::vector<std::string> strength_notes(const MaterialStrength& strength, double youngs_modulus,
                                        double horizon, double body);

/// Those of all materials of a case whose strength is known, with their names.
std::vector<std::string> strength_notes(const CaseFile& input, const Model& model);

/// The same of bars whose moduli or yield strengths are far from all that is laid into solids.
std::vector<std::string> bar_notes(const CaseFile& input);

}  // namespace perilink
