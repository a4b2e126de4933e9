#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Finds load factors at which elements pass their limits. The displacements are u + d v: the
/// present ones plus d times those of growing loads. The stretch over its limit of a truss is
/// linear in d. The squared equivalent stretch of a micropolar bond (FrameLimitSearch) is quadratic
/// in d. An element fails in one or two open intervals of d. Extensions within the round-off of the
/// ends' motion count as constant, as do deformations within that of the largest motion.
class CrossingSearch {
 public:
  explicit CrossingSearch(const Network& network);

  /// End of an interval: an element passes its limit there as d changes.
  struct Crossing {
    Index element = no_index;  ///< no_index: there is none
    double distance = 0.0;     ///< d
    /// Elements whose limits exclude each other if no d satisfies all.
    std::vector<Index> conflict = {};
  };

  /// Finds the first d from u onwards at which an element begins to fail. Among elements within
  /// `tolerance` of their limits, the lowest number wins. Elements that already fail at u are
  /// skipped.
  /// \param sense  1: d grows, -1: d falls; `distance` has this sign
  Crossing ahead(std::span<const double> now, std::span<const double> growing, int sense,
                 double tolerance, int threads);

  /// Finds the largest d at which no element fails, and the element that fails beyond it. Without
  /// an element, `distance` is infinite if no element ever fails. It is minus infinity if no such d
  /// exists.
  Crossing largest(std::span<const double> now, std::span<const double> growing, double tolerance,
                   int threads);

  /// See BreakSearch::set_limit().
  void set_limit(Index element, double limit);

 private:
  struct Element {
    Index number, first, second;  ///< element, and offsets of its ends (particle times width)
    double n[3];
    double first_arm, second_arm;        ///< distances from the ends to the inflection [length]
    double shear_share, rotation_share;  ///< square roots of the shares in FrameLimitSearch::Bond
    double length;                       ///< [length]
    double inverse;                      ///< 1 / (xi s) for the limit s; zero without a limit
    bool both;                           ///< the law has Sense::both
  };
  /// Values of d between which an element fails. Up to `margin` outside, it is within the tolerance
  /// of its limit.
  struct Interval {
    double low, high, margin;
  };

  struct Query {
    const double* now;
    const double* growing;
    double sense;  ///< 1 or -1: sign of the growing displacements
    double tolerance;
    bool largest;  ///< the query is largest(), not ahead()
    double noise;  ///< growing deformations up to this are round-off [length]

    Query(const Network& network, std::span<const double> now, std::span<const double> growing,
          double sense, double tolerance, bool largest);

    bool asks_for(const Interval& interval) const;
  };

  /// Result of a search in one block of elements, or in all.
  struct Found {
    double low = infinity;      ///< least low end of the intervals asked for
    double early = infinity;    ///< least low end less its margin
    double needed = -infinity;  ///< an element fails at every d below this
    Index needing = no_index;   ///< the element that fails below `needed`
    /// Lowest element whose stretch is not a number.
    Index lost = std::numeric_limits<Index>::max();
    struct Island {
      Interval interval;
      Index element;
    };
    std::vector<Island> islands;  ///< intervals with two ends

    void need(double distance, Index element);
    void add(const Found& other);
  };

  template <int Dim>
  static bool is_noise(const Element& element, const double* motion, double extension);
  template <int Dim, bool Turns, class Sink>
  void visit(const Element& element, const Query& query, Sink&& sink) const;
  template <class Sink>
  void visit(std::size_t place, const Query& query, Sink&& sink) const;
  Found find(const Query& query, int threads);
  Index element_at(double distance, const Query& query) const;

  const Network& network_;
  int dim_;
  bool turns_;
  double torsion_;
  std::vector<Element> elements_;
  std::vector<Found> blocks_;
};

}  // namespace perilink
