#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/from_case/configure.hpp"
#include "specimens.hpp"

/// \file
/// Where the crack of a specimen runs, and how long it is, from the damage of the particles.
///
/// The ligament is cut into rows of particles across the direction of growth. A row is **cracked**
/// where one of its particles has lost at least half of what a plane crack through the whole body
/// takes from the particle beside it: so a crack that ends at a row has a row that is just cracked,
/// since by symmetry half of the bonds across are behind its end. The crack is the chain of cracked
/// rows through the row with most damage, from neighbour to neighbour; in a row it lies at the
/// centre of damage. Rows as much as one horizon apart belong together. Its length is uncertain by
/// about a spacing at each free end.

namespace perilink::verification {

/// One row of particles that the crack has passed.
struct CrackedRow {
  double along = 0.0;   ///< coordinate on the axis of growth [length]
  double across = 0.0;  ///< centre of damage on the other axis [length]
};

struct CrackPath {
  std::vector<CrackedRow> rows;  ///< ascending
  double extent = 0.0;           ///< on the axis of growth [length]
  double length = 0.0;  ///< along the polygon through the means of rows over one horizon [length]
  double energy = 0.0;  ///< its area times the specimen's fracture energies [force length]
};

/// Damage of the particle beside a plane crack through a body without ends, normal to the axis
/// `across`.
double damage_beside_plane_crack(const Lattice& lattice, double horizon, int across);

/// The crack after these bonds have broken.
CrackPath find_crack(const Specimen& specimen, const Model& model,
                     std::span<const Index> broken_bonds);

/// Bonds that broke somewhere else.
struct StrayBreaks {
  /// With their middle further than a horizon and a spacing from the crack ...
  Index elsewhere = 0;
  Index at_notch = 0;  ///< ... or not so far from a corner of the notch; these do not count above
  double farthest = 0.0;          ///< distance of a broken bond's middle from the crack [length]
  std::array<double, 2> place{};  ///< middle of that bond [length]
};

StrayBreaks find_stray_breaks(const Specimen& specimen, const CrackPath& path, const Model& model,
                              std::span<const Index> broken_bonds);

/// Energy released by a plane crack between rows of the lattice over G_F: the critical stretch is
/// right in the mean over all directions of the crack, and a lattice is not the same in all of
/// them.
double plane_crack_energy_ratio(const Specimen& specimen, const Model& model);

}  // namespace perilink::verification
