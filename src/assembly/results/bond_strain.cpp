#include "assembly/results/bond_strain.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <numbers>

#include "network/frame.hpp"

namespace perilink {
namespace {

/// The bonds do not resist every strain where a pivot is below this fraction of the largest. At a
/// corner, with a quarter of a neighbourhood, pivots are above 1e-3.
constexpr double smallest_strain_pivot = 1e-7;

/// Number of components of a symmetric tensor.
template <int Dim>
constexpr int components = Dim*(Dim + 1) / 2;

/// Axes of the off-diagonal components, in the order of SymmetricTensor.
constexpr std::array<std::array<int, 2>, 3> mixed_pairs = {{{0, 1}, {1, 2}, {0, 2}}};

/// Returns (a b + b a) / 2 as a vector; dot products of such vectors equal tensor products.
template <int Dim>
Eigen::Vector<double, components<Dim>> product_of(const Eigen::Vector<double, Dim>& a,
                                                  const Eigen::Vector<double, Dim>& b) {
  Eigen::Vector<double, components<Dim>> product;
  for (int k = 0; k < Dim; ++k) product[k] = a[k] * b[k];
  for (int k = Dim; k < components<Dim>; ++k) {
    const auto [p, q] = mixed_pairs[k - Dim];
    product[k] = (a[p] * b[q] + a[q] * b[p]) / std::numbers::sqrt2;
  }
  return product;
}

template <int Dim>
struct Virial {
  using Tensor = Eigen::Vector<double, components<Dim>>;
  using Vector = Eigen::Vector<double, Dim>;

  Tensor present = Tensor::Zero();  ///< virial of the present forces [force length]
  /// Virial of intact bonds as a linear map of the strain.
  Eigen::Matrix<double, components<Dim>, components<Dim>> intact =
      Eigen::Matrix<double, components<Dim>, components<Dim>>::Zero();

  void add_axial(const Vector& n, double length, double stiffness, double force) {
    const Tensor along = product_of<Dim>(n, n);
    intact += stiffness * length * length * along * along.transpose();
    present += force * length * along;
  }
  void add_shear(const Vector& n, double length, double stiffness, const Vector& force) {
    for (int a = 0; a < Dim; ++a) {
      // Axes without their part along the bond: the sum over them equals that over two directions
      // across.
      Vector across = -n[a] * n;
      across[a] += 1.0;
      const Tensor part = product_of<Dim>(n, across);
      intact += stiffness * length * length * part * part.transpose();
    }
    present += length * product_of<Dim>(n, force);
  }
};

template <int Dim>
void add_bond(const Network& network, Secants secants, std::span<const double> motion, Index e,
              Virial<Dim>& virial) {
  using Vector = Eigen::Vector<double, Dim>;
  const auto width = static_cast<std::size_t>(network.width());
  const Vector n = Eigen::Map<const Vector>(network.bonds.direction(e).data());
  const double length = network.bonds.length(e), stiffness = network.stiffness[e];
  const double* first = motion.data() + network.bonds.first[e] * width;
  const double* second = motion.data() + network.bonds.second[e] * width;
  const auto force = [&](double extension) { return stiffness * secants.axial(e) * extension; };
  if (!network.carries_moments()) {
    double extension = 0.0;
    for (int a = 0; a < Dim; ++a) extension += n[a] * (second[a] - first[a]);
    virial.add_axial(n, length, stiffness, force(extension));
    return;
  }
  const double inflection = network.inflection_of(e), bending = network.bending[e];
  const FrameDeformation<Dim> deformed(n.data(), inflection * length, (1.0 - inflection) * length,
                                       first, second);
  virial.add_axial(n, length, stiffness, force(deformed.extension));
  Vector shear;
  if constexpr (Dim == 2) {
    shear = deformed.shear[0] * Vector(-n[1], n[0]);
  } else {
    shear = Vector(deformed.shear[0], deformed.shear[1], deformed.shear[2]);
  }
  virial.add_shear(n, length, bending, bending * secants[e] * shear);
}

template <int Dim>
SymmetricTensor strain_in(const Network& network, const Csr& neighbourhoods, Secants secants,
                          std::span<const double> motion, Index particle) {
  Virial<Dim> virial;
  for (const Index e : neighbourhoods.row(particle)) {
    if (e < network.first_contact()) add_bond<Dim>(network, secants, motion, e, virial);
  }
  const Eigen::LDLT<decltype(virial.intact)> factor(virial.intact);
  const auto pivots = factor.vectorD();
  if (!(pivots.minCoeff() > smallest_strain_pivot * pivots.maxCoeff())) return {};
  const typename Virial<Dim>::Tensor strain = factor.solve(virial.present);
  SymmetricTensor result{};
  for (int k = 0; k < Dim; ++k) result[k] = strain[k];
  for (int k = Dim; k < components<Dim>; ++k) result[3 + k - Dim] = strain[k] / std::numbers::sqrt2;
  return result;
}

}  // namespace

SymmetricTensor bond_strain(const Network& network, const Csr& neighbourhoods, Secants secants,
                            std::span<const double> motion, Index particle) {
  return network.dim() == 2 ? strain_in<2>(network, neighbourhoods, secants, motion, particle)
                            : strain_in<3>(network, neighbourhoods, secants, motion, particle);
}

}  // namespace perilink
