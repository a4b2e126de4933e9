#include "support/textbook_beams.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace perilink::test {

template <class Real>
MatrixOf<Real> plane_beam(Real L, Real EA, Real EI) {
  const Real a = EA / L, b = 12 * EI / (L * L * L), c = 6 * EI / (L * L), d = 4 * EI / L,
             e = 2 * EI / L;
  MatrixOf<Real> k(6, 6);
  k << a, 0, 0, -a, 0, 0,   //
      0, b, c, 0, -b, c,    //
      0, c, d, 0, -c, e,    //
      -a, 0, 0, a, 0, 0,    //
      0, -b, -c, 0, b, -c,  //
      0, c, e, 0, -c, d;
  return k;
}

template <class Real>
MatrixOf<Real> space_beam(Real L, Real EA, Real EI, Real GJ) {
  MatrixOf<Real> k = MatrixOf<Real>::Zero(12, 12);
  const MatrixOf<Real> beam = plane_beam(L, EA, EI);
  const int in_plane[6] = {0, 1, 5, 6, 7, 11};  // u, v, theta_z
  const int across[6] = {0, 2, 4, 6, 8, 10};    // u, w, -theta_y
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) {
      k(in_plane[row], in_plane[col]) += beam(row, col);
      if (row % 3 == 0 || col % 3 == 0) continue;
      const int sign = (row % 3 == 2) != (col % 3 == 2) ? -1 : 1;
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

template <class Real>
using VectorOf = Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, 12, 1>;
template <class Real>
using Vector3Of = Eigen::Matrix<Real, 3, 1>;

/// Element in local axes: the axial unknowns of a truss, all unknowns of a beam.
template <class Real>
struct LocalElement {
  MatrixOf<Real> stiffness, turn;
};

template <class Real>
LocalElement<Real> local_truss(const Vector3Of<Real>& n, int dim, Real stiffness) {
  LocalElement<Real> truss{MatrixOf<Real>(2, 2), MatrixOf<Real>::Zero(2, 2 * dim)};
  truss.stiffness << stiffness, -stiffness, -stiffness, stiffness;
  for (int end = 0; end < 2; ++end) {
    truss.turn.row(end).segment(end * dim, dim) = n.head(dim).transpose();
  }
  return truss;
}

template <class Real>
LocalElement<Real> local_element(const Network& network, Index e) {
  using Vector = Vector3Of<Real>;
  const int dim = network.dim(), width = network.width();
  Vector n = Vector::Zero();
  for (int a = 0; a < dim; ++a) n[a] = network.bonds.direction(e)[a];
  const Real L = network.bonds.length(e), EA = network.stiffness[e] * L;
  const Real EI = network.carries_moments() ? network.bending[e] * L * L * L / 12 : Real(0);
  if (width == dim) return local_truss<Real>(n, dim, EA / L);
  const Vector up = dim == 2 ? Vector(Vector::UnitZ())
                             : n.cross(std::abs(n[0]) < Real(0.7) ? Vector(Vector::UnitX())
                                                                  : Vector(Vector::UnitY()))
                                   .normalized();
  Eigen::Matrix<Real, 3, 3> axes;  // rows: along the element, across it in the plane, across it
  axes << n.transpose(), up.cross(n).transpose(), up.transpose();
  LocalElement<Real> beam{
      dim == 2 ? plane_beam(L, EA, EI) : space_beam(L, EA, EI, network.torsion * EI),
      MatrixOf<Real>::Zero(2 * width, 2 * width)};
  for (int corner = 0; corner < 2 * width; corner += 3) {
    beam.turn.template block<3, 3>(corner, corner) = axes;
  }
  return beam;
}

}  // namespace

template <class Real>
MatrixOf<Real> element_stiffness(const Network& network, Index e) {
  const LocalElement<Real> element = local_element<Real>(network, e);
  return element.turn.transpose() * element.stiffness * element.turn;
}

template ElementMatrix element_stiffness(const Network& network, Index e);
template MatrixOf<long double> element_stiffness(const Network& network, Index e);

double element_energy(const Network& network, std::span<const double> motion, Index e) {
  const int width = network.width();
  VectorOf<double> ends(2 * width);
  for (int a = 0; a < width; ++a) {
    ends[a] = motion[network.bonds.first[e] * width + a];
    ends[width + a] = motion[network.bonds.second[e] * width + a];
  }
  const LocalElement<double> element = local_element<double>(network, e);
  const VectorOf<double> local = element.turn * ends;
  return 0.5 * local.dot(element.stiffness * local);
}

}  // namespace perilink::test
