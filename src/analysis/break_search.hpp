#pragma once

#include <memory>
#include <span>

#include "assembly/network.hpp"
#include "base/types.hpp"

namespace perilink {

/// Finds the bond that is nearest to its critical stretch.
class BreakSearch {
 public:
  virtual ~BreakSearch() = default;

  struct Hit {
    Index element = no_index;
    double ratio = 0.0;  ///< stretch over critical stretch at load factor 1
  };

  /// Largest positive ratio; of those within `tolerance` of it the lowest element.
  /// \param displacement  shape (particles, width)
  virtual Hit find(std::span<const double> displacement, double tolerance, int threads) = 0;

  /// Takes a broken bond out of the search.
  virtual void remove(Index element) = 0;
};

/// The search for the bonds of a network: trusses or frames.
std::unique_ptr<BreakSearch> make_break_search(const Network& network);

}  // namespace perilink
