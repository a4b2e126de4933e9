#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "base/types.hpp"

namespace perilink {

/// Search among bonds that only stretch. Holds only the bonds that can still break,
/// in the order of their numbers, with everything that does not change folded into one vector per
/// bond: ratio = g . (u_second - u_first), g = n / (xi s_c), so that a bond breaks at the load
/// factor 1 / ratio. One pass costs about one nanosecond per bond.
class LimitSearch final : public BreakSearch {
 public:
  explicit LimitSearch(const Network& network);

  Hit find(std::span<const double> displacement, double tolerance, int threads) override;
  void remove(Index element) override;

 private:
  template <int Dim>
  Hit find_in(const double* displacement, double tolerance, int threads);
  template <int Dim>
  double largest_between(const double* displacement, Index begin, Index end) const;

  int dim_;
  std::vector<Index> elements_;
  std::vector<Index> first_, second_;  ///< particle times dim
  std::vector<double> gradient_[3];    ///< g, one array per component
  std::vector<double> block_largest_;
};

}  // namespace perilink
