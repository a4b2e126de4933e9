#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Bonds of a body, one entry per unordered pair, first < second, sorted by (first, second). The
/// number of a bond therefore does not depend on the search for neighbours.
struct Bonds {
  int dim = 2;
  std::vector<Index> first;
  std::vector<Index> second;
  std::vector<double> lengths;     ///< xi [length], per kind
  std::vector<double> directions;  ///< unit vectors from first to second, shape (kinds, dim)
  std::vector<Index> kind;         ///< kind of each bond; empty: each bond is its own kind

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
  /// Appends the bond between two distinct particles. The caller must keep the sorting.
  void append(const Particles& particles, Index i, Index j);
  /// Empties the bonds, copies the kinds of `others` and reserves memory for `count` bonds.
  void begin_alike(const Bonds& others, std::size_t count);
  void append_alike(Index i, Index j, Index as);
  /// \param towards  unit vector from i to j, size dim
  void append(Index i, Index j, double length, std::span<const double> towards);
};

/// Stores one length and direction per kind of bonds that are equal up to round-off, if there are
/// far fewer kinds than bonds. Otherwise lengths and directions need most of a truss network's
/// memory.
void share_directions(Bonds& bonds);

/// Relative tolerance of the horizon. Round-off must not remove neighbours that lie on the horizon
/// by construction.
inline constexpr double horizon_tolerance = 1e-9;

/// Returns bonds between all solid and ghost particles within the horizon. Ghosts are not bonded to
/// one another, because such bonds would have no stiffness.
Bonds make_bonds(const Particles& particles, double horizon);

/// Returns bonds of every particle (neighbourhoods): row i holds the numbers of the bonds that end
/// at particle i.
Csr bonds_of_particles(const Bonds& bonds, Index num_particles);

/// Keeps the marked bonds in their order. \return number of removed bonds
Index keep_bonds(Bonds& bonds, std::span<const std::uint8_t> keep);

/// Keeps the marked particles in their order, and the bonds between them.
void keep_particles(Particles& particles, Bonds& bonds, std::span<const std::uint8_t> keep);

/// Returns nonzero for each particle whose bonds have fewer than dim independent directions. Such
/// particles can move without energy.
/// \param stiffness  per bond; bonds without stiffness are ignored; empty: all bonds count
std::vector<std::uint8_t> loosely_held(const Bonds& bonds, Index num_particles,
                                       std::span<const double> stiffness = {});

/// Removes ghosts whose bonds have fewer than dim independent directions, with their bonds. Such
/// ghosts carry no force and would make the stiffness singular. Call it before bars are added.
/// \return number of removed ghosts
Index remove_loose_ghosts(Particles& particles, Bonds& bonds);

/// Returns the number of the connected part that each particle belongs to, from zero in the order
/// of the parts' first particles.
std::vector<Index> connected_parts(const Bonds& bonds, Index num_particles);

}  // namespace perilink
