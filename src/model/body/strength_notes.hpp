#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "model/model.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Advice on the horizon of softening bonds (docs/theory/softening.md, section 5).
inline constexpr const char* horizon_advice =
    "take a horizon of a twentieth to a thirtieth of E G_F / f_t^2";

/// Returns whether the horizon of softening bonds is so short that stressed bodies soften
/// everywhere.
bool is_short_horizon(double horizon, const MaterialStrength& strength);

/// Returns a sentence for each implausible strength: relative to the modulus, and with a process
/// zone implausible relative to the horizon or the body.
/// \param youngs_modulus  [force/length^2]
/// \param horizon         [length]
/// \param body            longest side of the body [length]
std::vector<std::string> strength_notes(const MaterialStrength& strength, double youngs_modulus,
                                        double horizon, double body);

/// Returns these notes for all materials with a known strength, with material names.
std::vector<std::string> strength_notes(const CaseFile& input, const Model& model);

/// Returns advice on the crack path, where bonds can break and no interface prescribes the path.
/// Lattices attract cracks to their rows, and bonds without moments resist curved cracks.
std::optional<std::string> path_note(const CaseFile& input, const Model& model);

/// Returns a note on the strength of a softening body that fills its bounding box: it has no notch,
/// hole or pre-crack, so damage spreads before one crack forms (docs/theory/softening.md, section
/// 6). Bodies with random strength, bars, interfaces or sections have no note.
std::optional<std::string> unnotched_note(const CaseFile& input, const Model& model);

/// Returns a note on joints of materials with other stiffnesses, where a crack along them
/// dissipates too little: bodies calibrated as a whole, without interfaces
/// (docs/theory/calibration.md, section 6).
std::optional<std::string> joint_note(const NetworkInput& input, const Model& model);

/// Returns the range of the factors of each NetworkInput::fields over the bonds that it changes, of
/// random ones also their scatter.
std::vector<std::string> field_notes(const NetworkInput& input, const Network& network);

/// Returns notes on bars with unusual moduli or yield strengths.
std::vector<std::string> bar_notes(const CaseFile& input);

}  // namespace perilink
