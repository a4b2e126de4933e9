// Pieces that only closed faces hold: a body separates only if no contact can hold it
// (docs/theory/softening.md, section 8).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double gap = 0.01;

/// A slice between two cracks, pressed on the lower face by 10 N. Then the upper part is lifted by
/// `gap`, and the slice pushed up by the same force.
std::string slice() {
  const auto region = [](const char* name, double left, double right, double from, double to) {
    return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, left,
                       right, from, to);
  };
  return "[body]\nproblem = \"plane_stress\"\nspacing = 1\nhorizon_ratio = 2\n" +
         region("block", 0, 8, 0, 13) + region("slice", 0, 8, 5, 8) + region("guide", 4, 4, 5, 8) +
         region("base", 0, 8, 0, 0) + region("top", 0, 8, 13, 13) +
         fmt::format(
             "[[materials]]\nregion = \"block\"\nyoungs_modulus = 30000\nfracture_energy = 1e6\n"
             "[[cracks]]\npoints = [[-1, 4.5], [9, 4.5]]\nclosing = true\n"
             "[[cracks]]\npoints = [[-1, 8.5], [9, 8.5]]\nclosing = true\n"
             "[[supports]]\nregion = \"base\"\nfix = [\"x\", \"y\"]\n"
             "[[supports]]\nregion = \"guide\"\nfix = [\"x\"]\n"
             "[[displacements]]\nregion = \"top\"\nx = 0\ny = 1\nstage = \"lift\"\n"
             "[[loads]]\nregion = \"slice\"\nforce = [0, 1]\nstage = \"push\"\n"
             "[[springs]]\nregion = \"top\"\nstiffness = [20, 20]\n"
             "[[stages]]\nname = \"push\"\nto_load = -10\n"
             "[[stages]]\nname = \"lift\"\nto = {}\n"
             "[[stages]]\nname = \"back\"\nloads = \"push\"\nto_load = 10\n"
             "[[gauges]]\nname = \"slice\"\nat = [4, 6]\naxis = \"y\"\n"
             "[analysis]\ntype = \"damage\"\n",
             gap);
}

/// A slice that leaves one face moves through the gap and rests on the other face.
TEST(PressedHalves, ASliceGoesFromOneFaceToTheOther) {
  const WholeRun run(slice());
  ASSERT_EQ(run.summary.json.at("status"), "completed") << run.summary.json.dump(1);
  EXPECT_LT(run.summary.json.at("energy_error").get<double>(), 1e-10);
  const std::vector<double> height = run.history("slice"), stage = run.history("stage");
  const auto end_of = [&](double number) {
    return height[std::ranges::find(stage, number + 1.0) - stage.begin() - 1];
  };
  EXPECT_NEAR(end_of(2.0), end_of(1.0), 1e-12);  // the upper part leaves it where it is
  EXPECT_NEAR(height.back(), gap - end_of(1.0), 0.2 * std::abs(end_of(1.0)));
}

/// Block in space whose lower face is clamped. A crack leaves one corner of a cross-section whole.
struct Block {
  std::string name;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  double unit = 1.0;
  std::string softening = "";

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return unit * (turn * x); }
};

constexpr std::array<int, 3> steps = {3, 6, 3};

/// Writes a mesh with the groups 1 "base", 2 "top" and 3 "block", of points shifted by up to a
/// twentieth of a step.
void write_mesh(const Block& block, const std::string& path) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  std::vector<Eigen::Vector3d> points;
  const auto number = [](const std::array<int, 3>& p) {
    return p[0] + (steps[0] + 1) * (p[1] + (steps[1] + 1) * p[2]);
  };
  std::array<int, 3> p{};
  const auto for_each = [&](int beyond, auto visit) {
    for (p[2] = 0; p[2] < steps[2] + beyond; ++p[2]) {
      for (p[1] = 0; p[1] < steps[1] + beyond; ++p[1]) {
        for (p[0] = 0; p[0] < steps[0] + beyond; ++p[0]) visit();
      }
    }
  };
  for_each(1, [&] {
    Eigen::Vector3d x;
    for (int a = 0; a < 3; ++a) {
      x[a] = p[a] + (p[a] > 0 && p[a] < steps[a] ? shift(random) : 0.0);
    }
    points.push_back(block.at(x));
  });
  std::vector<std::string> elements;
  const auto add = [&](int type, int group, const std::vector<int>& corners) {
    std::string line = fmt::format("{} {} 2 {} {}", elements.size() + 1, type, group, group);
    for (const int c : corners) line += fmt::format(" {}", c + 1);
    elements.push_back(line);
  };
  for_each(0, [&] {
    std::array<int, 3> order = {0, 1, 2};
    do {  // each path along the edges to the opposite corner is a tetrahedron
      std::array<int, 3> q = p;
      std::vector<int> cell = {number(q)};
      for (const int axis : order) {
        ++q[axis];
        cell.push_back(number(q));
      }
      add(4, 3, cell);
    } while (std::ranges::next_permutation(order).found);
    for (const int end : {0, steps[1]}) {
      if (p[1] != 0) continue;
      const int i = p[0], k = p[2];
      const int a = number({i, end, k}), b = number({i + 1, end, k + 1});
      add(2, end == 0 ? 1 : 2, {a, number({i + 1, end, k}), b});
      add(2, end == 0 ? 1 : 2, {a, number({i, end, k + 1}), b});
    }
  });
  std::ofstream file(path);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"base\"\n2 2 \"top\"\n"
       << "3 3 \"block\"\n$EndPhysicalNames\n$Nodes\n"
       << points.size() << "\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    file << fmt::format("{} {} {} {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
  }
  file << "$EndNodes\n$Elements\n" << elements.size() << "\n";
  for (const std::string& line : elements) file << line << "\n";
  file << "$EndElements\n";
}

