#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Search for load factors at which elements pass their limits. The displacements are u + d v, the
/// present ones and d times those by loads that grow. The stretch over its limit of a truss is
/// linear in d, the square of the equivalent one of a micropolar bond (FrameLimitSearch) quadratic.
/// An element fails in one or two open intervals of d. Extensions that are nothing but round-off of
/// the motion of their ends do not grow.
class CrossingSearch {
 public:
  explicit CrossingSearch(const Network& network);

  /// The end of an interval: where an element passes its limit as d moves on.
  struct Crossing {
    Index element = no_index;          ///< no_index: there is none
    double distance = 0.0;             ///< d
    std::vector<Index> conflict = {};  ///< where no d lets all hold: elements that shut them out
  };

  /// From u onwards the first at which an element begins to fail; of those that do within
  /// `tolerance` of their limits the lowest element. Those that fail in u already are passed over.
  /// \param sense  1: d grows, -1: it falls; `distance` has this sign
  Crossing ahead(std::span<const double> now, std::span<const double> growing, int sense,
                 double tolerance, int threads);

  /// The largest d at which no element fails, with the element that fails beyond it. Infinite
  /// without an element: none fails however large it is. Minus infinity without: there is no such
  /// d.
  Crossing largest(std::span<const double> now, std::span<const double> growing, double tolerance,
                   int threads);

  /// BreakSearch::set_limit().
  void set_limit(Index element, double limit);

 private:
  struct Element {
    Index number, first, second;  ///< particles times width
    double n[3];
    double first_arm, second_arm;        ///< from the ends to the inflection [length]
    double shear_share, rotation_share;  ///< as FrameLimitSearch::Bond has them
    double length;                       ///< [length]
    double inverse;                      ///< 1 / (xi s) of the limit s; zero without
    bool both;                           ///< Sense::both
  };
  /// Values of d between which an element fails; it is within the tolerance of its limit as far as
  /// `margin` outside.
  struct Interval {
    double low, high, margin;
  };

  struct Query {
    const double* now;
    const double* growing;
    double sense;  ///< 1 or -1: of the growing displacements
    double tolerance;
    bool largest;  ///< what is asked for is largest(), not ahead()
    double noise;  ///< growing extensions above this are no round-off [length]

    Query(std::span<const double> now, std::span<const double> growing, double sense,
          double tolerance, bool largest);

    bool asks_for(const Interval& interval) const;
  };

  /// What is found in a block of elements, or in all.
  struct Found {
    double low = infinity;      ///< least low end of the intervals that are asked for ...
    double early = infinity;    ///< ... less the margin
    double needed = -infinity;  ///< below this d an element fails, whatever comes ...
    Index needing = no_index;   ///< ... this one
    Index lost = std::numeric_limits<Index>::max();  ///< lowest element whose stretch is no number
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

  int dim_;
  bool turns_;
  double torsion_;
  std::vector<Element> elements_;
  std::vector<Found> blocks_;
};

}  // namespace perilink
