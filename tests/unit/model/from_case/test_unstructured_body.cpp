#include "model/from_case/unstructured_body.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "io/mesh/gmsh_mesher.hpp"
#include "model/from_case/configure.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using ::testing::HasSubstr;

/// A plate of 2 by 1 with a hole, of three boxes in a row, and a disc of another material.
constexpr const char* plate_text = R"(regions = [
  {name = "left", x = [0, 0.5], y = [0, 1]},
  {name = "middle", x = [0.5, 1.5], y = [0, 1]},
  {name = "right", x = [1.5, 2], y = [0, 1]},
  {name = "hole", center = [0.5, 0.5], radius = 0.2},
  {name = "disc", center = [1.5, 0.5], radius = 0.3},
  {name = "end", x = [0, 0], y = [0, 1]},
]
[body]
pattern = "unstructured"
spacing = 0.05
horizon_ratio = 3
thickness = 2

[[materials]]
regions = ["left", "middle", "right"]
holes = ["hole"]
youngs_modulus = 100
fracture_energy = 1

[[materials]]
region = "disc"
youngs_modulus = 10
fracture_energy = 1

[[supports]]
region = "end"
fix = ["x", "y"]

[[loads]]
region = "right"
force = [1, 0]
)";

/// A block with a ball of another material and a bore along y.
constexpr const char* block_text = R"(regions = [
  {name = "block", x = [0, 1], y = [-0.5, 0.5], z = [0, 1]},
  {name = "ball", center = [0.6, 0, 0.6], radius = 0.3},
  {name = "bore", center = [0.2, 0.2], radius = 0.15, y = [-1, 1]},
  {name = "base", x = [0, 1], y = [-0.5, 0.5], z = [0, 0]},
]
[body]
problem = "three_dimensional"
pattern = "unstructured"
spacing = 0.125
horizon_ratio = 2
surface = "none"

[[materials]]
region = "block"
holes = ["bore"]
youngs_modulus = 100
fracture_energy = 1

[[materials]]
region = "ball"
youngs_modulus = 10
fracture_energy = 1

[[supports]]
region = "base"
fix = ["x", "y", "z"]

[[loads]]
region = "ball"
force = [1, 0, 0]
)";

class UnstructuredBody : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  }

  static Body body_of(const std::string& text) {
    const CaseFile input = parse_case(text, "case.toml");
    return make_unstructured_body(input, input.body.problem == Problem::three_dimensional ? 3 : 2,
                                  *input.body.spacing);
  }
  static std::string refusal(const std::string& text) {
    try {
      body_of(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  static double volume(const Body& body) {
    return std::accumulate(body.particles.volumes.begin(), body.particles.volumes.end(), 0.0);
  }
  /// Area of a polygon that a circle is divided into by particles on it.
  static double polygon(double radius, Index corners) {
    return 0.5 * corners * radius * radius * std::sin(2.0 * std::numbers::pi / corners);
  }
  static Index count_at(const Particles& particles, const std::vector<double>& centre,
                        double radius) {
    Index count = 0;
    for (Index i = 0; i < particles.size(); ++i) {
      const auto x = particles.position(i);
      count += std::abs(std::hypot(x[0] - centre[0], x[1] - centre[1]) - radius) < 1e-6 ? 1 : 0;
    }
    return count;
  }
};

/// A body in millimetres and in metres has the same particles.
TEST_F(UnstructuredBody, HasTheSameParticlesInEveryUnit) {
  const auto plate = [](double unit) {
    const Body body =
        body_of(fmt::format(R"(regions = [
  {{name = "plate", x = [0, {}], y = [0, {}]}},
  {{name = "hole", center = [{}, {}], radius = {}}},
]
[body]
pattern = "unstructured"
spacing = {}
horizon_ratio = 3
[[materials]]
region = "plate"
holes = ["hole"]
youngs_modulus = 100
[[loads]]
region = "plate"
force = [1, 0]
[analysis]
type = "elastic"
)",
                            100 * unit, 140 * unit, 40 * unit, 70 * unit, 11 * unit, 2.9 * unit));
    return body.particles.positions;
  };
  const std::vector<double> small = plate(0.001), large = plate(1.0);
  ASSERT_EQ(small.size(), large.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < small.size(); ++k) {
    worst = std::max(worst, std::abs(1000.0 * small[k] - large[k]));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST_F(UnstructuredBody, FillsThePlateUpToItsFaces) {
  const Body body = body_of(plate_text);
  const Particles& particles = body.particles;
  EXPECT_EQ(body.lattice.pattern, Pattern::irregular);
  EXPECT_NEAR(body.lattice.spacing, 0.05, 0.06 * 0.05);  // sizes at corners vary by 5 %
  const Index corners = count_at(particles, {0.5, 0.5}, 0.2);
  EXPECT_NEAR(corners, 2.0 * std::numbers::pi * 0.2 / 0.05, 2.0);
  EXPECT_NEAR(volume(body), 2.0 * (2.0 - polygon(0.2, corners)), 1e-6);  // gmsh's kernel: 1e-7
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}}) {
    bool found = false;
    for (Index i = 0; i < particles.size(); ++i) {
      found = found || (particles.position(i)[0] == x && particles.position(i)[1] == y);
    }
    EXPECT_TRUE(found) << x << ", " << y;
  }
  const std::vector<double> edges = edges_of(body.cells, particles).lengths;
  EXPECT_GT(*std::min_element(edges.begin(), edges.end()), 0.35 * 0.05);
  EXPECT_LT(*std::max_element(edges.begin(), edges.end()), 1.8 * 0.05);
}

