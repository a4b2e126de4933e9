#pragma once

#include <vector>

#include "io/case/case_file.hpp"
#include "network/bond_softening.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns the interfaces of a case on the particles of its body; none for elastic analyses.
/// \throws InputError  for invalid lines, planes and groups, and faces along a plane of symmetry
std::vector<WeakInterface> weak_interfaces(const CaseFile& input, const Body& body);

/// Refuses an interface that crosses no bond of the network.
/// \throws InputError
void refuse_interfaces_without_bonds(const CaseFile& input, const Network& network);

/// Refuses a material or an interface whose strength does not fit its fracture energy.
/// \throws InputError
[[noreturn]] void refuse_unfit_strength(const CaseFile& input, const NetworkInput& network,
                                        const TooStrong& error);

}  // namespace perilink
