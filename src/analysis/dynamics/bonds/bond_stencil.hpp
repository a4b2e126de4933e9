#pragma once

#include <vector>

#include "network/network.hpp"

namespace perilink {

/// Translation class of bonds in a regular body: values that many bonds share, to round-off.
struct BondKind {
  Vector3 direction{};   ///< unit vector from the first end to the second
  double length = 0.0;   ///< [length]
  double modulus = 0.0;  ///< k / (V_i V_j) [force/length^7]
  double limit = 0.0;    ///< extension at which the bond breaks [length]; infinity: unbreakable
};

/// Two bonds of one kind of each particle of a group. In the bond to the particle `out` numbers
/// further on, the particle is the first end. In the bond to the particle `in` numbers back, it is
/// the second end.
struct StencilLine {
  int kind = 0;
  Index out = 0, in = 0;

  friend auto operator<=>(const StencilLine&, const StencilLine&) = default;
};

/// Bonds of a network whose particles are numbered row after row. Particles form groups of `lanes`.
/// A line holds the directed bonds of a group that reach equally far. Bonds that do not recur are
/// in `rest`.
struct BondStencil {
  static constexpr int lanes = 8;
  /// Slots of a line: outgoing bonds of all lanes, then incoming ones.
  static constexpr int line_slots = 2 * lanes;

  /// Where the lines and slots of a group begin.
  struct Group {
    int pattern = 0;
    std::size_t first_slot = 0;
  };

  std::vector<BondKind> kinds;  ///< empty: no bond is on the stencil
  /// lines of a group; many groups share one pattern
  std::vector<std::vector<StencilLine>> patterns;
  std::vector<Group> groups;   ///< group g: particles lanes * g to lanes * (g + 1) - 1
  std::vector<Index> element;  ///< per slot (group, line, side, lane); no_index: none
  std::vector<Index> rest;     ///< elements off the stencil, ascending
};

/// Returns the stencil of a network. Bonds that can yield, and bonds of kinds that fill their lines
/// too thinly, are off the stencil.
BondStencil find_stencil(const Network& network);

}  // namespace perilink
