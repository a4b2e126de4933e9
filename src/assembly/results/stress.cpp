#include "assembly/results/stress.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "assembly/results/bond_strain.hpp"

namespace perilink {
namespace {

/// Pivots of the normal equations, scaled to bonds of length one, below this fraction of the
/// largest mean that the neighbours do not settle the polynomial: those of regular families are
/// above 1e-3.
constexpr double smallest_stress_pivot = 1e-7;

/// Solid particles of the same material that are bonded to a particle, and theirs; ascending.
std::vector<Index> neighbors_of(const StressInput& input, Index particle) {
  const Network& network = input.network;
  const Particles& particles = network.particles;
  std::vector<Index> found;
  const auto append = [&](Index i) {
    for (const Index e : input.families.row(i)) {
      if (e >= network.first_tie) continue;
      const Index j = network.bonds.other_end(e, i);
      if (j == particle || particles.kind[j] != ParticleKind::solid) continue;
      if (particles.material[j] == particles.material[particle]) found.push_back(j);
    }
  };
  append(particle);
  if (input.second_neighbors) {
    const std::vector<Index> first = found;
    for (const Index j : first) append(j);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Columns 0 to Dim - 1 are linear, the others of second degree.
template <int Dim, int Terms>
Eigen::Vector<double, Terms> terms_at(const Eigen::Vector<double, Dim>& x) {
  Eigen::Vector<double, Terms> terms;
  terms.template head<Dim>() = x;
  if constexpr (Terms > Dim) {
    int k = Dim;
    for (int a = 0; a < Dim; ++a) {
      for (int b = a; b < Dim; ++b) terms[k++] = x[a] * x[b];
    }
  }
  return terms;
}

/// Fits the displacements around a particle.
/// \param size  length that scales the positions
/// \return whether the neighbours settle the polynomial
template <int Dim, int Terms>
bool fit_gradient(const Network& network, std::span<const double> motion, Index particle,
                  std::span<const Index> neighbors, double size,
                  Eigen::Matrix<double, Dim, Dim>& gradient) {
  using Vector = Eigen::Map<const Eigen::Vector<double, Dim>>;
  const auto at = [](std::span<const double> values, Index i, int width) {
    return Vector(values.data() + static_cast<std::size_t>(i) * width);
  };
  const std::vector<double>& positions = network.particles.positions;
  const int width = network.width();
  if (neighbors.size() < Terms) return false;
  Eigen::Matrix<double, Terms, Terms> normal = Eigen::Matrix<double, Terms, Terms>::Zero();
  Eigen::Matrix<double, Terms, Dim> right = Eigen::Matrix<double, Terms, Dim>::Zero();
  for (const Index j : neighbors) {
    const Eigen::Vector<double, Dim> x =
        (at(positions, j, Dim) - at(positions, particle, Dim)) / size;
    const Eigen::Vector<double, Terms> terms = terms_at<Dim, Terms>(x);
    const double weight = 1.0 / x.squaredNorm();
    normal += weight * terms * terms.transpose();
    right += weight * terms * (at(motion, j, width) - at(motion, particle, width)).transpose();
  }
  const Eigen::LDLT<Eigen::Matrix<double, Terms, Terms>> factor(normal);
  const auto pivots = factor.vectorD();
  if (!(pivots.minCoeff() > smallest_stress_pivot * pivots.maxCoeff())) return false;
  gradient = factor.solve(right).template topRows<Dim>().transpose() / size;
  return true;
}

/// That of the polynomial that fits the displacements around a particle; zero where there is none.
template <int Dim>
Eigen::Matrix3d fitted_strain(const StressInput& input, std::span<const double> motion,
                              Index particle) {
  const Particles& particles = input.network.particles;
  const std::vector<Index> neighbors = neighbors_of(input, particle);
  double size = 0.0;
  for (const Index j : neighbors) {
    double square = 0.0;
    for (int a = 0; a < Dim; ++a) {
      square += std::pow(particles.position(j)[a] - particles.position(particle)[a], 2);
    }
    size = std::max(size, std::sqrt(square));
  }
  constexpr int quadratic = Dim + Dim * (Dim + 1) / 2;
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, Dim, Dim> gradient;
  if (fit_gradient<Dim, quadratic>(input.network, motion, particle, neighbors, size, gradient) ||
      fit_gradient<Dim, Dim>(input.network, motion, particle, neighbors, size, gradient)) {
    strain.topLeftCorner<Dim, Dim>() = 0.5 * (gradient + gradient.transpose());
  }
  return strain;
}

bool is_damaged(const StressInput& input, Index particle) {
  if (input.secants.size() == 0) return false;
  const auto bonds = input.families.row(particle);
  return std::any_of(bonds.begin(), bonds.end(), [&](Index e) {
    return e < input.network.first_tie && input.secants.least(e) < 1.0;
  });
}

template <int Dim>
Stress stress_in(const StressInput& input, std::span<const double> motion, Index particle) {
  const bool damaged = is_damaged(input, particle);
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  if (damaged) {
    const SymmetricTensor e =
        bond_strain(input.network, input.families, input.secants, motion, particle);
    strain << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
  } else {
    strain = fitted_strain<Dim>(input, motion, particle);
  }
  const HookeConstants& c = input.materials[input.network.particles.material[particle]];
  const Eigen::Matrix3d s =
      c.lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * c.mu * strain;
  const double out_of_plane = input.problem == Problem::plane_stress ? 0.0 : s(2, 2);
  return {s(0, 0), s(1, 1), out_of_plane, s(0, 1), s(1, 2), s(0, 2)};
}

}  // namespace

Stress stress_at(const StressInput& input, std::span<const double> motion, Index particle) {
  return input.network.dim() == 2 ? stress_in<2>(input, motion, particle)
                                  : stress_in<3>(input, motion, particle);
}

std::vector<double> particle_stresses(const StressInput& input, std::span<const double> motion) {
  const Particles& particles = input.network.particles;
  const std::size_t width = Stress{}.size();
  std::vector<double> stresses(width * static_cast<std::size_t>(particles.size()), 0.0);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid) continue;
    const Stress stress = stress_at(input, motion, i);
    std::copy(stress.begin(), stress.end(), stresses.begin() + static_cast<std::size_t>(i) * width);
  }
  return stresses;
}

}  // namespace perilink
