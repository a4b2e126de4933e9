#include "discretization/meshes/mesh_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// Sine of the smallest angle of a corner. Smaller angles are round-off of coordinates, which files
/// store with 16 digits.
constexpr double straight = 1e-7;

/// Distance at which points coincide, over the extent of all points.
constexpr double same_place = 1e-9;

/// Least cosine of the turn of a curve where more than two lines meet, about 45 degrees.
constexpr double most_turn_cosine = 0.7;

constexpr std::size_t most_meeting = 100;

/// End of a line: twice the line's number, plus one at its second point.
using LineEnd = std::size_t;

constexpr LineEnd no_end = static_cast<LineEnd>(-1);

/// Returns the first point at the position of each point.
std::vector<Index> first_there(std::span<const double> points) {
  double extent = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    extent = std::max(extent, std::abs(points[k] - points[k % 3]));
  }
  const Csr near = find_upper_neighbors(points, 3, same_place * extent);
  std::vector<Index> first(points.size() / 3);
  std::iota(first.begin(), first.end(), 0);
  for (Index i = 0; i < static_cast<Index>(first.size()); ++i) {
    for (const Index j : near.row(i)) first[j] = std::min(first[j], first[i]);
  }
  return first;
}

/// Lines and their continuation in other lines.
class LineChains {
 public:
  LineChains(std::span<const double> points, std::span<const Index> lines) : points_(points) {
    if (lines.empty()) return;
    const std::vector<Index> first = first_there(points);
    std::set<std::pair<Index, Index>> known;
    for (std::size_t k = 0; k < lines.size(); k += 2) {
      const Index from = first[lines[k]], to = first[lines[k + 1]];
      if (from == to) continue;
      if (!known.insert(std::minmax(from, to)).second) {
        throw std::invalid_argument("has a line twice, one end of it at " + place_text(from));
      }
      ends_.insert(ends_.end(), {from, to});
    }
    next_.assign(ends_.size(), no_end);
    std::map<Index, std::vector<LineEnd>> meeting;
    for (LineEnd end = 0; end < ends_.size(); ++end) meeting[ends_[end]].push_back(end);
    for (const auto& [point, ends] : meeting) join(ends);
  }

  /// Follows open curves first, because a closed curve has no end.
  std::vector<std::vector<Vector3>> follow_all() {
    std::vector<std::vector<Vector3>> curves;
    std::vector<bool> used(ends_.size() / 2, false);
    for (const bool open : {true, false}) {
      for (LineEnd end = 0; end < ends_.size(); ++end) {
        if (!used[end / 2] && (!open || next_[end] == no_end)) curves.push_back(follow(end, used));
      }
    }
    return curves;
  }

 private:
  Vector3 place(LineEnd end) const { return point_of(points_, 3, ends_[end]); }

  std::string place_text(Index point) const {
    const Vector3 x = point_of(points_, 3, point);
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
  }

  /// Returns the cosine of the turn from one line into another.
  double turn(LineEnd in, LineEnd out) const {
    const Vector3 a = minus(place(in), place(in ^ 1)), b = minus(place(out ^ 1), place(out));
    return dot(a, b) / (norm(a) * norm(b));
  }

  /// Joins the ends that meet in a point in pairs, the straightest pair first.
  void join(const std::vector<LineEnd>& ends) {
    if (ends.size() > most_meeting) {
      throw std::invalid_argument(fmt::format("has {} lines that meet at ", ends.size()) +
                                  place_text(ends_[ends.front()]));
    }
    std::vector<std::tuple<double, LineEnd, LineEnd>> pairs;
    for (std::size_t a = 0; a < ends.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double cosine = turn(ends[a], ends[b]);
        if (cosine > most_turn_cosine) pairs.emplace_back(-cosine, ends[b], ends[a]);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [turned, a, b] : pairs) {
      if (next_[a] == no_end && next_[b] == no_end) connect(a, b);
    }
    std::vector<LineEnd> left;
    std::copy_if(ends.begin(), ends.end(), std::back_inserter(left),
                 [&](LineEnd end) { return next_[end] == no_end; });
    if (left.size() == 2) connect(left[0], left[1]);
  }

  void connect(LineEnd a, LineEnd b) {
    next_[a] = b;
    next_[b] = a;
  }

  std::vector<Vector3> follow(LineEnd begin, std::vector<bool>& used) const {
    std::vector<Vector3> curve = {place(begin)};
    double along = 0.0;  // length of the lines in this direction minus length of the others
    for (LineEnd end = begin; end != no_end && !used[end / 2]; end = next_[end ^ 1]) {
      used[end / 2] = true;
      const Vector3 point = place(end ^ 1);
      const double length = norm(minus(point, place(end)));
      along += end % 2 == 0 ? length : -length;
      if (curve.size() > 1) {
        const Vector3 before = minus(curve.back(), curve[curve.size() - 2]);
        const Vector3 after = minus(point, curve.back());
        const bool goes_on = dot(before, after) > 0.0;
        if (goes_on && norm(cross(before, after)) < straight * norm(before) * norm(after)) {
          curve.pop_back();
        }
      }
      curve.push_back(point);
    }
    if (along < 0.0) std::reverse(curve.begin(), curve.end());
    return curve;
  }

  std::span<const double> points_;
  std::vector<Index> ends_;    ///< point of each end of a line
  std::vector<LineEnd> next_;  ///< end of the line that continues each end
};

}  // namespace

std::vector<std::vector<Vector3>> curves_of(std::span<const double> points,
                                            std::span<const Index> lines) {
  return LineChains(points, lines).follow_all();
}

}  // namespace perilink
