#pragma once

#include <cstddef>
#include <optional>

#include "io/case/case_file.hpp"

namespace perilink {

/// Returns the first of [[cracks]] whose faces press on each other.
std::optional<std::size_t> first_closing_crack(const CaseFile& input);

/// Refuses keys that Green strains and [[velocities]] exclude.
void check_moving_bonds(const CaseFile& input);

}  // namespace perilink
