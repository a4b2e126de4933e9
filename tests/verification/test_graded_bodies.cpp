// Bodies whose properties vary in space against closed forms.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/weak_strips.hpp"
#include "support/whole_run.hpp"

namespace perilink::verification {
namespace {

std::string body_of(const std::string& name, const std::string& bonds, double spacing) {
  return fmt::format("[body]\nproblem = \"{}\"\nspacing = {}\n{}", name, spacing, bonds);
}

std::string region(const std::string& name, double from, double to, double low, double high,
                   bool in_space) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n{}", name, from, to,
                     low, high, in_space ? "z = [0, 0.5]\n" : "");
}

std::string modulus(const std::string& factor) {
  return fmt::format("[[graded]]\nproperty = \"youngs_modulus\"\nfactor = \"{}\"\n", factor);
}

/// Values of the gauges of an elastic body at load factor 1.
std::vector<double> gauges_of(const std::string& text) {
  const test::WholeRun run(text);
  std::vector<double> values;
  for (const GaugeSection& gauge : run.input.gauges) {
    values.push_back(run.history(gauge.name).back());
  }
  return values;
}

/// Kinds of bodies in the plane.
struct Kind {
  std::string name, keys, ratio, more;
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class GradedPlates : public testing::TestWithParam<Kind> {};

/// A plate 2 by 1 of E = 1 + 2 y in pure bending of curvature 1 about y0 = 7/12, for which the
/// stress has no resultant: u = x (y - y0), sigma = E (y - y0), whatever Poisson's ratio.
std::string bent_plate(const Kind& kind, double spacing) {
  return body_of("plane_stress", kind.keys, spacing) + region("all", 0, 2, 0, 1, false) +
         region("left", 0, 0, 0, 1, false) + region("pin", 0, 0, 0, 0, false) +
         region("right", 2, 2, 0, 1, false) +
         "[[materials]]\nregion = \"all\"\nyoungs_modulus = 1\nfracture_energy = \"infinite\"\n" +
         kind.ratio + modulus("1 + 2 * y") +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\"]\n"
         "[[supports]]\nregion = \"pin\"\nfix = [\"y\"]\n"
         "[[tractions]]\nregion = \"right\"\ntraction = [\"(1 + 2 * y) * (y - 7 / 12)\", 0]\n"
         "[[gauges]]\nname = \"sag\"\nbetween = [[0, 0], [2, 0]]\naxis = \"y\"\n"
         "[[gauges]]\nname = \"below\"\nat = [1, 0]\nstress = \"xx\"\n"
         "[[gauges]]\nname = \"inside\"\nat = [1, 0.8]\nstress = \"xx\"\n"
         "[analysis]\ntype = \"elastic\"\n" +
         kind.more;
}

TEST_P(GradedPlates, BendAsTheContinuum) {
  const std::vector<double> coarse = gauges_of(bent_plate(GetParam(), 0.1));
  const std::vector<double> fine = gauges_of(bent_plate(GetParam(), 0.05));
  const double sag = -2.0, below = -7.0 / 12.0, inside = 2.6 * (0.8 - 7.0 / 12.0);
  EXPECT_NEAR(coarse[0], sag, 0.03 * std::abs(sag));
  EXPECT_LT(std::abs(fine[0] - sag), 0.35 * std::abs(coarse[0] - sag) + 1e-4);
  EXPECT_NEAR(fine[1], below, 0.02);
  EXPECT_NEAR(fine[2], inside, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, GradedPlates,
    testing::Values(
        Kind{"trusses", "horizon_ratio = 3\n", "", ""},
        Kind{"hexagonal", "horizon_ratio = 3\npattern = \"hexagonal\"\n", "", ""},
        Kind{"unstructured", "horizon_ratio = 3\npattern = \"unstructured\"\n", "", ""},
        Kind{"frames", "horizon_ratio = 3\nmodel = \"micropolar\"\n", "poissons_ratio = 0.2\n", ""},
        Kind{"hosts", "horizon_ratio = 3\n", "", "[elements]\nspacings = 4\n"},
        Kind{"elements", "method = \"linear_elements\"\n", "poissons_ratio = 0.3\n", ""}),
    [](const auto& test) { return test.param.name; });

/// A bar of E = 1 + x without lateral strain under the force 1: its elongation is the integral of
/// dx / (A E), ln 2 / A.
std::string pulled_bar(const std::string& problem, const std::string& keys, bool in_space,
                       const std::string& more) {
  const std::string load = in_space ? "[4, 0, 0]" : "[2, 0]";
  return body_of(problem, keys, 0.1) + region("bar", 0, 1, 0, 0.5, in_space) +
         region("left", 0, 0, 0, 0.5, in_space) + region("right", 1, 1, 0, 0.5, in_space) +
         "[[materials]]\nregion = \"bar\"\nyoungs_modulus = 1\nfracture_energy = \"infinite\"\n"
         "poissons_ratio = 0\n" +
         modulus("1 + x") +
         fmt::format("[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"{}]\n",
                     in_space ? ", \"z\"" : "") +
         fmt::format("[[tractions]]\nregion = \"right\"\ntraction = {}\n", load) +
         "[[gauges]]\nname = \"long\"\nregion = \"right\"\naxis = \"x\"\n" +
         fmt::format("[[gauges]]\nname = \"stress\"\nat = [0.5, 0.2{}]\nstress = \"xx\"\n",
                     in_space ? ", 0.2" : "") +
         "[analysis]\ntype = \"elastic\"\n" + more;
}

TEST(GradedBars, LengthenByTheIntegralOfTheirCompliance) {
  const std::string frames = "model = \"micropolar\"\nhorizon_ratio = 3\n";
  const std::vector<double> plane = gauges_of(pulled_bar("plane_stress", frames, false, ""));
  EXPECT_NEAR(plane[0], 2.0 * std::log(2.0), 4e-3);
  EXPECT_NEAR(plane[1], 2.0, 1.5e-2);
  const std::string shorter = "model = \"micropolar\"\nhorizon_ratio = 2\n";
  const std::vector<double> space = gauges_of(pulled_bar("three_dimensional", shorter, true, ""));
  EXPECT_NEAR(space[0], 4.0 * std::log(2.0), 5e-3);
  EXPECT_NEAR(space[1], 4.0, 2e-2);
}

/// A cantilever beam of length 1 with E I = 1 + x under a force of 1 at its end: integral of
/// (1 - x)^2 / (1 + x).
TEST(GradedBeams, BendByTheIntegralOfTheirCompliance) {
  const auto sag = [](double spacing) {
    return gauges_of(body_of("beam", "thickness = 1\nhorizon_ratio = 3\n", spacing) +
                     region("beam", 0, 1, 0, 0.1, false) + region("left", 0, 0, 0, 0.1, false) +
                     "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 12000\n"
                     "fracture_energy = \"infinite\"\n" +
                     modulus("1 + x") +
                     "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\", \"rotation\"]\n"
                     "[[point_loads]]\nat = [1, 0.05]\nforce = [0, 1]\n"
                     "[[gauges]]\nname = \"sag\"\nat = [1, 0.05]\naxis = \"y\"\n"
                     "[analysis]\ntype = \"elastic\"\n")[0];
  };
  const double exact = 4.0 * std::log(2.0) - 2.5;
  EXPECT_NEAR(sag(0.02), exact, 0.02 * exact);
  EXPECT_LT(std::abs(sag(0.01) - exact), 0.6 * std::abs(sag(0.02) - exact));
}

/// Strip 200 by 20 in tension along x with unbreakable ends.
std::string strip(const std::string& law, const std::string& fields) {
  return body_of("plane_stress", "horizon_ratio = 3\n", 4) + region("strip", 0, 200, 0, 20, false) +
         region("left", 0, 20, 0, 20, false) + region("right", 180, 200, 0, 20, false) +
         "[[materials]]\nname = \"body\"\nregion = \"strip\"\nyoungs_modulus = 30000\n" + law +
         "[[materials]]\nname = \"ends\"\nregions = [\"left\", \"right\"]\n"
         "youngs_modulus = 30000\nfracture_energy = \"infinite\"\n" +
         fields +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
         "[[displacements]]\nregion = \"right\"\nx = 1\n[stop]\nload_fraction = 0.1\n";
}

const std::string softening =
    "fracture_energy = 0.1\ntensile_strength = 3\nsoftening = \"linear\"\n";

/// Returns the mean x of the points with half of the largest damage or more.
double place_of_damage(const test::WholeRun& run) {
  const VtuGrid fields = run.fields(run.series().size() - 1);
  const std::vector<double>& damage = fields.find_point_data("damage")->values;
  const double half = 0.5 * *std::max_element(damage.begin(), damage.end());
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < damage.size(); ++i) {
    if (damage[i] < half) continue;
    sum += fields.points[3 * i];
    count += 1.0;
  }
  return sum / count;
}

