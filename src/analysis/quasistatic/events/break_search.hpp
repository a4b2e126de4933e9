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

struct EmbeddedParticles;
struct DeferredMotion;

/// Finds the element that is nearest to the limit of its law.
class BreakSearch {
 public:
  virtual ~BreakSearch() = default;

  struct Hit {
    Index element = no_index;
    double ratio = 0.0;  ///< stretch over its limit at load factor 1
  };

  /// Largest positive ratio; of those within `tolerance` of it the lowest element.
  /// \param displacement  shape (particles, width)
  /// \throws SolverError where the ratio of a bond is not a finite number
  virtual Hit find(std::span<const double> displacement, double tolerance, int threads) = 0;

  /// Every element whose ratio is at least `least`, in the order of their numbers.
  virtual std::vector<Hit> list(std::span<const double> displacement, double least) const = 0;

  /// The stretch at which the element has its next event; infinity: there is none, as when it is
  /// broken. Elements that stay elastic from the start are not in the search: nothing happens.
  virtual void set_limit(Index element, double limit) = 0;

  /// The same of an element with teeth in compression of its own.
  virtual void set_limits(Index element, double tension, double compression) = 0;

  /// From now on elements that are carried whole are looked at where their motion says so alone
  /// (DozingBlocks); find() then makes the displacements there current.
  /// \param carried  kept by reference
  /// \return per particle, whether its displacements must be current at each find()
  virtual std::vector<std::uint8_t> doze(const EmbeddedParticles& embedded) = 0;
  /// From now on displacements follow by columns: find() makes those current that it looks at, and
  /// looks where bounds say so alone (DozingColumns). Elsewhere they are those of earlier events.
  /// \param motion  kept by reference
  /// \return false where this search must have all
  virtual bool doze_by_columns(const DeferredMotion& /*motion*/) { return false; }
  /// All elements are looked at again.
  virtual void wake() = 0;
};

/// The ratio of an element's measure to its limit. One that is not a number compares as nothing and
/// would look like an element that never fails.
/// \throws SolverError where it is not finite
inline double finite_ratio(Index element, double ratio) {
  if (std::isfinite(ratio)) return ratio;
  throw SolverError("the stretch of element " + std::to_string(element) +
                    " over its limit is not a finite number: displacements or limits are not "
                    "finite, and no figure that follows would mean anything");
}

/// The search for the elements of a network, intact: trusses or frames.
std::unique_ptr<BreakSearch> make_break_search(const Network& network);

}  // namespace perilink
