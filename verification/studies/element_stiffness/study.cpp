#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

using Node = std::array<int, 2>;  ///< place on the grid of nodes, h / order apart

/// A point of the plane with the shape functions of its element, whose sides are one long.
struct Point {
  Point(double x, double y, int order) : at{x, y} {
    std::array<int, 2> cell{};
    std::array<std::array<double, 3>, 2> along{};
    for (int a = 0; a < 2; ++a) {
      cell[a] = static_cast<int>(std::floor(at[a] + 1e-9));
      const double t = order * (at[a] - cell[a]);
      for (int n = 0; n <= order; ++n) {
        along[a][n] = 1.0;
        for (int k = 0; k <= order; ++k) {
          if (k != n) along[a][n] *= (t - k) / static_cast<double>(n - k);
        }
      }
    }
    for (int i = 0; i <= order; ++i) {
      for (int j = 0; j <= order; ++j) {
        nodes.push_back({{order * cell[0] + i, order * cell[1] + j}, along[0][i] * along[1][j]});
      }
    }
  }

  std::array<double, 2> at;
  std::vector<std::pair<Node, double>> nodes;
};

/// Stiffness of the nodes of one element against all others in an endless body: by node of the
/// element, way to the other one, and the components xx, xy, yy.
class Stencil {
 public:
  explicit Stencil(int order) : order_(order) {}

  /// Half of the bond between two points, so that all bonds of the points in one element are the
  /// bonds of the element.
  void add(const Point& from, const Point& to, double stiffness) {
    const double dx = to.at[0] - from.at[0], dy = to.at[1] - from.at[1];
    const double square = dx * dx + dy * dy;
    const std::array<double, 3> n = {dx * dx / square, dx * dy / square, dy * dy / square};
    std::vector<std::pair<Node, double>> motion = to.nodes;
    for (const auto& [node, weight] : from.nodes) motion.emplace_back(node, -weight);
    for (const auto& [a, wa] : motion) {
      const int home_x = a[0] - wrap(a[0]), home_y = a[1] - wrap(a[1]);
      for (const auto& [b, wb] : motion) {
        auto& entry = entries_[{a[0] - home_x, a[1] - home_y, b[0] - home_x, b[1] - home_y}];
        for (int c = 0; c < 3; ++c) entry[c] += 0.5 * stiffness * wa * wb * n[c];
      }
    }
    energy_ += 0.25 * stiffness * dx * dx * n[0];  // under a unit strain along x alone
  }

  /// Both as stiff against a uniform strain, the Frobenius norm of the difference over that of the
  /// other.
  double difference(const Stencil& other) const {
    double square = 0.0, whole = 0.0;
    const auto add_square = [](double& sum, const std::array<double, 3>& entry, double scale) {
      sum += scale * (entry[0] * entry[0] + 2.0 * entry[1] * entry[1] + entry[2] * entry[2]);
    };
    for (const auto& [key, entry] : entries_) {
      std::array<double, 3> gap{};
      const auto found = other.entries_.find(key);
      for (int c = 0; c < 3; ++c) {
        gap[c] = entry[c] / energy_ -
                 (found != other.entries_.end() ? found->second[c] / other.energy_ : 0.0);
      }
      add_square(square, gap, 1.0);
    }
    for (const auto& [key, entry] : other.entries_) {
      add_square(whole, entry, 1.0 / (other.energy_ * other.energy_));
      if (!entries_.contains(key)) add_square(square, entry, 1.0 / (other.energy_ * other.energy_));
    }
    return std::sqrt(square / whole);
  }

 private:
  int wrap(int place) const { return ((place % order_) + order_) % order_; }

  int order_;
  std::map<std::array<int, 4>, std::array<double, 3>> entries_;
  double energy_ = 0.0;
};

/// How particles stand in an element, and where their bonds end.
struct Lattice {
  double offset;  ///< from the side of the element to the first particle, in spacings
  bool ramps;     ///< bonds fade over one spacing around the horizon, with the part of the volume
                  ///< inside (Hu, Ha & Bobaru 2010), and do not end at once
};

