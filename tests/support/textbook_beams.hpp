#pragma once

#include <Eigen/Dense>

#include "network/network.hpp"

/// \file
/// Elements as textbooks write them, in local axes and turned: shares no code with the program.

namespace perilink::test {

/// Plane beam of length L along x, unknowns (u, v, theta) at either end
/// (Gerstle, Sau & Aguilera 2007, Eq. 5).
inline Eigen::MatrixXd plane_beam(double L, double EA, double EI) {
  const double a = EA / L, b = 12.0 * EI / (L * L * L), c = 6.0 * EI / (L * L), d = 4.0 * EI / L,
               e = 2.0 * EI / L;
  Eigen::MatrixXd k(6, 6);
  k << a, 0, 0, -a, 0, 0,   //
      0, b, c, 0, -b, c,    //
      0, c, d, 0, -c, e,    //
      -a, 0, 0, a, 0, 0,    //
      0, -b, -c, 0, b, -c,  //
      0, c, e, 0, -c, d;
  return k;
}

/// Beam in space along x, unknowns (u, v, w, theta_x, theta_y, theta_z) at either end: two plane
/// beams, whose second turns the other way, and a rod that twists.
inline Eigen::MatrixXd space_beam(double L, double EA, double EI, double GJ) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(12, 12);
  const Eigen::MatrixXd beam = plane_beam(L, EA, EI);
  const int in_plane[6] = {0, 1, 5, 6, 7, 11};  // u, v, theta_z
  const int across[6] = {0, 2, 4, 6, 8, 10};    // u, w, -theta_y
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) {
      k(in_plane[row], in_plane[col]) += beam(row, col);
      if (row % 3 == 0 || col % 3 == 0) continue;
      const double sign = (row % 3 == 2) != (col % 3 == 2) ? -1.0 : 1.0;
      k(across[row], across[col]) += sign * beam(row, col);
    }
  }
  k(3, 3) += GJ / L;
  k(9, 9) += GJ / L;
  k(3, 9) -= GJ / L;
  k(9, 3) -= GJ / L;
  return k;
}

/// Stiffness of an intact element between all components of its ends: truss or beam.
inline Eigen::MatrixXd element_stiffness(const Network& network, Index e) {
  const int dim = network.dim(), width = network.width();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  for (int a = 0; a < dim; ++a) n[a] = network.bonds.direction(e)[a];
  const double L = network.bonds.lengths[e], EA = network.stiffness[e] * L;
  const double EI = network.carries_moments() ? network.bending[e] * L * L * L / 12.0 : 0.0;
  if (width == dim) {
    Eigen::MatrixXd k(2 * dim, 2 * dim);
    const Eigen::MatrixXd block = EA / L * n.head(dim) * n.head(dim).transpose();
    k << block, -block, -block, block;
    return k;
  }
  const Eigen::Vector3d up =
      dim == 2 ? Eigen::Vector3d::UnitZ()
               : n.cross(std::abs(n[0]) < 0.7 ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                              : Eigen::Vector3d(Eigen::Vector3d::UnitY()))
                     .normalized();
  Eigen::Matrix3d axes;  // rows: along the element, across it in the plane, across the plane
  axes << n.transpose(), up.cross(n).transpose(), up.transpose();
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(2 * width, 2 * width);
  for (int end = 0; end < 2; ++end) {
    if (dim == 2) {
      turn.block<3, 3>(3 * end, 3 * end) = axes;
    } else {
      turn.block<3, 3>(6 * end, 6 * end) = axes;
      turn.block<3, 3>(6 * end + 3, 6 * end + 3) = axes;
    }
  }
  const Eigen::MatrixXd beam =
      dim == 2 ? plane_beam(L, EA, EI) : space_beam(L, EA, EI, network.torsion * EI);
  return turn.transpose() * beam * turn;
}

/// Energy of an intact element in a motion of all particles, shape (particles, width).
inline double element_energy(const Network& network, std::span<const double> motion, Index e) {
  const int width = network.width();
  Eigen::VectorXd ends(2 * width);
  for (int a = 0; a < width; ++a) {
    ends[a] = motion[network.bonds.first[e] * width + a];
    ends[width + a] = motion[network.bonds.second[e] * width + a];
  }
  return 0.5 * ends.dot(element_stiffness(network, e) * ends);
}

}  // namespace perilink::test
