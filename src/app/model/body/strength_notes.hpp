#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/model.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Which horizons suit bonds that soften (docs/theory/softening.md, section 5).
inline constexpr const char* horizon_advice =
    "take a horizon of a twentieth to a thirtieth of E G_F / f_t^2";

/// What to tell of a strength that is out of all proportion to the stiffness of its material, or of
/// a process zone that is so to the horizon or the body: a sentence each.
/// \param youngs_modulus  [force/length^2]
/// \param horizon         [length]
/// \param body            longest side of the body [length]
std::vector<std::string> strength_notes(const MaterialStrength& strength, double youngs_modulus,
                                        double horizon, double body);

/// Those of all materials of a case whose strength is known, with their names.
std::vector<std::string> strength_notes(const CaseFile& input, const Model& model);

/// Lattices steer cracks: how to check their paths, where bonds of a lattice can break and no
/// interface prescribes the path.
std::optional<std::string> lattice_note(const CaseFile& input, const Model& model);

/// The same of bars whose moduli or yield strengths are far from all that is laid into solids.
std::vector<std::string> bar_notes(const CaseFile& input);

}  // namespace perilink
