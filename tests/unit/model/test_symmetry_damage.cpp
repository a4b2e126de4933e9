#include "model/symmetry_damage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>
#include <vector>

#include "model/from_case/configure.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// A square of 100 by 100, in space a block, with planes of symmetry x = 0 and y = 0.
CaseFile quarter(bool in_space, const std::string& softening) {
  const std::string side = in_space ? "y = [0, 40]\nz = [0, 40]\n" : "y = [0, 100]\n";
  return parse_case(fmt::format(R"([body]
problem = "{}"
spacing = 4
horizon_ratio = 2.5
[[regions]]
name = "square"
x = [0, 100]
{}[[regions]]
name = "right"
x = [100, 100]
{}[[materials]]
region = "square"
youngs_modulus = 30000
fracture_energy = 0.1
{}[[symmetry]]
axis = "x"
at = 0
[[symmetry]]
axis = "y"
at = 0
{}[[displacements]]
region = "right"
x = 1
)",
                                in_space ? "three_dimensional" : "plane_stress", side, side,
                                softening, in_space ? "[[symmetry]]\naxis = \"z\"\nat = 0\n" : ""),
                    "quarter");
}

/// Returns secants with a value for bonds across the plane at `x`, below `top` only.
std::vector<double> cut(const Network& network, double x, double top, double secant) {
  std::vector<double> secants(network.stiffness.size(), 1.0);
  for (Index b = 0; b < network.num_bonds(); ++b) {
    const auto from = network.particles.position(network.bonds.first[b]);
    const auto to = network.particles.position(network.bonds.second[b]);
    const bool crosses = (from[0] < x) != (to[0] < x);
    if (crosses && 0.5 * (from[1] + to[1]) < top) secants[b] = secant;
  }
  return secants;
}

TEST(SymmetryDamage, IsHalfAndMoreAlongAPlaneAndLittleAcross) {
  for (const bool in_space : {false, true}) {
    for (const std::string softening : {"", "tensile_strength = 3\nsoftening = \"linear\"\n"}) {
      const CaseFile input = quarter(in_space, softening);
      const Model model = build_model(input);
      const double secant = softening.empty() ? 0.0 : 0.1;
      const auto along = damage_on_symmetry(input, model, cut(model.network, 2, 1e9, secant));
      ASSERT_TRUE(along);
      EXPECT_EQ(along->plane, 0u);
      EXPECT_GT(along->share, in_space ? 0.38 : 0.6);
      EXPECT_TRUE(warning_about_symmetry(along));
      // A crack across the body, and the first rows of a crack that begins at y = 0.
      for (const double top : {1e9, 12.0, 3.0}) {
        const auto across = damage_on_symmetry(input, model, cut(model.network, 50, top, secant));
        ASSERT_TRUE(across);
        EXPECT_LT(across->share, top > 20.0 ? 0.1 : 0.33) << top;
        EXPECT_FALSE(warning_about_symmetry(across)) << top;
      }
    }
  }
}

TEST(SymmetryDamage, IsAbsentWithoutPlanesOrDamage) {
  CaseFile input = quarter(false, "");
  const Model model = build_model(input);
  EXPECT_FALSE(damage_on_symmetry(input, model, {}));
  const std::vector<double> broken = cut(model.network, 2, 1e9, 0.0);
  input.symmetry.clear();
  EXPECT_FALSE(damage_on_symmetry(input, model, broken));
  EXPECT_FALSE(warning_about_symmetry(std::nullopt));
}

/// A plane that holds the upper part of its face, above a notch.
TEST(SymmetryDamage, LigamentsBesideNotchesAreNoted) {
  const std::string text =
      "[body]\nproblem = \"plane_stress\"\nspacing = 4\nhorizon_ratio = 3\n"
      "[[regions]]\nname = \"beam\"\nx = [0, 100]\ny = [0, 40]\n"
      "[[regions]]\nname = \"face\"\nx = [0, 0]\ny = [{}, 40]\n"
      "[[regions]]\nname = \"end\"\nx = [100, 100]\ny = [0, 40]\n"
      "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 30000\n"
      "fracture_energy = {}\n[[symmetry]]\naxis = \"x\"\nregion = \"face\"\n"
      "[[supports]]\nregion = \"end\"\nfix = [\"y\"]\n"
      "[[displacements]]\nregion = \"end\"\nx = 1\n[analysis]\ntype = \"{}\"\n";
  const auto note = [&](double from, const char* energy, const char* type) {
    const CaseFile input = parse_case(fmt::format(fmt::runtime(text), from, energy, type), "beam");
    return ligament_note(input, build_model(input));
  };
  ASSERT_TRUE(note(16, "0.1", "damage"));
  EXPECT_THAT(*note(16, "0.1", "damage"), HasSubstr("symmetry[1] holds a part of the face x = 0"));
  EXPECT_FALSE(note(0, "0.1", "damage"));
  EXPECT_FALSE(note(16, "0.1", "elastic"));
}

TEST(SymmetryDamage, WarningNamesThePlaneAndWhatToDo) {
  const auto warning = warning_about_symmetry(SymmetryDamage{1, 0.62});
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("0.62 of the dissipated energy lies along the plane of symmetry "
                                  "of symmetry[2]"));
  EXPECT_THAT(*warning, HasSubstr("model the whole body"));
}

}  // namespace
}  // namespace perilink
