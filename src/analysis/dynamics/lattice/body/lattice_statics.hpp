#pragma once

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "network/states/lattice_network.hpp"

namespace perilink {

/// The intact body of an explicit run for small displacements. Bonds take the mean of their
/// particles' force states: where the rules are least_2018 that is not the force of the run.
LatticeNetwork lattice_network(const ExplicitModel& model);

/// Period of the slowest vibration of the intact, undamped body about its prescribed displacements
/// [time], rigid motions that these leave free set apart; infinite where nothing vibrates.
/// \throws SolverError  as fundamental_period of networks
double fundamental_period(const ExplicitModel& model);

}  // namespace perilink
