#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Finds the element closest to the limit of its law.
class BreakSearch {
 public:
  virtual ~BreakSearch() = default;

  struct Hit {
    Index element = no_index;
    double ratio = 0.0;  ///< stretch over its limit at load factor 1
  };

  /// Finds the largest positive ratio. Among elements within `tolerance` of it, the lowest number
  /// wins.
  /// \param displacement  shape (particles, width)
  /// \throws SolverError if the ratio of an element is not finite
  virtual Hit find(std::span<const double> displacement, double tolerance, int threads) = 0;

  /// Returns every element whose ratio is at least `least`, ascending.
  virtual std::vector<Hit> list(std::span<const double> displacement, double least) const = 0;

  /// Sets the stretch of an element's next event; infinity if there is none, as after it breaks.
  /// Elements that stay elastic from the start are not in the search and are ignored.
  virtual void set_limit(Index element, double limit) = 0;

  /// Sets the next limits of an element that has its own segments in compression.
  virtual void set_limits(Index element, double tension, double compression) = 0;
};

/// Returns `ratio`, the stretch of an element over its limit, after a check. Unchecked, an element
/// whose ratio is not a number would never fail.
/// \throws SolverError if the ratio is not finite
inline double finite_ratio(Index element, double ratio) {
  if (std::isfinite(ratio)) return ratio;
  throw SolverError("the stretch of element " + std::to_string(element) +
                    " over its limit is not a finite number: displacements or limits are not "
                    "finite, and further results would be meaningless");
}

/// Fraction of a motion below which an extension is round-off [-]: of the motion of the element's
/// ends, or of the largest in the body, which errors of K^-1 carry to particles at rest.
inline constexpr double motion_round_off = 1e-12;

/// Makes the search for the intact elements of a network, trusses or frames.
/// \param at_loads  displacements are under given loads, as in stages, not at load factor 1. Bonds
///                  that bend are then in tension where CrossingSearch says so.
std::unique_ptr<BreakSearch> make_break_search(const Network& network, bool at_loads);

}  // namespace perilink
