#include "discretization/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/joined_parts.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

Index num_before_bars(const Particles& particles) {
  const auto first_bar =
      std::find(particles.kind.begin(), particles.kind.end(), ParticleKind::rebar);
  return static_cast<Index>(first_bar - particles.kind.begin());
}

}  // namespace

void Bonds::reserve(std::size_t count) {
  first.reserve(count);
  second.reserve(count);
  lengths.reserve(count);
  directions.reserve(count * dim);
}

void Bonds::append(const Particles& particles, Index i, Index j) {
  const auto from = particles.position(i);
  const auto to = particles.position(j);
  Vector3 vector{};
  for (int axis = 0; axis < dim; ++axis) vector[axis] = to[axis] - from[axis];
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  first.push_back(i);
  second.push_back(j);
  lengths.push_back(length);
  for (int axis = 0; axis < dim; ++axis) directions.push_back(vector[axis] / length);
}

Bonds make_bonds(const Particles& particles, double horizon) {
  const Index count = num_before_bars(particles);
  const std::span<const double> positions(particles.positions.data(),
                                          static_cast<std::size_t>(count) * particles.dim);
  const Csr neighbors =
      find_upper_neighbors(positions, particles.dim, horizon * (1.0 + horizon_tolerance));
  Bonds bonds;
  bonds.dim = particles.dim;
  bonds.first.reserve(neighbors.values.size());
  bonds.second.reserve(neighbors.values.size());
  bonds.lengths.reserve(neighbors.values.size());
  bonds.directions.reserve(neighbors.values.size() * particles.dim);
  for (Index i = 0; i < count; ++i) {
    // Ghosts come after all solid particles: their upper neighbours are ghosts.
    if (particles.kind[i] == ParticleKind::ghost) break;
    for (const Index j : neighbors.row(i)) bonds.append(particles, i, j);
  }
  return bonds;
}

Csr bonds_of_particles(const Bonds& bonds, Index num_particles) {
  return sorted_into_rows(num_particles, [&](auto&& act) {
    for (Index b = 0; b < bonds.size(); ++b) {
      act(bonds.first[b], b);
      act(bonds.second[b], b);
    }
  });
}

Index keep_bonds(Bonds& bonds, std::span<const std::uint8_t> keep) {
  const auto keep_values = [&](auto& values, std::size_t width) {
    std::size_t next = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (keep[k / width]) values[next++] = values[k];
    }
    values.resize(next);
  };
  const Index before = bonds.size();
  keep_values(bonds.first, 1);
  keep_values(bonds.second, 1);
  keep_values(bonds.lengths, 1);
  keep_values(bonds.directions, static_cast<std::size_t>(bonds.dim));
  return before - bonds.size();
}

void keep_particles(Particles& particles, Bonds& bonds, std::span<const std::uint8_t> keep) {
  std::vector<Index> number(keep.size(), no_index);
  Index kept = 0;
  const int dim = particles.dim;
  for (Index i = 0; i < particles.size(); ++i) {
    if (!keep[i]) continue;
    const auto from = particles.position(i);
    std::copy(from.begin(), from.end(),
              particles.positions.begin() + static_cast<std::ptrdiff_t>(kept) * dim);
    particles.volumes[kept] = particles.volumes[i];
    particles.material[kept] = particles.material[i];
    particles.kind[kept] = particles.kind[i];
    number[i] = kept++;
  }
  particles.positions.resize(static_cast<std::size_t>(kept) * dim);
  particles.volumes.resize(kept);
  particles.material.resize(kept);
  particles.kind.resize(kept);

  Bonds remaining;
  remaining.dim = dim;
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = number[bonds.first[b]], j = number[bonds.second[b]];
    if (i != no_index && j != no_index) remaining.append(particles, i, j);
  }
  bonds = std::move(remaining);
}

std::vector<std::uint8_t> loosely_held(const Bonds& bonds, Index num_particles,
                                       std::span<const double> stiffness) {
  std::vector<Eigen::Matrix3d> grams(static_cast<std::size_t>(num_particles),
                                     Eigen::Matrix3d::Zero());
  for (Index b = 0; b < bonds.size(); ++b) {
    if (!stiffness.empty() && !(stiffness[b] > 0.0)) continue;
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < bonds.dim; ++axis) n[axis] = bonds.direction(b)[axis];
    grams[bonds.first[b]] += n * n.transpose();
    grams[bonds.second[b]] += n * n.transpose();
  }
  std::vector<std::uint8_t> loose;
  for (Eigen::Matrix3d& gram : grams) {
    const double trace = gram.trace();
    if (bonds.dim == 2) gram(2, 2) = trace;  // the third direction is not asked for
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(gram, Eigen::EigenvaluesOnly);
    // Squared sines between directions; round-off leaves 1e-15.
    loose.push_back(!(solver.eigenvalues()[0] > 1e-10 * trace));
  }
  return loose;
}

Index remove_loose_ghosts(Particles& particles, Bonds& bonds) {
  const auto is_ghost = [](ParticleKind kind) { return kind == ParticleKind::ghost; };
  if (std::none_of(particles.kind.begin(), particles.kind.end(), is_ghost)) return 0;
  std::vector<std::uint8_t> keep = loosely_held(bonds, particles.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !(keep[i] && is_ghost(particles.kind[i]));
  keep_particles(particles, bonds, keep);
  return static_cast<Index>(keep.size()) - particles.size();
}

std::vector<Index> connected_parts(const Bonds& bonds, Index num_particles) {
  JoinedParts parts(num_particles);
  for (Index b = 0; b < bonds.size(); ++b) parts.join(bonds.first[b], bonds.second[b]);
  std::vector<Index> part(static_cast<std::size_t>(num_particles));
  Index count = 0;
  for (Index i = 0; i < num_particles; ++i) {
    part[i] = parts.find(i) == i ? count++ : part[parts.find(i)];
  }
  return part;
}

}  // namespace perilink
