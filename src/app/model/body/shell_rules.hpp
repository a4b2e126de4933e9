#pragma once

#include "io/case/case_file.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Refuses shells whose particles would turn freely within the sheet, and sheets that are longer
/// than their cylinder is around, planes of symmetry that are none.
/// \throws InputError
void refuse_impossible_shell(const CaseFile& input, const Body& body, const NetworkInput& network);

}  // namespace perilink
