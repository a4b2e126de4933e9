// Cracks that have grown in a run close and slide: a block is pulled apart along a face, pressed
// together, slid and brought back (docs/theory/softening.md, section 8).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double pressure_force = 100.0, slip = 0.001, spring = 20.0;

struct GrownCrack {
  std::string name;
  std::string model = "bond_based";
  std::string pattern = "rectangular";
  double ratio = 3.0;
  bool softens = true;
  int dim = 2;
  double shear_kept = 1e-9;  ///< largest shear stiffness and opening over slip [-]
};

std::ostream& operator<<(std::ostream& out, const GrownCrack& tested) { return out << tested.name; }

std::string region(const std::string& name, const GrownCrack& tested, double width, double from,
                   double to) {
  const std::string depth = tested.dim == 3 ? fmt::format("z = [0, {}]\n", width) : "";
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [0, {}]\ny = [{}, {}]\n{}", name, width, from,
                     to, depth);
}

/// Block on a fixed base whose top is pulled off, pressed down with `pressure_force`, slid, and
/// pressed with the same force again. Springs hold it where it is apart.
/// \param cracked  false: the block has no weak face and is not pulled
std::string block(const GrownCrack& tested, bool cracked) {
  const double width = tested.dim == 3 ? 5.0 : 16.0, height = tested.dim == 3 ? 7.0 : 11.0;
  const double middle = 0.5 * height;
  std::string text = fmt::format(
      "[body]\nproblem = \"{}\"\nspacing = 1\nhorizon_ratio = {}\nmodel = \"{}\"\n"
      "pattern = \"{}\"\n",
      tested.dim == 3 ? "three_dimensional" : "plane_stress", tested.ratio, tested.model,
      tested.pattern);
  text += region("block", tested, width, 0, height) + region("lower", tested, width, 0, middle) +
          region("upper", tested, width, middle, height) + region("base", tested, width, 0, 0) +
          region("top", tested, width, height, height);
  text += fmt::format(
      "[[materials]]\nregion = \"block\"\nyoungs_modulus = 30000\nfracture_energy = {}\n{}",
      cracked ? "\"infinite\"" : "1e6",
      tested.model == "micropolar" ? "poissons_ratio = 0.2\n" : "");
  if (cracked) {
    text += fmt::format(
        "[[interfaces]]\nbetween = [\"lower\", \"upper\"]\nfracture_energy = 0.02\n"
        "closing = true\n{}",
        tested.softens ? "tensile_strength = 3\n" : "");
  }
  const std::string last = tested.dim == 3 ? ", \"z\"" : "";
  text += fmt::format("[[supports]]\nregion = \"base\"\nfix = [\"x\", \"y\"{}]\n", last);
  if (tested.dim == 3) text += "[[supports]]\nregion = \"top\"\nfix = [\"z\"]\n";
  text += fmt::format(
      "[[displacements]]\nregion = \"top\"\ny = 1\nstage = \"pull\"\n"
      "[[displacements]]\nregion = \"top\"\nx = 1\nstage = \"slide\"\n"
      "[[springs]]\nregion = \"top\"\nstiffness = [{0}, {0}{1}]\n"
      "[[stages]]\nname = \"pull\"\nto = {2}\n"
      "[[stages]]\nname = \"press\"\nloads = \"pull\"\nto_load = {3}\n"
      "[[stages]]\nname = \"slide\"\nto = {4}\n"
      "[[stages]]\nname = \"ease\"\nloads = \"pull\"\nto_load = {3}\n"
      "[[stages]]\nname = \"back\"\nloads = \"slide\"\nto = 0\n"
      "[analysis]\ntype = \"damage\"\n",
      spring, tested.dim == 3 ? ", 0" : "", cracked ? 1.0 : 0.0, -pressure_force, slip);
  return text;
}

/// Values of the last row of each stage, by the stage's number.
class StagesOf {
 public:
  explicit StagesOf(const std::string& text) {
    const WholeRun run(text);
    stage_ = run.history("stage");
    energy_error = run.summary.json.at("energy_error").get<double>();
    for (const char* name : {"load_factor", "load", "dissipated_energy", "strain_energy"}) {
      columns_[name] = run.history(name);
    }
  }
  double last(int stage, const std::string& column) const {
    double value = 0.0;
    for (std::size_t row = 0; row < stage_.size(); ++row) {
      if (stage_[row] == stage) value = columns_.at(column)[row];
    }
    return value;
  }
  double energy_error = 0.0;

 private:
  std::vector<double> stage_;
  std::map<std::string, std::vector<double>> columns_;
};

class GrownCracks : public testing::TestWithParam<GrownCrack> {};

