#include "analysis/dynamics/inertia.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/dense/decompositions.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

template <int Width>
using Blocks = std::vector<Eigen::Matrix<double, Width, Width>,
                           Eigen::aligned_allocator<Eigen::Matrix<double, Width, Width>>>;

/// Returns stiffnesses of bonds that store at least as much energy as bonds and states together. A
/// sum of n extensions squares to at most n times the sum of their squares.
std::vector<double> bounding_stiffness(const Network& network) {
  if (!network.has_states()) return network.stiffness;
  std::vector<double> count(network.states->stiffness.size(), 0.0);
  const auto each_state = [&](const auto& visit) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (network.counts_for(e, first_end)) visit(e, network.bonds.first[e]);
      if (network.counts_for(e, second_end)) visit(e, network.bonds.second[e]);
    }
  };
  each_state([&](Index, Index i) { count[i] += 1.0; });
  std::vector<double> stiffness = network.stiffness;
  each_state([&](Index e, Index i) {
    stiffness[e] += std::max(0.0, network.states->stiffness[i]) * count[i];
  });
  return stiffness;
}

/// Returns the sum of k b b' of all modes that end at each particle. With Green strains the terms
/// are bounds of the tangents k ((1 + 2 g) n n' + g I) before the bond breaks.
template <int Dim>
Blocks<Dim> own_trusses(const Network& network, Strain strain) {
  Blocks<Dim> blocks(static_cast<std::size_t>(network.particles.size()),
                     Eigen::Matrix<double, Dim, Dim>::Zero());
  const std::vector<double> stiffness = bounding_stiffness(network);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.is_contact(e)) continue;
    const Eigen::Map<const Eigen::Matrix<double, Dim, 1>> n(network.bonds.direction(e).data());
    Eigen::Matrix<double, Dim, Dim> part = stiffness[e] * n * n.transpose();
    if (strain == Strain::green && network.can_break(e)) {
      double along = 0.0, across = 0.0;  // largest of all segments
      for (int k = 0; network.law(e).segment(k).secant > 0.0; ++k) {
        const Segment segment = network.law(e).segment(k);
        const double g = network.critical_stretch[e] * segment.limit;
        along = std::max(along, segment.secant * (1.0 + 2.0 * g));
        across = std::max(across, segment.secant * g);
      }
      part *= along;
      part.diagonal().array() += across * network.stiffness[e];
    }
    for_each_end(network, e,
                 [&](Index i, bool, double weight) { blocks[i] += weight * weight * part; });
  }
  return blocks;
}

template <int Dim>
Blocks<FrameModes<Dim>::width> own_frames(const Network& network) {
  constexpr int width = FrameModes<Dim>::width;
  using Vector = Eigen::Map<const Eigen::Matrix<double, width, 1>>;
  Blocks<width> blocks(static_cast<std::size_t>(network.particles.size()),
                       Eigen::Matrix<double, width, width>::Zero());
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.is_contact(e)) continue;
    const FrameModes<Dim> modes = frame_modes<Dim>(network, e);
    for (int m = 0; m < FrameModes<Dim>::count; ++m) {
      const Vector first(modes.first[m].data()), second(modes.second[m].data());
      for_each_end(network, e, [&](Index i, bool at_second, double weight) {
        const Vector& b = at_second ? second : first;
        blocks[i] += weight * weight * modes.stiffness[m] * b * b.transpose();
      });
    }
  }
  return blocks;
}

double largest_eigenvalue(const Eigen::MatrixXd& block) {
  return std::max(0.0, eigenvalues(block).tail(1)[0]);
}

std::vector<double> masses_of_volumes(const Network& network, std::span<const double> density) {
  std::vector<double> mass;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const Index number = network.particles.material[i];
    const double volume = network.particles.volumes[i];
    if (number == no_index || volume <= 0.0) {
      mass.push_back(0.0);
      continue;
    }
    const auto material = static_cast<std::size_t>(number);
    if (material >= density.size() || !(density[material] > 0.0)) {
      throw std::invalid_argument("every material needs a positive density");
    }
    mass.push_back(density[material] * volume);
  }
  return mass;
}

/// Sets masses with which all own stiffnesses vibrate at one frequency.
void scale_masses(const std::vector<double>& stiffness, std::vector<double>& mass) {
  double total = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    total += mass[i];
    sum += stiffness[i];
  }
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = total * stiffness[i] / sum;
}

