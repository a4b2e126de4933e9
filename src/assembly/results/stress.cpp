#include "assembly/results/stress.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "assembly/results/bond_strain.hpp"
#include "assembly/results/neighbor_gradients.hpp"
#include "assembly/results/surface_fit.hpp"
#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Smallest pivot of the normal equations over the largest, scaled to bonds of length one. Below it
/// the neighbours do not determine the polynomial; regular neighbourhoods have more than 1e-3.
constexpr double smallest_stress_pivot = 1e-7;

/// Finds the solid particles of the same material bonded to a particle, and optionally their
/// neighbours, ascending.
void find_neighbors(const StressInput& input, Index particle, std::vector<Index>& found) {
  const Network& network = input.network;
  const Particles& particles = network.particles;
  found.clear();
  const auto append = [&](Index i) {
    for (const Index e : input.neighbourhoods.row(i)) {
      if (e >= network.first_contact()) continue;
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
  if (std::ranges::is_sorted(found, std::less_equal())) return;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

/// Terms 0 to Dim - 1 are linear, the others quadratic.
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

/// Computes the weights of the least-squares polynomial.
/// \param size  length that scales the offsets [length]
template <int Dim, int Terms>
bool fit_polynomial(std::span<const double> offsets, double size, std::span<double> weights) {
  const std::size_t count = offsets.size() / Dim;
  if (count < Terms) return false;
  const auto at = [&](std::size_t k) -> Eigen::Vector<double, Dim> {
    return Eigen::Map<const Eigen::Vector<double, Dim>>(offsets.data() + k * Dim) / size;
  };
  Eigen::Matrix<double, Terms, Terms> normal = Eigen::Matrix<double, Terms, Terms>::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector<double, Dim> x = at(k);
    const Eigen::Vector<double, Terms> terms = terms_at<Dim, Terms>(x);
    normal += (1.0 / x.squaredNorm()) * terms * terms.transpose();
  }
  Eigen::MatrixXd solution = Eigen::MatrixXd::Identity(Terms, Dim);
  if (!solve_symmetric(normal, solution, smallest_stress_pivot)) return false;
  const Eigen::Matrix<double, Terms, Dim> linear = solution;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector<double, Dim> x = at(k);
    Eigen::Map<Eigen::Vector<double, Dim>>(weights.data() + k * Dim) =
        linear.transpose() * terms_at<Dim, Terms>(x) / (x.squaredNorm() * size);
  }
  return true;
}

/// Fits a quadratic polynomial where the neighbours determine it, else a linear one.
template <int Dim>
bool fit_gradient(std::span<const double> offsets, std::span<const double> /*marks*/,
                  std::span<double> weights) {
  double square = 0.0;
  for (std::size_t k = 0; k < offsets.size(); k += Dim) {
    square = std::max(
        square, Eigen::Map<const Eigen::Vector<double, Dim>>(offsets.data() + k).squaredNorm());
  }
  constexpr int quadratic = Dim + Dim * (Dim + 1) / 2;
  const double size = std::sqrt(square);
  return fit_polynomial<Dim, quadratic>(offsets, size, weights) ||
         fit_polynomial<Dim, Dim>(offsets, size, weights);
}

bool is_damaged(const StressInput& input, Index particle) {
  if (input.secants.size() == 0) return false;
  return std::ranges::any_of(input.neighbourhoods.row(particle), [&](Index e) {
    return e < input.network.first_contact() && input.secants.least(e) < 1.0;
  });
}

/// Leaves out neighbours behind a crack: those with more than half of their bonds to the particle
/// and its other neighbours cracked. An intact bond along a crack may join its two faces, whose
/// displacements fit no polynomial.
/// \param found  neighbours, ascending
void leave_out_neighbors_across(const StressInput& input, Index particle,
                                std::vector<Index>& found) {
  constexpr double cracked = 0.5;
  const std::vector<Index> all = found;
  std::erase_if(found, [&](Index j) {
    int bonds = 0, lost = 0;
    for (const Index e : input.neighbourhoods.row(j)) {
      if (e >= input.network.first_contact()) continue;
      const Index other = input.network.bonds.other_end(e, j);
      if (other != particle && !std::ranges::binary_search(all, other)) continue;
      ++bonds;
      lost += input.secants.least(e) < cracked ? 1 : 0;
    }
    return 2 * lost > bonds;
  });
}

/// Returns is_damaged() of all particles; empty where all bonds are intact.
std::vector<std::uint8_t> damaged_particles(const StressInput& input) {
  std::vector<std::uint8_t> damaged;
  if (input.secants.size() == 0) return damaged;
  const Network& network = input.network;
  for (Index e = 0; e < network.first_contact(); ++e) {
    if (!(input.secants.least(e) < 1.0)) continue;
    damaged.resize(static_cast<std::size_t>(network.particles.size()), 0);
    damaged[network.bonds.first[e]] = damaged[network.bonds.second[e]] = 1;
  }
  return damaged;
}

template <int Dim>
class StressFinder {
 public:
  /// \param damaged  damaged_particles(); null: looked for where it matters
  StressFinder(const StressInput& input, std::span<const double> motion,
               const std::vector<std::uint8_t>* damaged = nullptr)
      : input_(input),
        damaged_(damaged),
        motion_(motion),
        gradients_(input.network.particles, motion, input.network.width(), fit_gradient<Dim>),
        surface_gradients_(input.network.particles, motion, input.network.width(),
                           fit_surface_gradient<Dim>, true) {}

  Stress at(Index particle);

 private:
  bool has_damage(Index particle) const {
    if (damaged_ == nullptr) return is_damaged(input_, particle);
    return !damaged_->empty() && (*damaged_)[particle] != 0;
  }
  Eigen::Matrix3d strain_at(Index particle);

  const StressInput& input_;
  const std::vector<std::uint8_t>* damaged_;
  std::span<const double> motion_;
  NeighborGradients<Dim> gradients_, surface_gradients_;
  std::vector<Index> neighbors_;
  std::vector<double> marks_;
};

template <int Dim>
Eigen::Matrix3d StressFinder<Dim>::strain_at(Index particle) {
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
  if (has_damage(particle)) {
    const SymmetricTensor e =
        bond_strain(input_.network, input_.neighbourhoods, input_.secants, motion_, particle);
    strain << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    return strain;
  }
  find_neighbors(input_, particle, neighbors_);
  if (std::ranges::any_of(neighbors_, [&](Index j) { return has_damage(j); })) {
    leave_out_neighbors_across(input_, particle, neighbors_);
  }
  Eigen::Matrix<double, Dim, Dim> gradient;
  if ((collect_surface_marks(input_, particle, neighbors_, marks_) &&
       surface_gradients_.find(particle, neighbors_, gradient, marks_)) ||
      gradients_.find(particle, neighbors_, gradient)) {
    strain.topLeftCorner<Dim, Dim>() = 0.5 * (gradient + gradient.transpose());
  }
  return strain;
}

template <int Dim>
Stress StressFinder<Dim>::at(Index particle) {
  Eigen::Matrix3d strain = strain_at(particle);
  if (!input_.modulus.empty()) strain *= input_.modulus[particle];
  const HookeConstants& c = input_.materials[input_.network.particles.material[particle]];
  const Eigen::Matrix3d s =
      c.lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * c.mu * strain;
  const double out_of_plane = input_.problem == Problem::plane_stress ? 0.0 : s(2, 2);
  return {s(0, 0), s(1, 1), out_of_plane, s(0, 1), s(1, 2), s(0, 2)};
}

template <int Dim>
std::vector<double> stresses_in(const StressInput& input, std::span<const double> motion) {
  const Particles& particles = input.network.particles;
  const std::size_t width = Stress{}.size();
  std::vector<double> stresses(width * static_cast<std::size_t>(particles.size()), 0.0);
  constexpr Index block = NeighborGradients<Dim>::block;
  const std::vector<std::uint8_t> damaged = damaged_particles(input);
#pragma omp parallel for schedule(dynamic)
  for (Index begin = 0; begin < particles.size(); begin += block) {
    StressFinder<Dim> finder(input, motion, &damaged);
    for (Index i = begin; i < std::min(begin + block, particles.size()); ++i) {
      if (particles.kind[i] != ParticleKind::solid) continue;
      const Stress stress = finder.at(i);
      std::ranges::copy(stress, stresses.begin() + static_cast<std::ptrdiff_t>(i * width));
    }
  }
  return stresses;
}

}  // namespace

Stress stress_at(const StressInput& input, std::span<const double> motion, Index particle) {
  return input.network.dim() == 2 ? StressFinder<2>(input, motion).at(particle)
                                  : StressFinder<3>(input, motion).at(particle);
}

std::vector<double> particle_stresses(const StressInput& input, std::span<const double> motion) {
  return input.network.dim() == 2 ? stresses_in<2>(input, motion) : stresses_in<3>(input, motion);
}

}  // namespace perilink
