#pragma once

#include <cstdint>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Bodies that are bonds in one part and ordinary finite elements in another. At the face between
/// them the network ends as at a surface: its calibrated bonds balance the tractions of every
/// uniform stress, which are what the linear elements beyond put on the same vertices.

namespace perilink {

/// The part of a body that has bonds, a body of its own without groups.
struct BondedPart {
  Body body;
  std::vector<Index> whole_of;  ///< its particles' numbers in the whole body, ascending
};

/// \param thickness  two-dimensional bodies only [length]
BondedPart bonded_part(const Body& whole, double thickness);

/// Makes the network of the bonded part that of the whole body: particles, facets with the shares
/// that the bonds balance, cells, and their edges as bonds without stiffness.
void join_cells(const Body& whole, const BondedPart& part, const NetworkInput& input,
                Network& network);

/// Per particle, nonzero for vertices of the cells of a network; empty: it has none.
std::vector<std::uint8_t> vertices_of_cells(const Network& network);

}  // namespace perilink