double told(const test::WholeRun& run, const char* key) {
  return run.summary.json.at(key).get<double>();
}

/// The least strength 3 at x = 70, rising by 6 % over a horizon.
TEST(GradedStrips, BreakWhereTheirStrengthIsLeast) {
  const test::WholeRun run(
      strip(softening,
            "[[graded]]\nproperty = \"tensile_strength\"\nfactor = \"1 + ((x - 70) / 50)^2\"\n"));
  EXPECT_NEAR(place_of_damage(run), 70.0, 8.0);
  EXPECT_NEAR(told(run, "peak_load"), 60.0, 0.06 * 60.0);
  EXPECT_LT(told(run, "energy_error"), 1e-9);
}

/// Where only the modulus varies, the strength does not: the peak is that of the strip without a
/// field, and the body stores and dissipates energy by its own modulus.
TEST(GradedStrips, KeepTheirStrengthWhereTheModulusVaries) {
  const test::WholeRun even(strip(softening, ""));
  const test::WholeRun run(strip(softening, modulus("1 + x / 100")));
  EXPECT_NEAR(told(run, "peak_load"), told(even, "peak_load"), 0.03 * 60.0);
  EXPECT_LT(told(run, "energy_error"), 1e-9);
}

/// Brittle bonds of one fracture energy have a strength in proportion to the root of the modulus.
TEST(GradedStrips, OfBrittleBondsBreakWhereTheyAreSoftest) {
  const std::string law = "fracture_energy = 0.1\n";
  const test::WholeRun even(strip(law, ""));
  const test::WholeRun run(strip(law, modulus("0.5 + ((x - 130) / 50)^2")));
  EXPECT_NEAR(place_of_damage(run), 130.0, 8.0);
  const double ratio = told(run, "peak_load") / told(even, "peak_load");
  EXPECT_NEAR(ratio, std::sqrt(0.5), 0.06 * ratio);
}