/// The block is pressed down, turned a little and broken by 120 bonds.
std::string text_of(const Block& block, const std::string& mesh) {
  const auto numbers = [](const Eigen::Vector3d& x) {
    return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]);
  };
  const auto crack = [&](const std::vector<std::array<double, 2>>& corners) {
    std::string text = "[[cracks]]\nclosing = true\ncorners = [";
    for (const auto& [x, z] : corners) text += numbers(block.at({x, 3.5, z})) + ", ";
    return text + "]\n";
  };
  std::string text = fmt::format(
      "[body]\nmesh = \"{}\"\nproblem = \"three_dimensional\"\nhorizon_ratio = 2.3\n"
      "surface = \"none\"\ncritical_stretch = \"continuum\"\n",
      mesh);
  for (const char* group : {"block", "base", "top"}) {
    text += fmt::format("[[regions]]\nname = \"{}\"\ngroup = \"{}\"\n", group, group);
  }
  const Eigen::Vector3d motion = block.at({0.2, -1.0, -0.5});
  return text +
         fmt::format(
             "[[materials]]\nregion = \"block\"\nyoungs_modulus = 30000\nfracture_energy = {}\n"
             "closing = true\n{}",
             0.02 * block.unit, block.softening) +
         crack({{-1, -1}, {2.5, -1}, {2.5, 5}, {-1, 5}}) +
         crack({{2.5, -1}, {5, -1}, {5, 2.5}, {2.5, 2.5}}) +
         fmt::format(
             "[[supports]]\nregion = \"base\"\nfix = [\"x\", \"y\", \"z\"]\n"
             "[[displacements]]\nregion = \"top\"\nx = {}\ny = {}\nz = {}\n"
             "[analysis]\ntype = \"damage\"\nevent_tolerance = 0\n[stop]\nbroken_bonds = 120\n",
             motion[0], motion[1], motion[2]);
}

class PressedBlock : public testing::TestWithParam<std::string> {};

/// Twins differ by round-off only. What it decides must not end a run.
TEST_P(PressedBlock, GoesOnHoweverItLies) {
  const Eigen::Matrix3d oblique =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, -0.7, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d mirror = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  const Block blocks[] = {{"as it is", Eigen::Matrix3d::Identity(), 1.0, GetParam()},
                          {"turned", oblique, 1.0, GetParam()},
                          {"mirrored", oblique * mirror, 1.0, GetParam()},
                          {"thousandfold", oblique, 1000.0, GetParam()}};
  double peak = 0.0;
  for (const Block& block : blocks) {
    SCOPED_TRACE(block.name);
    const std::string mesh =
        TemporaryDirectory().path().string() + ".msh";  // beside that of the run
    write_mesh(block, mesh);
    const WholeRun run(text_of(block, mesh));
    std::filesystem::remove(mesh);
    const auto& json = run.summary.json;
    EXPECT_EQ(json.at("status"), "completed") << json.at("reason");
    const double own = json.at("peak_load").get<double>() / (block.unit * block.unit);
    if (peak == 0.0) peak = own;
    EXPECT_NEAR(own, peak, 1e-6 * peak);
    EXPECT_LT(json.at("energy_error").get<double>(), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, PressedBlock, testing::Values("", "tensile_strength = 3\n"));

}  // namespace
}  // namespace perilink
