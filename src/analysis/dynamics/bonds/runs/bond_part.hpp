#pragma once

#include <vector>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/particle_blocks.hpp"
#include "base/parcel.hpp"
#include "network/loaded_network.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Which blocks of particles each rank moves: as many as the others, in the order of their numbers,
/// so that sums over blocks are those of one process. A rank numbers the particles between the
/// first and the last one that its elements reach, from the first whole block on; it knows the
/// motion of its own ones and of those that its elements reach.
struct BlockPartition {
  /// \param ranks  no more than there are blocks
  BlockPartition(const Network& network, int ranks);

  int owner(Index particle) const;
  Index own_begin(int rank) const { return blocks.begin(first_block[rank]); }
  Index own_end(int rank) const { return blocks.end(first_block[rank + 1] - 1); }
  Ghosts ghosts(const Network& network, int rank) const;

  ParticleBlocks blocks;
  std::vector<Index> first_block;     ///< per rank, and an end
  std::vector<Index> first_particle;  ///< per rank: the one with its number zero
  std::vector<Index> past_particle;   ///< per rank: behind the last one that it numbers
};

/// What a rank knows of a body whose bonds move: numbers are the part's own.
struct BondPart {
  LoadedNetwork body;           ///< elements with an own end, also around an anchor
  int component = 0;            ///< main_component() of the whole body
  std::vector<double> mass;     ///< shape (particles, width)
  BondStencil stencil;          ///< that of the whole body, so that its sums have the same order
  std::vector<Index> elements;  ///< numbers in the whole body, ascending
  Index first_particle = 0;     ///< number in the whole body of its number zero
  Ghosts ghosts;
  Index first_block = 0, past_block = 0;  ///< own ones

  Parcel pack() const;
  static BondPart unpack(Parcel parcel);
};

/// \param mass  shape (particles, width)
BondPart cut_part(const LoadedNetwork& body, const std::vector<double>& mass,
                  const BondStencil& stencil, const BlockPartition& partition, int rank);

}  // namespace perilink
