#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// The bonds of a body, one entry per unordered pair, first < second, sorted by (first, second), so
/// that the number of a bond does not depend on how its neighbours were found.
struct Bonds {
  int dim = 2;
  std::vector<Index> first;
  std::vector<Index> second;
  std::vector<double> lengths;     ///< xi [length], per kind
  std::vector<double> directions;  ///< unit vectors from first to second, shape (kinds, dim)
  std::vector<Index> kind;         ///< per bond; empty: every bond is its own

  Index size() const { return static_cast<Index>(first.size()); }
  Index kind_of(Index b) const { return kind.empty() ? b : kind[b]; }
  Index num_kinds() const { return static_cast<Index>(lengths.size()); }
  double length(Index b) const { return lengths[kind_of(b)]; }
  std::span<const double> direction(Index b) const { return direction_of_kind(kind_of(b)); }
  std::span<const double> direction_of_kind(Index k) const {
    return {directions.data() + static_cast<std::size_t>(k) * dim, static_cast<std::size_t>(dim)};
  }
  Index other_end(Index b, Index particle) const {
    return first[b] == particle ? second[b] : first[b];
  }
  void reserve(std::size_t count);
  /// Appends the bond between two distinct particles; the caller keeps the order.
  void append(const Particles& particles, Index i, Index j);
  /// No bonds yet, room for some that have the kinds of others.
  void begin_alike(const Bonds& others, std::size_t count);
  void append_alike(Index i, Index j, Index as);
  /// \param towards  unit vector from i to j, size dim
  void append(Index i, Index j, double length, std::span<const double> towards);
};

/// Keeps one length and direction for all bonds that have the same but for round-off, where there
/// are far fewer of these than bonds: elsewhere they are most of what a network of trusses takes.
void share_directions(Bonds& bonds);

/// Distances up to horizon * (1 + horizon_tolerance) are inside the horizon: a neighbour that lies
/// on the horizon by construction must not be lost to round-off.
inline constexpr double horizon_tolerance = 1e-9;

/// Bonds between all solid and ghost particles within the horizon. Ghosts are not bonded to each
/// other (their stiffness would be zero).
Bonds make_bonds(const Particles& particles, double horizon);

/// Bonds at every particle (families): row i holds the numbers of the bonds that end at particle i.
Csr bonds_of_particles(const Bonds& bonds, Index num_particles);

/// Keeps the bonds that are marked, in their order. \return number of bonds taken out
Index keep_bonds(Bonds& bonds, std::span<const std::uint8_t> keep);

/// Keeps the particles that are marked, in their order, and the bonds between them.
void keep_particles(Particles& particles, Bonds& bonds, std::span<const std::uint8_t> keep);

/// Whether bonds in fewer than dim independent directions hold each particle: it could move for
/// nothing.
/// \param stiffness  per bond: those that have none do not count; empty: all do
std::vector<std::uint8_t> loosely_held(const Bonds& bonds, Index num_particles,
                                       std::span<const double> stiffness = {});

/// Drops the ghosts that bonds in fewer than dim independent directions hold, with their bonds:
/// they carry no force and would make the stiffness singular. To be called before bars are added.
/// \return number of ghosts dropped
Index remove_loose_ghosts(Particles& particles, Bonds& bonds);

/// Number of the connected part of the body that each particle belongs to, from zero in the order
/// of their first particles.
std::vector<Index> connected_parts(const Bonds& bonds, Index num_particles);

}  // namespace perilink
