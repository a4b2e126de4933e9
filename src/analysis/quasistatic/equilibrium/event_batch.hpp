#pragma once

#include <cstdint>
#include <vector>

#include "analysis/quasistatic/equilibrium/removal.hpp"

namespace perilink {

/// An element that goes on with a smaller secant.
struct Weakening {
  Index element;
  double secant;  ///< 0: it breaks
};

/// Elements that lose stiffness at once, and the body before. Vectors have one entry per element
/// but for solutions, which are per unknown.
struct EventBatch {
  std::vector<Removal> removals;
  std::vector<Removal::Deformations> before;  ///< by the loads that grow
  std::vector<Removal::Deformations> beside;  ///< x'u of displacements by constant loads
  std::vector<std::uint8_t> was_first;        ///< whether it was intact
  std::vector<std::uint8_t> breaks;
  std::vector<double> secants;
  std::vector<double> solution, constant_solution;
  bool tells_pivots = false;  ///< the factor has told the smallest
  bool keeps_factor = false;  ///< the factor has not been changed
  bool lagged = false;        ///< the factor was that of an even earlier body
  double force_work = 0.0;    ///< f'u before
};

}  // namespace perilink