/// Particles on a square lattice, `count` along each side of an element.
Stencil of_particles(double horizon, int order, int count, const Lattice& lattice) {
  Stencil stencil(order);
  const double spacing = 1.0 / count;
  const double fade = lattice.ramps ? 0.5 * spacing : 0.0;
  const double end = (horizon + fade) * (1.0 + 1e-9);
  const int reach = static_cast<int>(std::floor(end / spacing));
  const auto place = [&](int number) { return (number + lattice.offset) * spacing; };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const Point from(place(i), place(j), order);
      for (int k = -reach; k <= reach; ++k) {
        for (int l = -reach; l <= reach; ++l) {
          const double length = spacing * std::hypot(k, l);
          if (length == 0.0 || length > end) continue;
          const double part =
              lattice.ramps ? std::clamp((horizon + fade - length) / spacing, 0.0, 1.0) : 1.0;
          stencil.add(from, {place(i + k), place(j + l), order}, part / length);
        }
      }
    }
  }
  return stencil;
}

/// Points and weights of Gauss's rule on [0, 1].
std::vector<std::array<double, 2>> gauss(int count) {
  std::vector<std::array<double, 2>> rule;
  for (int k = 0; k < count; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), slope = 1.0;
    for (int step = 0; step < 50; ++step) {
      double value = 1.0, last = 0.0;
      for (int n = 1; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * last) / n;
        last = std::exchange(value, next);
      }
      slope = count * (x * value - last) / (x * x - 1.0);
      x -= value / slope;
    }
    rule.push_back({0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return rule;
}

/// The double integral: Gauss's points in the element, around each a disc in angles, whose first is
/// random, and Gauss's radii.
Stencil of_continuum(double horizon, int order, int outer, int angles, int radii) {
  Stencil stencil(order);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> phase(0.0, 1.0);
  const auto points = gauss(outer), along = gauss(radii);
  for (const auto& [x, wx] : points) {
    for (const auto& [y, wy] : points) {
      const Point from(x, y, order);
      const double first = phase(random);
      for (int a = 0; a < angles; ++a) {
        const double angle = 2.0 * std::numbers::pi * (a + first) / angles;
        for (const auto& [r, wr] : along) {
          const double length = r * horizon;  // 1 / length of the bond and length dr cancel
          stencil.add(from, {x + length * std::cos(angle), y + length * std::sin(angle), order},
                      wx * wy * wr);
        }
      }
    }
  }
  return stencil;
}

}  // namespace

/// How many particles an element needs to be as stiff as the double integral over pairs of
/// elements: into result.csv.
bool run_program(const std::vector<std::string>& /*arguments*/) {
  std::string table =
      "order,element_over_horizon,particles_per_side,horizon_ratio,on_sides,on_sides_ramp,inside,"
      "inside_ramp\n";
  for (const int order : {1, 2}) {
    for (const double size : {1.0 / 3.0, 1.0, 3.0}) {
      const double horizon = 1.0 / size;
      const int outer = size < 1.0 ? 12 : 24;
      const Stencil exact = of_continuum(horizon, order, outer, size < 1.0 ? 360 : 90, 24);
      const Stencil again = of_continuum(horizon, order, outer - 3, size < 1.0 ? 270 : 70, 20);
      fmt::print("order {}, h = {:.3g} horizons: reference to {:.1e}\n", order, size,
                 again.difference(exact));
      for (const int count : {1, 2, 3, 4, 5, 6, 8, 9, 12, 18, 24}) {
        const double ratio = count * horizon;
        if (ratio < 2.0 || ratio > 40.0) continue;
        table += fmt::format("{},{:.4g},{},{:.4g}", order, size, count, ratio);
        for (const Lattice& lattice :
             {Lattice{0.0, false}, {0.0, true}, {0.5, false}, {0.5, true}}) {
          const Stencil stencil = of_particles(horizon, order, count, lattice);
          table += fmt::format(",{:.5f}", stencil.difference(exact));
        }
        table += "\n";
      }
    }
  }
  write_result(PERILINK_STUDY_DIR, table);
  return true;
}

}  // namespace perilink::verification
