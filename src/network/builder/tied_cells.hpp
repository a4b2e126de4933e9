#pragma once

#include <cstdint>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Bodies with bonds in one part and tied finite elements in the other. At the common face the
/// network ends as at a surface. Its calibrated bonds balance the tractions of every uniform
/// stress, and the linear elements exert these tractions on the same vertices.

namespace perilink {

/// The bonded part of a body, as a body without groups.
struct BondedPart {
  Body body;
  std::vector<Index> whole_of;  ///< numbers of its particles in the whole body, ascending
};

/// \param thickness  thickness of two-dimensional bodies [length]
BondedPart bonded_part(const Body& whole, double thickness);

/// Extends the network of the bonded part to the whole body: particles, facets with nodal area
/// fractions, cells, and their edges as bonds without stiffness.
void join_cells(const Body& whole, const BondedPart& part, const NetworkInput& input,
                Network& network);

/// Flags the vertices of the cells of a network, per particle; empty without cells.
std::vector<std::uint8_t> vertices_of_cells(const Network& network);

}  // namespace perilink
