#pragma once

#include <Eigen/Core>

#include "network/network.hpp"

/// \file
/// Elements from textbooks in local and global axes, independent of the program's code.

namespace perilink::test {

/// Stiffness between the unknowns of both ends, 2 to 6 per end.
template <class Real>
using MatrixOf = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;
using ElementMatrix = MatrixOf<double>;

/// Returns the stiffness of a plane beam of length L along x, unknowns (u, v, theta) per end
/// (Gerstle, Sau & Aguilera 2007, Eq. 5).
template <class Real>
MatrixOf<Real> plane_beam(Real L, Real EA, Real EI);

/// Returns the stiffness of a beam in space along x, unknowns (u, v, w, theta_x, theta_y, theta_z)
/// per end. It consists of two plane beams, the second with opposite rotation, and a rod in
/// torsion.
template <class Real>
MatrixOf<Real> space_beam(Real L, Real EA, Real EI, Real GJ);

/// Returns the stiffness of an intact truss or beam between all components of its ends. The entries
/// of a matrix are rounded, which rigid motions feel; extended precision avoids that.
template <class Real = double>
MatrixOf<Real> element_stiffness(const Network& network, Index e);

/// Returns the energy of an intact element in a motion of all particles, shape (particles, width).
double element_energy(const Network& network, std::span<const double> motion, Index e);

}  // namespace perilink::test
