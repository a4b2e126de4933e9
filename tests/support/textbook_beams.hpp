#pragma once

#include <Eigen/Core>

#include "network/network.hpp"

/// \file
/// Elements as textbooks write them, in local axes and turned: shares no code with the program.

namespace perilink::test {

/// Stiffness between the unknowns of both ends: 2 to 6 at either.
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// Plane beam of length L along x, unknowns (u, v, theta) at either end
/// (Gerstle, Sau & Aguilera 2007, Eq. 5).
ElementMatrix plane_beam(double L, double EA, double EI);

/// Beam in space along x, unknowns (u, v, w, theta_x, theta_y, theta_z) at either end: two plane
/// beams, whose second turns the other way, and a rod that twists.
ElementMatrix space_beam(double L, double EA, double EI, double GJ);

/// Stiffness of an intact element between all components of its ends: truss or beam.
ElementMatrix element_stiffness(const Network& network, Index e);

/// Energy of an intact element in a motion of all particles, shape (particles, width).
double element_energy(const Network& network, std::span<const double> motion, Index e);

}  // namespace perilink::test
