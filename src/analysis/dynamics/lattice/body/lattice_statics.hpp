#pragma once

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "network/states/lattice_network.hpp"

namespace perilink {

/// Returns the intact body of an explicit run as a network for small displacements. Bond forces are
/// the mean of their particles' force states. By the rules least_2018 the forces of the run differ.
LatticeNetwork lattice_network(const ExplicitModel& model);

/// Returns the period of the slowest vibration of the intact, undamped body about its prescribed
/// displacements [time], infinite without vibrations. Free rigid motions are excluded.
/// \throws SolverError where fundamental_period() of networks does
double fundamental_period(const ExplicitModel& model);

}  // namespace perilink
