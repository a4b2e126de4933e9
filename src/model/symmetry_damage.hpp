#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "model/model.hpp"
#include "network/secants.hpp"

/// \file
/// Damage along planes of symmetry. A half body takes the whole fracture energy of a crack there.

namespace perilink {

/// Damage along a plane of symmetry.
struct SymmetryDamage {
  std::size_t plane = 0;  ///< entry of [[symmetry]]
  double share = 0.0;     ///< of the energy that all bonds of the solid have dissipated [-]
};

/// Returns the plane of symmetry with the largest share in the dissipated energy; empty without
/// planes or dissipated energy. Bonds with one end in the plane count if they leave it at 45
/// degrees or more. Cracks along a plane have shares of 0.45 to 1, cracks across it 0.1 and less,
/// or up to 0.33 where they have cut its first rows only.
std::optional<SymmetryDamage> damage_on_symmetry(const CaseFile& input, const Model& model,
                                                 const Secants& secants);

/// Returns a note on a plane of symmetry that holds the breakable ligament beside a notch, from
/// which a crack would run along the plane.
std::optional<std::string> ligament_note(const CaseFile& input, const Model& model);

/// Returns a warning where a substantial part of the damage lies along a plane of symmetry.
std::optional<std::string> warning_about_symmetry(const std::optional<SymmetryDamage>& damage);

}  // namespace perilink
