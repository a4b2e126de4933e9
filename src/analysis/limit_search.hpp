#pragma once

#include <span>
#include <vector>

#include "assembly/network.hpp"
#include "base/types.hpp"

namespace perilink {

/// Finds the bond that is nearest to its critical stretch. Holds only the bonds that can still break,
/// in the order of their numbers, with everything that does not change folded into one vector per
/// bond: ratio = g . (u_second - u_first), g = n / (xi s_c), so that a bond breaks at the load factor
/// 1 / ratio. One pass costs about one nanosecond per bond.
class LimitSearch {
 public:
  explicit LimitSearch(const Network& network);

  struct Hit {
    Index element = no_index;
    double ratio = 0.0;  ///< stretch over critical stretch at load factor 1
  };

  /// Largest positive ratio; of those within `tolerance` of it the lowest element.
  /// \param displacement  shape (particles, dim)
  Hit find(std::span<const double> displacement, double tolerance, int threads);

  /// Takes a broken bond out of the search.
  void remove(Index element);

 private:
  template <int Dim>
  Hit find_in(const double* displacement, double tolerance, int threads);
  template <int Dim>
  double largest_in_block(const double* displacement, Index block) const;

  int dim_;
  std::vector<Index> elements_;
  std::vector<Index> first_, second_;  ///< particle times dim
  std::vector<double> gradient_[3];    ///< g, one array per component
  std::vector<double> block_largest_;
};

}  // namespace perilink
