#pragma once

#include <vector>

#include "analysis/ranks/particle_blocks.hpp"
#include "base/parcel.hpp"
#include "network/loaded_network.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Assignment of particles to ranks: consecutive blocks of consecutive numbers, about equally many.
/// The part of a rank spans the particles between the first and the last one that its elements
/// reach, from the first whole block on. A rank has the motion of its own particles and of those
/// that its elements reach.
struct Partition {
  /// \param blocks  all particles of the network; at least one block for each rank
  Partition(const Network& network, const ParticleBlocks& blocks, int ranks);

  int owner(Index particle) const;
  Index own_begin(int rank) const { return blocks.begin(first_block[rank]); }
  Index own_end(int rank) const { return blocks.end(first_block[rank + 1] - 1); }
  Ghosts ghosts(const Network& network, int rank) const;

  ParticleBlocks blocks;
  std::vector<Index> first_block;     ///< first block per rank, and the end; size ranks + 1
  std::vector<Index> first_particle;  ///< per rank: particle with number zero in the part
  std::vector<Index> past_particle;   ///< per rank: one past the last particle of the part
};

/// Part of a body on one rank. Particles, elements and blocks have numbers of the part.
struct BodyPart {
  /// Elements with an own end, also those around an embedded point. Positions are absent. Unknowns
  /// have the numbers of the whole body.
  LoadedNetwork body;
  std::vector<Index> elements;  ///< numbers in the whole body, ascending
  Index first_particle = 0;     ///< number of particle zero in the whole body
  Index own_begin = 0, own_end = 0;
  Ghosts ghosts;

  Index owned() const { return own_end - own_begin; }

  void pack(Parcel& parcel) const;
  static BodyPart unpack(Parcel& parcel);
};

BodyPart cut_part(const Network& network, const Unknowns& unknowns, const Partition& partition,
                  int rank);

/// Returns the values of the particles [begin, end) of a field of shape (particles, width); an
/// empty field gives an empty result.
template <class T>
std::vector<T> slice(const std::vector<T>& field, Index begin, Index end, int width) {
  if (field.empty()) return {};
  return {field.begin() + static_cast<std::ptrdiff_t>(begin) * width,
          field.begin() + static_cast<std::ptrdiff_t>(end) * width};
}

/// Returns the numbers within the part of those elements of `all` that the part has.
/// \param elements  BodyPart::elements
std::vector<Index> in_part(const std::vector<Index>& all, const std::vector<Index>& elements);

}  // namespace perilink
