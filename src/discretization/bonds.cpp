#include "discretization/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
  for (int axis = 0; axis < dim; ++axis) vector[axis] /= length;
  append(i, j, length, std::span(vector).first(static_cast<std::size_t>(dim)));
}

void Bonds::begin_alike(const Bonds& others, std::size_t count) {
  dim = others.dim;
  lengths = others.lengths;
  directions = others.directions;
  first.reserve(count);
  second.reserve(count);
  kind.reserve(count);
}

void Bonds::append_alike(Index i, Index j, Index as) {
  first.push_back(i);
  second.push_back(j);
  kind.push_back(as);
}

void Bonds::append(Index i, Index j, double length, std::span<const double> towards) {
  const bool has_kinds = !kind.empty() || lengths.size() != first.size();
  if (has_kinds) kind.push_back(static_cast<Index>(lengths.size()));
  first.push_back(i);
  second.push_back(j);
  lengths.push_back(length);
  directions.insert(directions.end(), towards.begin(), towards.end());
}

namespace {

/// Finds the distinct pairs of length and direction, up to round-off.
class BondKinds {
 public:
  explicit BondKinds(const Bonds& bonds) : bonds_(bonds) { shared.dim = bonds.dim; }

  Index find(Index b) {
    // In a lattice, bonds follow one another in one order at every particle.
    const Index guess = last_ == no_index ? no_index : behind_[last_];
    const Index found = guess != no_index && is_alike(guess, b) ? guess : look_up(b);
    if (last_ != no_index) behind_[last_] = found;
    return last_ = found;
  }

  Bonds shared;  ///< one bond per kind

 private:
  using Cell = std::array<long long, 4>;

  Index look_up(Index b) {
    const auto [entry, is_new] = number_.try_emplace(cell_of(b), shared.size());
    if (!is_new && is_alike(entry->second, b)) return entry->second;
    shared.append(0, 1, bonds_.length(b), bonds_.direction(b));
    behind_.push_back(no_index);
    return shared.size() - 1;
  }
  bool is_alike(Index kind, Index b) const {
    constexpr double same = 1e-12;
    const auto is_near = [](double x, double y, double size) {
      return std::abs(x - y) <= same * size;
    };
    return is_near(shared.length(kind), bonds_.length(b), bonds_.length(b)) &&
           std::ranges::equal(shared.direction(kind), bonds_.direction(b),
                              [&](double x, double y) { return is_near(x, y, 1.0); });
  }
  /// Cells are much wider than round-off and much narrower than true differences.
  Cell cell_of(Index b) const {
    constexpr double cells = 1e7;
    Cell cell{std::llround(cells * bonds_.length(b) / bonds_.length(0))};
    for (int a = 0; a < bonds_.dim; ++a) cell[a + 1] = std::llround(cells * bonds_.direction(b)[a]);
    return cell;
  }

  const Bonds& bonds_;
  std::map<Cell, Index> number_;
  std::vector<Index> behind_;  // per kind: the kind that followed it last
  Index last_ = no_index;
};

}  // namespace

void share_directions(Bonds& bonds) {
  constexpr Index few = 1000, least_repeats = 16;
  if (!bonds.kind.empty()) return;
  BondKinds kinds(bonds);
  std::vector<Index> kind(bonds.first.size());
  for (Index b = 0; b < bonds.size(); ++b) {
    kind[b] = kinds.find(b);
    if (kinds.shared.size() > few + b / least_repeats) return;
  }
  bonds.kind = std::move(kind);
  bonds.lengths = std::move(kinds.shared.lengths);
  bonds.directions = std::move(kinds.shared.directions);
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
    // Ghosts follow all solid particles, so their upper neighbours are ghosts.
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
  if (!bonds.kind.empty()) {
    keep_values(bonds.kind, 1);
    return before - bonds.size();
  }
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
    if (bonds.dim == 2) gram(2, 2) = trace;  // the plane has no third direction
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(gram, Eigen::EigenvaluesOnly);
    // Squared sines between directions; round-off gives 1e-15.
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
