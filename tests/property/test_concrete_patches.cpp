// Patches with the law of concrete, displaced along x with free sides, have the strength of their
// bonds' cell, less the loss by gradual damage.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

/// Returns a patch of concrete of Gerstle, Sau & Aguilera (2007), twelve spacings wide, displaced
/// at the right end.
std::string patch(double move, bool shear_softens) {
  constexpr double side = 101.6;
  return fmt::format(R"(title = "Patch of concrete"
[body]
problem = "plane_stress"
model = "micropolar"
spacing = {spacing:.15g}
horizon_ratio = 3
[[regions]]
name = "patch"
x = [0, {side}]
y = [0, {side}]
[[regions]]
name = "left"
x = [0, 0]
y = [0, {side}]
[[regions]]
name = "corner"
x = [0, 0]
y = [0, 0]
[[regions]]
name = "right"
x = [{side}, {side}]
y = [0, {side}]
[[materials]]
region = "patch"
youngs_modulus = 24850
poissons_ratio = 0.22
softening = "concrete"
tension_limit = 0.00014
tension_factor = 2
compression_limit = 0.001
compression_factor = 3
shear_softening = {shear}
[[supports]]
region = "left"
fix = ["x"]
[[supports]]
region = "corner"
fix = ["y"]
[[displacements]]
region = "right"
x = {move}
[analysis]
[stop]
load_fraction = 0.5
)",
                     fmt::arg("spacing", side / 12.0), fmt::arg("side", side),
                     fmt::arg("shear", shear_softens), fmt::arg("move", move));
}

/// Measured ratios: 0.986 and 0.990 in tension, 0.954 and 0.945 in compression.
TEST(ConcretePatches, BearWhatTheirCellSays) {
  struct Expected {
    double move;
    bool shear_softens;
    double strength;  ///< strength reported by `check`
  };
  for (const Expected& each : {Expected{1.0, false, 4.6258}, Expected{1.0, true, 4.5876},
                               Expected{-1.0, false, 34.036}, Expected{-1.0, true, 32.961}}) {
    const WholeRun run(patch(each.move, each.shear_softens));
    const auto told = [&](const char* key) { return run.summary.json.at(key).get<double>(); };
    const double ratio = told("peak_load") / (101.6 * each.strength);
    EXPECT_GT(ratio, 0.93) << "moved by " << each.move;
    EXPECT_LT(ratio, 1.0) << "moved by " << each.move;
    EXPECT_LT(told("energy_error"), 1e-9);
  }
}

}  // namespace
}  // namespace perilink
