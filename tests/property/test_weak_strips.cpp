// Strips in tension across a weak interface have its strength and fracture energy, and no other
// bonds break.

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "support/replaced.hpp"
#include "support/weak_strips.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

struct NamedStrip {
  std::string name;
  WeakStrip strip;
};

std::ostream& operator<<(std::ostream& out, const NamedStrip& strip) { return out << strip.name; }

class WeakStrips : public testing::TestWithParam<NamedStrip> {};

TEST_P(WeakStrips, BearTheStrengthAndTakeTheFractureEnergyOfTheirInterface) {
  const WeakStrip& strip = GetParam().strip;
  const WholeRun run(weak_strip_case(strip));
  const double force = strip.tensile_strength * strip.area();
  const double energy = strip.fracture_energy * strip.area();
  const auto told = [&](const char* key) { return run.summary.json.at(key).get<double>(); };
  EXPECT_NEAR(told("peak_load"), force, 0.03 * force);
  EXPECT_NEAR(told("dissipated_energy"), energy, 0.03 * energy);
  EXPECT_LT(told("energy_error"), 1e-9);
}

/// A line along the joint of two materials puts the joint's particles on one of its sides. The
/// bonds across then belong to the stiff or to the soft half.
TEST(WeakStrips, TakeTheirEnergyWhicheverWayALineAlongTheirJointIsDrawn) {
  for (const char* model : {"bond_based", "micropolar"}) {
    WeakStrip strip{false, model};
    strip.stiffer = 0.25;
    for (const char* line : {"[[50, -1], [50, 51]]", "[[50, 51], [50, -1]]"}) {
      const WholeRun run(replaced(weak_strip_case(strip), "between = [\"first\", \"second\"]",
                                  fmt::format("points = {}", line)));
      const double energy = strip.fracture_energy * strip.area();
      EXPECT_NEAR(run.summary.json.at("dissipated_energy").get<double>(), energy, 0.03 * energy)
          << model << line;
    }
  }
}

std::vector<NamedStrip> weak_strips() {
  std::vector<NamedStrip> result;
  for (const char* curve : {"linear", "bilinear", "exponential"}) {
    for (const char* model : {"bond_based", "micropolar"}) {
      for (const char* pattern : {"rectangular", "hexagonal"}) {
        result.push_back(
            {fmt::format("{}_{}_{}", model, pattern, curve), {false, model, pattern, curve}});
      }
    }
  }
  WeakStrip bar{true, "bond_based", "cubic", "bilinear"};
  bar.length = 60.0;
  bar.width = 24.0;
  bar.spacing = 6.0;
  result.push_back({"bond_based_cubic_bilinear", bar});
  bar.model = "micropolar";
  bar.width = 18.0;  // an event takes eight times as long as in the strip
  result.push_back({"micropolar_cubic_bilinear", bar});
  return result;
}

INSTANTIATE_TEST_SUITE_P(Curves, WeakStrips, testing::ValuesIn(weak_strips()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace perilink
