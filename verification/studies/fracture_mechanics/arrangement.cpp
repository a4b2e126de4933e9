#include "arrangement.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <vector>

#include <unistd.h>

namespace perilink::verification {
namespace {

using Point = std::array<double, 2>;
using Cell = std::array<int, 3>;

/// Neighbours right on the horizon count on every lattice.
constexpr double beyond = 1.005;

/// Vertices this near to a side of the rectangle move onto it, in spacings: less than half of the
/// largest distance of two neighbours across it, or both would land on one point.
constexpr double snap = 0.43;

std::string temporary(const std::string& termination) {
  static int count = 0;
  const std::filesystem::path folder = temporary_folder();
  std::filesystem::create_directories(folder);
  return (folder / fmt::format("{}.{}", count++, termination)).string();
}

class TurnedLattice {
 public:
  TurnedLattice(const Arrangement& arrangement, double spacing, double width, double height)
      : spacing_(spacing), row_(row_of(arrangement)), size_{width, height} {
    const double angle = arrangement.degrees * std::numbers::pi / 180.0;
    cos_ = std::cos(angle);
    sin_ = std::sin(angle);
    const int reach = static_cast<int>(1.2 * std::hypot(width, height) / (spacing * row_)) + 2;
    for (int j = -reach; j < reach; ++j) {
      for (int i = -reach; i < reach; ++i) {
        if (arrangement.hexagonal && j % 2 != 0) {
          add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
          add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        } else {
          add({{{i, j}, {i + 1, j}, {i, j + 1}}});
          add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
      }
    }
    shift_ = arrangement.hexagonal ? 0.5 : 0.0;
    keep_inside();
  }

  /// As gmsh writes meshes, format 4.1.
  std::string text() const {
    std::string nodes, places, elements;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      nodes += fmt::format("{}\n", k + 1);
      places += fmt::format("{:.12g} {:.12g} 0\n", points_[k][0], points_[k][1]);
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const Cell& c = cells_[k];
      elements += fmt::format("{} {} {} {}\n", k + 1, c[0] + 1, c[1] + 1, c[2] + 1);
    }
    return fmt::format(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 {0} {1} 0 0 0\n"
        "$EndEntities\n$Nodes\n1 {2} 1 {2}\n2 1 0 {2}\n{3}{4}$EndNodes\n$Elements\n1 {5} 1 {5}\n"
        "2 1 2 {5}\n{6}$EndElements\n",
        size_[0], size_[1], points_.size(), nodes, places, cells_.size(), elements);
  }

 private:
  using Corner = std::array<int, 2>;  ///< column and row of the lattice
  void add(const std::array<Corner, 3>& triangle) { triangles_.push_back(triangle); }

  Point place(const Corner& corner) const {
    const double x = spacing_ * (corner[0] + (corner[1] % 2 != 0 ? shift_ : 0.0));
    const double y = spacing_ * row_ * corner[1];
    // A point of no symmetry of the lattice lies in the middle.
    Point p = {0.5 * size_[0] + 0.31 * spacing_ + cos_ * x - sin_ * y,
               0.5 * size_[1] + 0.27 * spacing_ + sin_ * x + cos_ * y};
    for (int a = 0; a < 2; ++a) {
      for (const double side : {0.0, size_[a]}) {
        if (std::abs(p[a] - side) < snap * spacing_) p[a] = side;
      }
    }
    return p;
  }
  bool inside(const Point& p) const {
    return p[0] >= 0.0 && p[0] <= size_[0] && p[1] >= 0.0 && p[1] <= size_[1];
  }
  void keep_inside() {
    std::map<Corner, int> number;
    for (const auto& triangle : triangles_) {
      std::array<Point, 3> p;
      for (int k = 0; k < 3; ++k) p[k] = place(triangle[k]);
      if (!inside(p[0]) || !inside(p[1]) || !inside(p[2])) continue;
      const double area =
          (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
      if (area < 0.01 * spacing_ * spacing_) continue;  // all three on one side
      Cell cell{};
      for (int k = 0; k < 3; ++k) {
        const auto [at, is_new] = number.emplace(triangle[k], static_cast<int>(points_.size()));
        if (is_new) points_.push_back(p[k]);
        cell[k] = at->second;
      }
      cells_.push_back(cell);
    }
  }

  double spacing_, row_, shift_ = 0.0, cos_ = 1.0, sin_ = 0.0;
  Point size_;
  std::vector<std::array<Corner, 3>> triangles_;
  std::vector<Point> points_;
  std::vector<Cell> cells_;
};

std::string write_geometry(int algorithm, double width, double height) {
  const std::string name = temporary("geo");
  std::ofstream(name) << fmt::format(
      "Mesh.Algorithm = {2};\nDefineConstant[ h = 1 ];\nPoint(1) = {{0, 0, 0, h}};\nPoint(2) = "
      "{{{0}, 0, 0, h}};\n"
      "Point(3) = {{{0}, {1}, 0, h}};\nPoint(4) = {{0, {1}, 0, h}};\nLine(1) = {{1, 2}};\n"
      "Line(2) = {{2, 3}};\nLine(3) = {{3, 4}};\nLine(4) = {{4, 1}};\n"
      "Curve Loop(1) = {{1, 2, 3, 4}};\nPlane Surface(1) = {{1}};\n"
      "Physical Surface(\"plate\") = {{1}};\n",
      width, height, algorithm);
  return name;
}

}  // namespace

std::string temporary_folder() {
  return (std::filesystem::temp_directory_path() / fmt::format("fracture_mechanics_{}", getpid()))
      .string();
}

std::string name_of(const Arrangement& arrangement) {
  if (arrangement.kind == Arrangement::Kind::particle_set)
    return fmt::format("cloud {}", arrangement.algorithm);
  if (arrangement.kind == Arrangement::Kind::unstructured) return "unstructured";
  const std::string pattern = arrangement.hexagonal ? "hexagonal" : "rectangular";
  if (arrangement.kind == Arrangement::Kind::lattice) return pattern;
  return fmt::format("{} turned {}", pattern, arrangement.degrees);
}

double row_of(const Arrangement& arrangement) {
  return arrangement.hexagonal ? std::sqrt(0.75) : 1.0;
}

std::string body_keys(const Arrangement& arrangement, double spacing, double horizon_ratio,
                      double width, double height) {
  const std::string horizon = fmt::format("horizon = {}\n", beyond * horizon_ratio * spacing);
  switch (arrangement.kind) {
    case Arrangement::Kind::lattice:
      return fmt::format("pattern = \"{}\"\nspacing = {}\n{}",
                         arrangement.hexagonal ? "hexagonal" : "rectangular", spacing, horizon);
    case Arrangement::Kind::turned: {
      const std::string name = temporary("msh");
      std::ofstream(name) << TurnedLattice(arrangement, spacing, width, height).text();
      return fmt::format("mesh = \"{}\"\n{}", name, horizon);
    }
    case Arrangement::Kind::unstructured:
      return fmt::format(
          "pattern = \"unstructured\"\nseed = {}\nspacing = {}\nhorizon_ratio = {}\n",
          arrangement.sample, spacing, horizon_ratio);
    case Arrangement::Kind::particle_set: break;
  }
  return fmt::format("mesh = \"{}\"\nmesh_size = {}\nhorizon_ratio = {}\n",
                     write_geometry(arrangement.algorithm, width, height), spacing, horizon_ratio);
}

}  // namespace perilink::verification
