// Closed pre-cracks press along their normal and slide freely (docs/theory/softening.md, section
// 8).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "discretization/bonds.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "model/gauges.hpp"

namespace perilink {
namespace {

/// Block that a level crack cuts through between two rows of particles, on a clamped base.
struct CutBlock {
  std::string model = "bond_based";
  std::string pattern = "rectangular";
  double spacing = 1.0, ratio = 3.0;
  bool cracked = true;

  std::string text(const std::string& conditions) const {
    const double height = 21.0, width = 40.0;
    return fmt::format(R"([body]
spacing = {}
horizon_ratio = {}
model = "{}"
pattern = "{}"
[[regions]]
name = "block"
x = [0, {}]
y = [0, {}]
[[regions]]
name = "base"
x = [0, {}]
y = [0, 0]
[[regions]]
name = "foot"
x = [0, 0]
y = [0, 0]
[[regions]]
name = "head"
x = [0, 0]
y = [{}, {}]
[[regions]]
name = "top"
x = [0, {}]
y = [{}, {}]
[[materials]]
region = "block"
youngs_modulus = 30000
{}
closing = true
[[supports]]
region = "base"
fix = ["y"]
[analysis]
type = "elastic"
{}{})",
                       spacing, ratio, model, pattern, width, height, width, height, height, width,
                       height, height, model == "micropolar" ? "poissons_ratio = 0.2" : "",
                       !cracked ? ""
                                : fmt::format("[[cracks]]\npoints = [[-1.0, {0}], [{1}, {0}]]\n",
                                              10.5 - (spacing < 1.0 ? 0.25 : 0.0), width + 1.0),
                       conditions);
  }
  Model build(const std::string& conditions) const {
    return build_model(parse_case(text(conditions), "block.toml"));
  }
};

std::vector<CutBlock> blocks() {
  std::vector<CutBlock> all;
  for (const char* model : {"bond_based", "micropolar"}) {
    for (const double ratio : {2.0, 3.0, 4.0}) all.push_back({model, "rectangular", 1.0, ratio});
    all.push_back({model, "rectangular", 1.5, 3.0});
    all.push_back({model, "rectangular", 0.5, 3.0});
  }
  all.push_back({"bond_based", "hexagonal", 1.0, 3.0});
  return all;
}

/// Two halves under pressure are as stiff as one block. What remains comes from the bonds across
/// the crack, which no longer resist strains along it.
TEST(ClosedCracks, CarryPressureAsTheIntactBody) {
  const std::string pressed =
      "[[supports]]\nregion = \"foot\"\nfix = [\"x\"]\n[[supports]]\nregion = \"head\"\nfix = "
      "[\"x\"]\n"
      "[[displacements]]\nregion = \"top\"\ny = -0.01\n";
  double worst = 0.0;
  for (CutBlock block : blocks()) {
    const double cracked = run_elastic_analysis(block.build(pressed)).strain_energy;
    block.cracked = false;
    const double whole = run_elastic_analysis(block.build(pressed)).strain_energy;
    worst = std::max(worst, std::abs(cracked / whole - 1.0));
    EXPECT_NEAR(cracked / whole, 1.0, 0.02)
        << block.model << " " << block.pattern << " " << block.spacing << " " << block.ratio;
  }
  RecordProperty("worst", fmt::format("{:.4f}", worst));
}

/// A pushed half slides without opening and without a force.
TEST(ClosedCracks, SlideFreely) {
  const std::string pushed =
      "[[supports]]\nregion = \"base\"\nfix = [\"x\"]\n[[springs]]\nregion = \"top\"\n"
      "stiffness = [0.0, 0.001]\n[[displacements]]\nregion = \"top\"\nx = 0.001\n";
  for (const CutBlock& block : blocks()) {
    const Model model = block.build(pushed);
    const ElasticResult result = run_elastic_analysis(model);
    const int width = model.network.width();
    double opened = 0.0;
    for (Index i = 0; i < model.network.first_embedded_point(); ++i) {
      opened = std::max(opened, std::abs(result.displacement[i * width + 1]));
    }
    // Rounded directions stretch bonds in rigid motions; weak springs hold the upper half.
    EXPECT_LT(opened, 1e-9 * 0.001)
        << block.model << " " << block.pattern << " " << block.spacing << " " << block.ratio;
  }
}

}  // namespace
}  // namespace perilink
