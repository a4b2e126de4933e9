#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

/// \file
/// Bonds with an unbreakable end never break, so two unbreakable parts that are less than two
/// horizons apart can never separate.

namespace perilink {

/// Returns a note where unbreakable bonds join a region with loads or prescribed displacements to
/// another one or to a support, although breakable particles separate their unbreakable parts.
/// Bonds across weak interfaces can break; bars and bond slip do not count.
std::optional<std::string> unbreakable_path_note(const CaseFile& input, const Model& model);

}  // namespace perilink
