#pragma once

#include <optional>
#include <string>

#include "io/case/case_file.hpp"

namespace perilink {

/// Fills CaseFile::unused with the keys of [analysis], [stop] and [output] that the case's type of
/// analysis does not use, and puts [stop] and [output] back to their defaults there. One case may
/// so serve an implicit and an explicit run, which differ in `type` alone.
void set_aside_unused(CaseFile& input);

/// What a user should know of them; nothing where all keys are used.
std::optional<std::string> note_of_unused(const CaseFile& input);

}  // namespace perilink
