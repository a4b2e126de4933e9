#pragma once

#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Damage of the elements, and springs on loose parts: the state of an Equilibrium besides factor
/// and displacements, which follow from it.
struct ElementState {
  std::vector<double> secants;  ///< present over intact stiffness, per element [-]
  std::vector<double> axial;    ///< secants against a change of length; empty if none differs
  std::vector<Index> damaged;   ///< elements that close in compression, in the order of damage
  std::vector<double> closed;   ///< of these: axial stiffness when closed over the intact one [-]
  /// Ground springs, per unknown; empty until a part came loose. Stiffness and forces by growing
  /// and constant loads.
  std::vector<double> ground_stiffness, ground_load, constant_ground_load;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(secants, axial, damaged, closed, ground_stiffness, ground_load, constant_ground_load);
  }
};

}  // namespace perilink