TEST_F(UnstructuredBody, KeepsMaterialsApart) {
  const Body body = body_of(plate_text);
  const Particles& particles = body.particles;
  Index on_joint = 0;
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    const double from_disc = std::hypot(x[0] - 1.5, x[1] - 0.5) - 0.3;
    EXPECT_EQ(particles.material[i], from_disc < 1e-6 ? 1 : 0);
    EXPECT_GT(std::hypot(x[0] - 0.5, x[1] - 0.5), 0.2 - 1e-6) << "in the hole";
    on_joint += x[0] == 1.5 || x[0] == 0.5 ? 1 : 0;
  }
  // Faces between boxes of one material end in two corners each, but carry no row of particles.
  EXPECT_LE(on_joint, 6);
  double around = 0.0;
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (body.facets.on_surface(f)) continue;
    EXPECT_EQ(body.facets.inside[f], 0);
    EXPECT_EQ(body.facets.outside[f], 1);
    const auto normal = body.facets.area_vector(f);
    around += std::hypot(normal[0], normal[1]) / 2.0;  // thickness
  }
  EXPECT_NEAR(around, 2.0 * std::numbers::pi * 0.3, 0.02);  // chords of a spacing: 0.1 % shorter
}

TEST_F(UnstructuredBody, FillsBodiesInSpace) {
  const Body body = body_of(block_text);
  const Particles& particles = body.particles;
  const double bore = std::numbers::pi * 0.15 * 0.15;
  EXPECT_NEAR(volume(body), 1.0 - bore, 0.15 * bore);  // seven chords: 13 % less than the circle
  Index on_ball = 0, on_base = 0;
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    const double from_ball = std::hypot(x[0] - 0.6, x[1], x[2] - 0.6) - 0.3;
    EXPECT_EQ(particles.material[i], from_ball < 1e-6 ? 1 : 0);
    on_ball += std::abs(from_ball) < 1e-6 ? 1 : 0;
    on_base += x[2] == 0.0 ? 1 : 0;
    EXPECT_GT(std::hypot(x[0] - 0.2, x[2] - 0.2), 0.15 - 1e-6);
  }
  EXPECT_GT(on_ball, 40);
  EXPECT_GT(on_base, 60);
  EXPECT_NEAR(body.lattice.spacing, 0.125, 0.15 * 0.125);  // coarse: finer beside curved faces
}

