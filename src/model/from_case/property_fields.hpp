#pragma once

#include <vector>

#include "io/case/case_file.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns the fields of [[random]], then those of [[graded]], that the analysis uses. Elastic
/// analyses have no use for strength.
/// \param input  must outlive the fields, which throw InputError where a formula is not positive
std::vector<PropertyField> property_fields(const CaseFile& input);

/// Returns Young's modulus over that of the material [-] per particle, 1 at ghosts and bars; empty:
/// it does not vary.
/// \throws InputError where it varies more than double precision resolves
std::vector<double> modulus_of_particles(const CaseFile& input, const Network& network);

}  // namespace perilink
