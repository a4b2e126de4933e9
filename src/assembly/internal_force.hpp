#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"

namespace perilink {

/// Forces of all elements and elastic supports on all particles, and their energy.
template <class Real>
struct ForcesAndEnergy {
  std::vector<Real> forces;   ///< K u: force needed to hold each particle, shape
                              ///< (particles, width), moments behind the forces
  Real energy = 0.0;          ///< sum of k e^2 / 2 (and of c s^2 / 2 of states) [force length]
  Real support_energy = 0.0;  ///< part of it that is in elastic supports
};
using InternalForce = ForcesAndEnergy<double>;

/// \param displacement  all particles, rotations included; shape (particles, width)
InternalForce internal_force(const Network& network, Secants secants,
                             std::span<const double> displacement);

/// The same with memory that is used again from call to call.
void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    InternalForce& result);

/// The same of some of the elements and of all finite elements beside bonds, without supports and
/// states.
void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    std::span<const Index> elements, InternalForce& result);

/// In extended precision, for bodies that move so far that double precision takes away the
/// digits of their strains. Three times the time.
void internal_force(const Network& network, Secants secants,
                    std::span<const long double> displacement,
                    ForcesAndEnergy<long double>& result);

/// Per particle of a truss: the sum of the extensions of its bonds, each times its secant [length];
/// for a particle of a state-based lattice this is L_0 theta.
std::vector<double> extension_sums(const Network& network, Secants secants,
                                   std::span<const double> displacement);

}  // namespace perilink