TEST_F(UnstructuredBody, DependsOnTheSeedOnly) {
  for (const std::string text : {plate_text, block_text}) {
    const Body one = body_of(text), same = body_of(text);
    EXPECT_EQ(one.particles.positions, same.particles.positions);
    EXPECT_EQ(one.cells.vertices, same.cells.vertices);
    const Body other = body_of(replaced(text, "pattern =", "seed = 2\npattern ="));
    EXPECT_NE(one.particles.positions, other.particles.positions);
  }
}

TEST_F(UnstructuredBody, DoesNotDependOnTheUnitOfLength) {
  const auto square = [](double side) {
    return fmt::format(
        "regions = [{{name = \"square\", x = [0, {0}], y = [0, {0}]}}]\n[body]\n"
        "pattern = \"unstructured\"\nspacing = {1}\nhorizon_ratio = 3\n[[materials]]\n"
        "region = \"square\"\nyoungs_modulus = 1\nfracture_energy = 1\n[[loads]]\n"
        "region = \"square\"\nforce = [0, 1]\n",
        side, side / 16.0);
  };
  const Body large = body_of(square(1.0)), small = body_of(square(0x1p-20));
  ASSERT_EQ(large.particles.size(), small.particles.size());
  for (std::size_t k = 0; k < large.particles.positions.size(); ++k) {
    ASSERT_EQ(large.particles.positions[k], 0x1p20 * small.particles.positions[k]);
  }
}

TEST_F(UnstructuredBody, LaterMaterialsLeaveNoTraceOfEarlierOnes) {
  // A strip under the disc ends within it, and the disc covers that end.
  std::string text = replaced(plate_text, "{name = \"end\"",
                              "{name = \"strip\", x = [1.5, 2], y = [0.4, 0.6]},\n"
                              "  {name = \"end\"");
  text = replaced(text, "[[materials]]\nregion = \"disc\"",
                  "[[materials]]\nregion = \"strip\"\nyoungs_modulus = 20\n"
                  "fracture_energy = 1\n[[materials]]\nregion = \"disc\"");
  const Body body = body_of(text);
  for (Index i = 0; i < body.particles.size(); ++i) {
    const auto x = body.particles.position(i);
    EXPECT_FALSE(x[0] == 1.5 && x[1] > 0.41 && x[1] < 0.59) << "on the hidden end";
  }
}

TEST_F(UnstructuredBody, MakesElementsAndStateBasedParticles) {
  const auto text_of = [](const std::string& kind) {
    return "regions = [{name = \"s\", x = [0, 1], y = [0, 1]}, {name = \"end\", x = [0, 0], y = "
           "[0, 1]}]\nsupports = [{region = \"end\", fix = [\"x\", \"y\"]}]\n[body]\n" +
           kind +
           "pattern = \"unstructured\"\ncolumns = 9\n[[materials]]\nregion = \"s\"\n"
           "youngs_modulus = 1\npoissons_ratio = 0.2\ndensity = 1\n[[loads]]\nregion = \"s\"\n"
           "force = [0, 1]\n[analysis]\ntype = \"elastic\"\n";
  };
  const Model elements =
      build_model(parse_case(text_of("method = \"linear_elements\"\n"), "case.toml"));
  EXPECT_EQ(elements.elements.has_value(), true);
  EXPECT_NEAR(std::accumulate(elements.network.particles.volumes.begin(),
                              elements.network.particles.volumes.end(), 0.0),
              1.0, 1e-12);
  const Model particles = build_model(parse_case(text_of("model = \"particles\"\n"), "case.toml"));
  EXPECT_EQ(particles.network.particles.size(), elements.network.particles.size());
}

TEST_F(UnstructuredBody, RefusesWhatTheSpacingCannotResolve) {
  EXPECT_THAT(
      refusal(replaced(plate_text, "spacing = 0.05", "spacing = 0.25")),
      HasSubstr("materials[1].holes: is \"hole\", whose radius 0.2 is less than the spacing "
                "0.25"));
  EXPECT_THAT(
      refusal(replaced(plate_text, "center = [1.5, 0.5]", "center = [1.699, 0.5]")),
      HasSubstr(
          "body.spacing: is 0.05, but faces of regions are only 0.00101 apart at (1.999, 0.5)"));
}

}  // namespace
}  // namespace perilink