/// The modulus at the interface is 1.5 times that of the materials.
TEST(GradedStrips, BearTheStrengthAndTakeTheFractureEnergyOfTheirInterface) {
  for (const double stiffer : {1.0, 0.5}) {
    for (const char* model : {"bond_based", "micropolar"}) {
      test::WeakStrip weak{false, model};
      weak.stiffer = stiffer;
      const test::WholeRun run(test::weak_strip_case(weak) + modulus("0.5 + x / 50"));
      const double force = weak.tensile_strength * weak.area();
      const double energy = weak.fracture_energy * weak.area();
      EXPECT_NEAR(told(run, "peak_load"), force, 0.03 * force) << model << stiffer;
      EXPECT_NEAR(told(run, "dissipated_energy"), energy, 0.03 * energy) << model << stiffer;
      EXPECT_LT(told(run, "energy_error"), 1e-9);
    }
  }
}

/// An explicit run of a graded strip keeps its energy and ends at the elastic elongation.
TEST(GradedStrips, MoveWithoutLosingEnergy) {
  const std::string text =
      body_of("plane_stress", "horizon_ratio = 3\n", 4) + region("strip", 0, 200, 0, 20, false) +
      region("left", 0, 0, 0, 20, false) + region("right", 200, 200, 0, 20, false) +
      "[[materials]]\nregion = \"strip\"\nyoungs_modulus = 30000\n"
      "fracture_energy = \"infinite\"\ndensity = 1\n" +
      modulus("1 + x / 50") +
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
      "[[tractions]]\nregion = \"right\"\ntraction = [1, 0]\n";
  const test::WholeRun run(text +
                           "[analysis]\ntype = \"explicit\"\nduration = 20\nramp_time = 10\n");
  EXPECT_LT(told(run, "energy_error"), 1e-3);
}

}  // namespace
}  // namespace perilink::verification
