#include "discretization/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

Index num_before_bars(const Particles& particles) {
  const auto first_bar =
      std::find(particles.kind.begin(), particles.kind.end(), ParticleKind::rebar);
  return static_cast<Index>(first_bar - particles.kind.begin());
}

/// Particles up to the first reinforcing bar that bonds in fewer than dim independent directions
/// hold. The Gram matrix of the directions is singular exactly there; its determinant over the
/// power of its trace is free of scale.
std::vector<std::uint8_t> loosely_held(const Bonds& bonds, Index num_particles) {
  const int dim = bonds.dim;
  const std::size_t block = static_cast<std::size_t>(dim) * dim;
  std::vector<double> gram(num_particles * block, 0.0);
  for (Index b = 0; b < bonds.size(); ++b) {
    const auto n = bonds.direction(b);
    for (const Index end : {bonds.first[b], bonds.second[b]}) {
      double* g = gram.data() + end * block;
      for (int row = 0; row < dim; ++row) {
        for (int col = 0; col < dim; ++col) g[row * dim + col] += n[row] * n[col];
      }
    }
  }
  std::vector<std::uint8_t> loose(num_particles);
  for (Index i = 0; i < num_particles; ++i) {
    const double* g = gram.data() + i * block;
    double trace = g[0] + g[3];
    double determinant = g[0] * g[3] - g[1] * g[2];
    if (dim == 3) {
      trace = g[0] + g[4] + g[8];
      determinant = g[0] * (g[4] * g[8] - g[5] * g[7]) - g[1] * (g[3] * g[8] - g[5] * g[6]) +
                    g[2] * (g[3] * g[7] - g[4] * g[6]);
    }
    // Lattice directions that differ at all give more than 1e-4; round-off gives less than 1e-15.
    loose[i] = !(determinant > 1e-10 * std::pow(trace, dim));
  }
  return loose;
}

}  // namespace

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
  Csr families;
  families.offsets.assign(static_cast<std::size_t>(num_particles) + 1, 0);
  for (const Index i : bonds.first) ++families.offsets[i + 1];
  for (const Index j : bonds.second) ++families.offsets[j + 1];
  std::partial_sum(families.offsets.begin(), families.offsets.end(), families.offsets.begin());
  families.values.resize(families.offsets.back());
  std::vector<Index> next(families.offsets.begin(), families.offsets.end() - 1);
  for (Index b = 0; b < bonds.size(); ++b) {
    families.values[next[bonds.first[b]]++] = b;
    families.values[next[bonds.second[b]]++] = b;
  }
  return families;
}

Index remove_loose_ghosts(Particles& particles, Bonds& bonds) {
  const Index count = particles.size();
  const int dim = particles.dim;
  const std::vector<std::uint8_t> loose = loosely_held(bonds, count);
  std::vector<Index> new_number(count, no_index);
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    if (loose[i] && particles.kind[i] == ParticleKind::ghost) continue;
    for (int axis = 0; axis < dim; ++axis) {
      particles.positions[static_cast<std::size_t>(kept) * dim + axis] =
          particles.positions[static_cast<std::size_t>(i) * dim + axis];
    }
    particles.volumes[kept] = particles.volumes[i];
    particles.material[kept] = particles.material[i];
    particles.kind[kept] = particles.kind[i];
    new_number[i] = kept++;
  }
  if (kept == count) return 0;
  particles.positions.resize(static_cast<std::size_t>(kept) * dim);
  particles.volumes.resize(kept);
  particles.material.resize(kept);
  particles.kind.resize(kept);

  Bonds remaining;
  remaining.dim = dim;
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = new_number[bonds.first[b]];
    const Index j = new_number[bonds.second[b]];
    if (i != no_index && j != no_index) remaining.append(particles, i, j);
  }
  bonds = std::move(remaining);
  return count - kept;
}

std::vector<Index> connected_parts(const Bonds& bonds, Index num_particles) {
  std::vector<Index> parent(static_cast<std::size_t>(num_particles));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = root(bonds.first[b]), j = root(bonds.second[b]);
    parent[std::max(i, j)] = std::min(i, j);
  }
  std::vector<Index> part(parent.size());
  Index count = 0;
  for (Index i = 0; i < num_particles; ++i) {
    part[i] = root(i) == i ? count++ : part[root(i)];
  }
  return part;
}

}  // namespace perilink
