#pragma once

#include "io/case/case_file.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Refuses shells with particles that rotate freely about the normal, mid-surfaces longer than the
/// circumference of their cylinder, and invalid planes of symmetry.
/// \throws InputError
void refuse_impossible_shell(const CaseFile& input, const Body& body, const NetworkInput& network);

}  // namespace perilink
