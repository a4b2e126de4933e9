#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "base/types.hpp"

namespace perilink {

/// Search among truss elements. Holds the elements with events in ascending order. All constant
/// data are folded into one vector per element, g = n / (xi s), so that ratio = g . (u_second -
/// u_first). The event at stretch s has the load factor 1 / ratio. One pass costs about one
/// nanosecond per element.
class LimitSearch final : public BreakSearch {
 public:
  /// \throws std::invalid_argument if elements have their own segments in compression
  explicit LimitSearch(const Network& network);

  Hit find(std::span<const double> displacement, double tolerance, int threads) override;
  std::vector<Hit> list(std::span<const double> displacement, double least) const override;
  void set_limit(Index element, double limit) override;
  void set_limits(Index element, double tension, double compression) override;

 private:
  /// Elements with events in tension only, or in tension and compression.
  struct Group {
    std::vector<Index> elements;
    std::vector<Index> first, second;  ///< offsets of the ends (particle times dim)
    std::vector<double> gradient[3];   ///< g, one array per component
    std::vector<double> block_largest;
  };
  void add(Index element, Group& group);
  void set_gradient(Group& group, std::size_t place, double limit);
  template <int Dim, Sense sense>
  static double ratio_at(const Group& group, const double* displacement, Index place);
  template <int Dim, Sense sense>
  static double largest_between(const Group& group, const double* displacement, Index begin,
                                Index end);
  template <int Dim, Sense sense>
  static Hit find_in(Group& group, const double* displacement, double tolerance, int threads);
  template <int Dim>
  Hit find_in_all(const double* displacement, double tolerance, int threads);

  const Network& network_;
  int dim_;
  Group pulled_, strained_;  ///< by Sense: tension, both
};

}  // namespace perilink
