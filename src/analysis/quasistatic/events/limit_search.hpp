#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "analysis/quasistatic/events/dozing_blocks.hpp"
#include "analysis/quasistatic/events/dozing_columns.hpp"
#include "base/types.hpp"

namespace perilink {

/// Search among elements that only stretch. Holds those that have events, in the order of their
/// numbers, with everything that does not change folded into one vector per element: ratio = g .
/// (u_second - u_first), g = n / (xi s), so that the event at the stretch s comes at the load
/// factor 1 / ratio. One pass costs about one nanosecond per element.
class LimitSearch final : public BreakSearch {
 public:
  /// \throws std::invalid_argument where elements have teeth in compression of their own
  explicit LimitSearch(const Network& network);

  Hit find(std::span<const double> displacement, double tolerance, int threads) override;
  std::vector<Hit> list(std::span<const double> displacement, double least) const override;
  void set_limit(Index element, double limit) override;
  void set_limits(Index element, double tension, double compression) override;
  std::vector<std::uint8_t> doze(const EmbeddedParticles& embedded) override;
  bool doze_by_columns(const DeferredMotion& motion) override;
  void wake() override { pulled_.dozing = strained_.dozing = {}; }

 private:
  /// Elements whose events come in tension, or those that have them in compression as well.
  struct Group {
    std::vector<Index> elements;
    std::vector<Index> first, second;  ///< particle times dim
    std::vector<double> gradient[3];   ///< g, one array per component
    std::vector<double> block_largest;
    DozingBlocks dozing;
    DozingColumns by_columns;
  };
  void add(Index element, Group& group);
  void set_gradient(Group& group, std::size_t place, double limit);
  std::array<double, block_width> largest_of_columns(std::size_t begin, std::size_t end,
                                                     const double* columns) const;
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