/// Sets masses of particles without volume or material: ghosts and bars.
void complete_masses(const std::vector<double>& stiffness, std::vector<double>& mass) {
  double fastest = 0.0, heaviest = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    heaviest = std::max(heaviest, mass[i]);
    if (mass[i] > 0.0) fastest = std::max(fastest, stiffness[i] / mass[i]);
  }
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (mass[i] > 0.0) continue;
    mass[i] = stiffness[i] > 0.0 && fastest > 0.0 ? stiffness[i] / fastest : heaviest;
  }
}

/// Adds the contact springs to bounds on the squared frequency, per particle. A spring with the
/// extension sum b_i u_i has energy k / 2 of its square, at most k / 2 sum |b_j| times
/// sum |b_i| u_i^2.
void add_contacts(const Network& network, std::span<const double> mass, std::vector<double>& at) {
  const EmbeddedPoints& points = network.embedded_points;
  const int dim = network.dim();
  for (const Index e : network.contacts()) {
    const Index point = network.bonds.second[e] - network.first_embedded_point();
    const auto particles = points.particles.row(point);
    const auto strain = points.strain_weights_of(point, dim);
    const auto n = network.bonds.direction(e);
    std::vector<double> sizes;
    double sum = 1.0;  // the first end
    for (std::size_t k = 0; k < particles.size(); ++k) {
      double square = 0.0;
      for (int a = 0; a < dim; ++a) {
        square += std::pow(points.weights_of(point)[k] * n[a] + strain[k * dim + a], 2);
      }
      sizes.push_back(std::sqrt(square));
      sum += sizes.back();
    }
    const double whole = network.stiffness[e] * sum;
    at[network.bonds.first[e]] += whole / mass[network.bonds.first[e]];
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      at[particles[k]] += whole * sizes[k] / mass[particles[k]];
    }
  }
}

double largest_pair(const Network& network, const std::vector<double>& p,
                    std::span<const double> mass) {
  double largest = 0.0;
  std::vector<double> at(network.num_contacts > 0 ? p.size() : 0, 0.0);  // largest sum per particle
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.is_contact(e)) continue;
    double sum = 0.0;
    for_each_end(network, e, [&](Index i, bool, double) { sum += p[i]; });
    largest = std::max(largest, sum);
    if (at.empty()) continue;
    for_each_end(network, e, [&](Index i, bool, double) { at[i] = std::max(at[i], sum); });
  }
  if (at.empty()) return largest;
  add_contacts(network, mass, at);
  return *std::ranges::max_element(at);
}

template <int Dim, int Width>
Inertia inertia_of(const Network& network, const Blocks<Width>& blocks,
                   std::span<const double> density, MassScaling scaling) {
  std::vector<double> mass = masses_of_volumes(network, density);
  std::vector<double> moving, turning;  // stiffness of displacements and of rotations
  for (const auto& block : blocks) {
    moving.push_back(largest_eigenvalue(block.template topLeftCorner<Dim, Dim>()));
    if constexpr (Width > Dim) {
      turning.push_back(
          largest_eigenvalue(block.template bottomRightCorner<Width - Dim, Width - Dim>()));
    }
  }
  if (scaling == MassScaling::uniform) scale_masses(moving, mass);
  complete_masses(moving, mass);
  Inertia inertia;
  std::vector<double> p;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    Eigen::Matrix<double, Width, 1> root = Eigen::Matrix<double, Width, 1>::Constant(mass[i]);
    if constexpr (Width > Dim) {
      const double turn = turning[i] > 0.0 ? mass[i] * turning[i] / moving[i] : mass[i];
      root.template tail<Width - Dim>().setConstant(turn);
    }
    for (int c = 0; c < Width; ++c) inertia.mass.push_back(root[c]);
    root = root.cwiseSqrt().cwiseInverse();
    p.push_back(largest_eigenvalue(root.asDiagonal() * blocks[i] * root.asDiagonal()));
  }
  const double square = largest_pair(network, p, mass);
  double springs = 0.0;
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    springs = std::max(springs, network.support_stiffness[slot] / inertia.mass[slot]);
  }
  inertia.frequency_bound = std::sqrt(square + springs);
  return inertia;
}

}  // namespace

Inertia lumped_inertia(const Network& network, std::span<const double> density, MassScaling scaling,
                       Strain strain) {
  const bool plane = network.dim() == 2;
  if (network.carries_moments()) {
    return plane ? inertia_of<2, 3>(network, own_frames<2>(network), density, scaling)
                 : inertia_of<3, 6>(network, own_frames<3>(network), density, scaling);
  }
  return plane ? inertia_of<2, 2>(network, own_trusses<2>(network, strain), density, scaling)
               : inertia_of<3, 3>(network, own_trusses<3>(network, strain), density, scaling);
}

}  // namespace perilink
