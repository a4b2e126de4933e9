#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"

namespace perilink {

/// Forces of all elements and elastic supports on all particles, and their energy.
template <class Real>
struct ForcesAndEnergy {
  std::vector<Real> forces;   ///< K u, the force that holds each particle [force], shape
                              ///< (particles, width); moments follow the forces
  Real energy = 0.0;          ///< sum of k e^2 / 2 (and of c s^2 / 2 of states) [force length]
  Real support_energy = 0.0;  ///< part of `energy` in elastic supports [force length]
};
using InternalForce = ForcesAndEnergy<double>;

/// Returns the forces and the energy of all elements and elastic supports.
/// \param displacement  all particles with their rotations, shape (particles, width)
InternalForce internal_force(const Network& network, Secants secants,
                             std::span<const double> displacement);

/// Computes forces and energy in `result`, whose memory is reused between calls.
void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    InternalForce& result);

/// Computes forces and energy of some of the elements and of all finite elements, without supports
/// and states.
void internal_force(const Network& network, Secants secants, std::span<const double> displacement,
                    std::span<const Index> elements, InternalForce& result);

/// Computes forces and energy in extended precision. Bodies with large rigid motions need it: in
/// double precision the strains lose their digits. It takes three times as long.
void internal_force(const Network& network, Secants secants,
                    std::span<const long double> displacement,
                    ForcesAndEnergy<long double>& result);

/// Returns, per particle of a truss, the sum of secant times extension over its bonds [length]. For
/// a particle of a state-based lattice it is L_0 theta.
std::vector<double> extension_sums(const Network& network, Secants secants,
                                   std::span<const double> displacement);

}  // namespace perilink
