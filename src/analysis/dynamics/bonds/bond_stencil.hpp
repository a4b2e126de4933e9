#pragma once

#include <vector>

#include "network/network.hpp"

namespace perilink {

/// What the bonds of a regular body have in common with many others, to round-off.
struct BondKind {
  Vector3 direction{};   ///< unit vector from the first end to the second
  double length = 0.0;   ///< [length]
  double modulus = 0.0;  ///< k / (V_i V_j) [force/length^7]
  double limit = 0.0;    ///< extension at which it breaks [length]; infinity: it cannot break
};

/// Two bonds of one kind of each particle of a group: one to the particle `out` numbers further on,
/// of which it is the first end, and one to the particle `in` numbers back, of which it is the
/// second.
struct StencilLine {
  int kind = 0;
  Index out = 0, in = 0;

  friend auto operator<=>(const StencilLine&, const StencilLine&) = default;
};

/// The bonds of a network whose particles are numbered row after row: particles in groups of
/// `lanes`, the halves of their bonds in lines that reach equally far. Bonds that do not recur are
/// left to others.
struct BondStencil {
  static constexpr int lanes = 8;
  /// Slots of a line: outgoing bonds of all lanes, then incoming ones.
  static constexpr int line_slots = 2 * lanes;

  /// Where the lines and slots of a group begin.
  struct Group {
    int pattern = 0;
    std::size_t first_slot = 0;
  };

  std::vector<BondKind> kinds;                     ///< empty: no bond is on the stencil
  std::vector<std::vector<StencilLine>> patterns;  ///< lines of a group, as many groups have them
  std::vector<Group> groups;                       ///< particles lanes * g and the next
  std::vector<Index> element;  ///< per slot (group, line, side, lane); no_index: none
  std::vector<Index> rest;     ///< elements off the stencil, ascending
};

/// Bonds that can yield, and those of kinds that fill their lines too thinly, are off the stencil.
BondStencil find_stencil(const Network& network);

}  // namespace perilink
