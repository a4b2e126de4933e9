#pragma once

#include <string>

#include "analysis/quasistatic/damage_state.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// Returns a text that identifies a problem: the state of an analysis of it fits no other.
std::string fingerprint_of(const LoadedNetwork& problem);

/// Refuses the state of another problem.
/// \param fingerprint  fingerprint_of() the problem of the state
/// \param name         of the state in the message
/// \throws FileError
void require_state_of(const LoadedNetwork& problem, const std::string& fingerprint,
                      const std::string& name);

/// Writes the state of a damage analysis between two rows, EventRun::save(), with the version of
/// the program and a checksum. \throws FileError
void write_state(const std::string& path, const LoadedNetwork& problem, const DamageState& state);

/// Reads the state of a damage analysis.
/// \param problem  must equal the problem of the analysis
/// \throws FileError if the file is missing, damaged, or of another problem or program version
DamageState read_state(const std::string& path, const LoadedNetwork& problem);

}  // namespace perilink
