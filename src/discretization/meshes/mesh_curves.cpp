#include "discretization/meshes/mesh_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"

namespace perilink {
namespace {

/// Sine of the angle below which a corner is round-off of coordinates, which files keep to 16
/// digits.
constexpr double straight = 1e-7;

/// Where more than two lines meet one goes on in another that turns by less than about 45 degrees.
constexpr double most_turn_cosine = 0.7;

/// End of a line: twice its number, and one at its second point.
using LineEnd = std::size_t;

constexpr LineEnd no_end = static_cast<LineEnd>(-1);

/// The lines of a group and how they go on.
class LineChains {
 public:
  LineChains(const Mesh& mesh, const MeshGroup& group) : mesh_(mesh) {
    const std::vector<Index>& lines = mesh.dim == 2 ? mesh.facets : mesh.lines;
    for (const Index element : group.elements) {
      const Index from = lines[2 * static_cast<std::size_t>(element)];
      const Index to = lines[2 * static_cast<std::size_t>(element) + 1];
      if (from != to) points_.insert(points_.end(), {from, to});
    }
    next_.assign(points_.size(), no_end);
    std::map<Index, std::vector<LineEnd>> meeting;
    for (LineEnd end = 0; end < points_.size(); ++end) meeting[points_[end]].push_back(end);
    for (const auto& [point, ends] : meeting) join(ends);
  }

  /// Open curves first: a closed one has no end to begin at.
  std::vector<std::vector<Vector3>> follow_all() {
    std::vector<std::vector<Vector3>> curves;
    std::vector<bool> used(points_.size() / 2, false);
    for (const bool open : {true, false}) {
      for (LineEnd end = 0; end < points_.size(); ++end) {
        if (!used[end / 2] && (!open || next_[end] == no_end)) curves.push_back(follow(end, used));
      }
    }
    return curves;
  }

 private:
  Vector3 place(LineEnd end) const { return point_of(mesh_.positions, mesh_.dim, points_[end]); }

  /// Cosine of the angle by which a way turns that comes along one line and leaves along another.
  double turn(LineEnd in, LineEnd out) const {
    const Vector3 a = minus(place(in), place(in ^ 1)), b = minus(place(out ^ 1), place(out));
    return dot(a, b) / (norm(a) * norm(b));
  }

  /// Joins the ends that meet in a point by pairs, the straightest first.
  void join(const std::vector<LineEnd>& ends) {
    std::vector<std::tuple<double, LineEnd, LineEnd>> pairs;
    for (std::size_t a = 0; a < ends.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double cosine = turn(ends[a], ends[b]);
        if (ends.size() == 2 || cosine > most_turn_cosine) {
          pairs.emplace_back(-cosine, ends[b], ends[a]);
        }
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [turned, a, b] : pairs) {
      if (next_[a] != no_end || next_[b] != no_end) continue;
      next_[a] = b;
      next_[b] = a;
    }
  }

  std::vector<Vector3> follow(LineEnd begin, std::vector<bool>& used) const {
    std::vector<Vector3> curve = {place(begin)};
    for (LineEnd end = begin; end != no_end && !used[end / 2]; end = next_[end ^ 1]) {
      used[end / 2] = true;
      const Vector3 point = place(end ^ 1);
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
    return curve;
  }

  const Mesh& mesh_;
  std::vector<Index> points_;  ///< per end of a line
  std::vector<LineEnd> next_;  ///< end of another line that each end goes on in
};

}  // namespace

std::vector<std::vector<Vector3>> curves_of(const Mesh& mesh, const MeshGroup& group) {
  return LineChains(mesh, group).follow_all();
}

}  // namespace perilink