/// Faces of a grown crack carry pressure as the intact block does, slide without opening and
/// without a force, and lose no energy.
TEST_P(GrownCracks, CarryPressureAndSlide) {
  const GrownCrack& tested = GetParam();
  const StagesOf rows(block(tested, true)), intact(block(tested, false));
  const double stiffness = rows.last(2, "load") / rows.last(2, "load_factor");
  const double wanted = intact.last(2, "load") / intact.last(2, "load_factor");
  // The springs act per area of the top.
  const double springs = spring * (tested.dim == 3 ? 25.0 : 16.0);
  const double kept = (rows.last(3, "load") - springs * slip) / intact.last(3, "load");
  const double opening = (rows.last(4, "load_factor") - rows.last(2, "load_factor")) / slip;
  RecordProperty("pressed", fmt::format("{:.4f}", stiffness / wanted));
  RecordProperty("shear_kept", fmt::format("{:.2e}", kept));
  RecordProperty("opening", fmt::format("{:.2e}", opening));
  EXPECT_NEAR(stiffness / wanted, 1.0, 0.02);
  EXPECT_NEAR(kept, 0.0, tested.shear_kept);
  EXPECT_NEAR(opening, 0.0, tested.shear_kept);
  EXPECT_EQ(rows.last(5, "dissipated_energy"), rows.last(1, "dissipated_energy"));
  EXPECT_NEAR(rows.last(5, "load"), 0.0, 1e-9 * pressure_force);
  EXPECT_LT(rows.energy_error, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, GrownCracks,
    testing::Values(GrownCrack{"ratio_2", "bond_based", "rectangular", 2.0}, GrownCrack{"ratio_3"},
                    GrownCrack{"ratio_4", "bond_based", "rectangular", 4.0},
                    GrownCrack{"hexagonal", "bond_based", "hexagonal", 3.0, true, 2, 0.1},
                    GrownCrack{"brittle", "bond_based", "rectangular", 3.0, false},
                    GrownCrack{"micropolar", "micropolar"},
                    GrownCrack{"in_space", "bond_based", "cubic", 2.0, true, 3}),
    [](const auto& tested) { return tested.param.name; });

/// Cracks through plates: one of micropolar bonds stays plane and slides freely, one of bond-based
/// bonds wanders by some rows, interlocks, and leaves bonds that only round-off moves.
class GrownCrackInAPlate : public testing::TestWithParam<bool> {};

TEST_P(GrownCrackInAPlate, IsPulledThroughClosesAndSlides) {
  const bool plane = GetParam();
  const auto plate = [&](bool cracked) {
    std::string text =
        "[body]\nproblem = \"plane_stress\"\nspacing = 1\nhorizon_ratio = 3\n"
        "model = \"" +
        std::string(plane ? "micropolar" : "bond_based") + "\"\n";
    const double extents[][3] = {{0, 0, 16}, {1, 0, 3}, {2, 13, 16}, {3, 0, 0}, {4, 16, 16}};
    const char* const names[] = {"plate", "feet", "head", "base", "top"};
    for (const auto& [name, from, to] : extents) {
      text += fmt::format("[[regions]]\nname = \"{}\"\nx = [0, 24]\ny = [{}, {}]\n",
                          names[static_cast<int>(name)], from, to);
      if (name > 2) continue;
      text += fmt::format("[[materials]]\nregion = \"{}\"\nyoungs_modulus = 30000\n{}{}",
                          names[static_cast<int>(name)], plane ? "poissons_ratio = 0.2\n" : "",
                          name > 0  ? "fracture_energy = \"infinite\"\n"
                          : cracked ? "fracture_energy = 0.02\ntensile_strength = 3\n"
                                    : "fracture_energy = 1e6\n");
    }
    if (cracked) text += "[[cracks]]\npoints = [[0, 8.5], [6, 8.5]]\n";
    return text + fmt::format(
                      "[[supports]]\nregion = \"base\"\nfix = [\"x\", \"y\"]\n"
                      "[[displacements]]\nregion = \"top\"\ny = 1\nstage = \"pull\"\n"
                      "[[displacements]]\nregion = \"top\"\nx = 1\nstage = \"slide\"\n"
                      "[[springs]]\nregion = \"top\"\nstiffness = [20, 20]\n"
                      "[[stages]]\nname = \"pull\"\nto = {}\n"
                      "[[stages]]\nname = \"press\"\nloads = \"pull\"\nto_load = -144\n"
                      "[[stages]]\nname = \"slide\"\nto = 0.001\n"
                      "[analysis]\ntype = \"damage\"\n",
                      cracked ? 0.3 : 0.0);
  };
  const StagesOf rows(plate(true)), intact(plate(false));
  EXPECT_LT(rows.energy_error, 1e-10);
  EXPECT_EQ(rows.last(3, "load_factor"), slip);
  const double springs = 20.0 * 24.0 * slip;  // their part of the load
  const double kept = (rows.last(3, "load") - springs) / (intact.last(3, "load") - springs);
  if (plane) {
    EXPECT_NEAR(kept, 0.0, 0.01);
  } else {  // cracks that wander by some rows keep 0.75 to 0.98 of the shear stiffness
    EXPECT_GT(kept, 0.75);
    EXPECT_LT(kept, 1.0);
  }
  // Cracks along lattice rows are within 1 % as stiff as intact under pressure.
  EXPECT_NEAR(rows.last(2, "load_factor") / intact.last(2, "load_factor"), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Models, GrownCrackInAPlate, testing::Bool());

}  // namespace
}  // namespace perilink
