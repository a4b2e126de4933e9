#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns the fields of [[random]], then those of [[graded]], that the analysis uses. Elastic
/// analyses have no use for strength.
/// \param input  must outlive the fields, which throw InputError where a formula is not positive
/// \param particles  of the body
/// \param notes      receives a note on each file
/// \throws InputError where a file cannot be used
std::vector<PropertyField> property_fields(const CaseFile& input, const Particles& particles,
                                           std::vector<std::string>& notes);

/// Returns Young's modulus over that of the material [-] per particle, 1 at ghosts and bars; empty:
/// it does not vary.
/// \throws InputError where it varies more than double precision resolves
/// \param fields  property_fields() of the case
std::vector<double> modulus_of_particles(const CaseFile& input,
                                         std::span<const PropertyField> fields,
                                         const Network& network);

}  // namespace perilink
