#include "support/textbook_beams.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace perilink::test {

ElementMatrix plane_beam(double L, double EA, double EI) {
  const double a = EA / L, b = 12.0 * EI / (L * L * L), c = 6.0 * EI / (L * L), d = 4.0 * EI / L,
               e = 2.0 * EI / L;
  ElementMatrix k(6, 6);
  k << a, 0, 0, -a, 0, 0,   //
      0, b, c, 0, -b, c,    //
      0, c, d, 0, -c, e,    //
      -a, 0, 0, a, 0, 0,    //
      0, -b, -c, 0, b, -c,  //
      0, c, e, 0, -c, d;
  return k;
}

ElementMatrix space_beam(double L, double EA, double EI, double GJ) {
  ElementMatrix k = ElementMatrix::Zero(12, 12);
  const ElementMatrix beam = plane_beam(L, EA, EI);
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

namespace {

using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;

/// Element in local axes: the axial unknowns of a truss, all unknowns of a beam.
struct LocalElement {
  ElementMatrix stiffness, turn;
};

LocalElement local_truss(const Eigen::Vector3d& n, int dim, double stiffness) {
  LocalElement truss{ElementMatrix(2, 2), ElementMatrix::Zero(2, 2 * dim)};
  truss.stiffness << stiffness, -stiffness, -stiffness, stiffness;
  for (int end = 0; end < 2; ++end) {
    truss.turn.row(end).segment(end * dim, dim) = n.head(dim).transpose();
  }
  return truss;
}

LocalElement local_element(const Network& network, Index e) {
  const int dim = network.dim(), width = network.width();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  for (int a = 0; a < dim; ++a) n[a] = network.bonds.direction(e)[a];
  const double L = network.bonds.lengths[e], EA = network.stiffness[e] * L;
  const double EI = network.carries_moments() ? network.bending[e] * L * L * L / 12.0 : 0.0;
  if (width == dim) return local_truss(n, dim, EA / L);
  const Eigen::Vector3d up =
      dim == 2 ? Eigen::Vector3d::UnitZ()
               : n.cross(std::abs(n[0]) < 0.7 ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                              : Eigen::Vector3d(Eigen::Vector3d::UnitY()))
                     .normalized();
  Eigen::Matrix3d axes;  // rows: along the element, across it in the plane, across the plane
  axes << n.transpose(), up.cross(n).transpose(), up.transpose();
  LocalElement beam{dim == 2 ? plane_beam(L, EA, EI) : space_beam(L, EA, EI, network.torsion * EI),
                    ElementMatrix::Zero(2 * width, 2 * width)};
  for (int corner = 0; corner < 2 * width; corner += 3) {
    beam.turn.block<3, 3>(corner, corner) = axes;
  }
  return beam;
}

}  // namespace

ElementMatrix element_stiffness(const Network& network, Index e) {
  const LocalElement element = local_element(network, e);
  return element.turn.transpose() * element.stiffness * element.turn;
}

double element_energy(const Network& network, std::span<const double> motion, Index e) {
  const int width = network.width();
  ElementVector ends(2 * width);
  for (int a = 0; a < width; ++a) {
    ends[a] = motion[network.bonds.first[e] * width + a];
    ends[width + a] = motion[network.bonds.second[e] * width + a];
  }
  const LocalElement element = local_element(network, e);
  const ElementVector local = element.turn * ends;
  return 0.5 * local.dot(element.stiffness * local);
}

}  // namespace perilink::test
