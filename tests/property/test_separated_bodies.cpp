// Bodies that separate while springs still hold their pieces: the pieces move without strains, and
// round-off of their motion must neither fail a bond nor the run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "support/replaced.hpp"
#include "support/softening_strips.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double ground_stiffness = 100.0;  ///< of the ground springs per area [force/length^3]
constexpr double last_displacement = 0.5;   ///< displacement of the stop rule [length]

struct SpringCase {
  std::string name;
  std::string model;
  bool driven;
  std::string rules;  ///< lines of [analysis] and the following tables
};

std::ostream& operator<<(std::ostream& out, const SpringCase& body) { return out << body.name; }

SofteningStrip spring_strip() {
  SofteningStrip strip;
  strip.length = 60.0;
  strip.width = 20.0;
  strip.spacing = 4.0;
  strip.softening = "softening = \"bilinear\"";
  return strip;
}

std::string spring_case(const SpringCase& body) {
  SofteningStrip strip = spring_strip();
  strip.model = body.model;
  strip.more = fmt::format("{}[[springs]]\nregion = \"right\"\nstiffness = [{}, 0]\n", body.rules,
                           ground_stiffness);
  const std::string text = softening_case(strip);
  if (body.driven) return text;
  return replaced(text, "[[displacements]]\nregion = \"right\"\nx = 0.1",
                  "[[tractions]]\nregion = \"right\"\ntraction = [1, 0]");
}

class SeparatedStrips : public testing::TestWithParam<SpringCase> {};

/// The springs alone carry the end.
TEST_P(SeparatedStrips, GoOnToTheDisplacementOfTheStopRule) {
  const SofteningStrip strip = spring_strip();
  const WholeRun run(spring_case(GetParam()));
  const auto& summary = run.summary.json;
  EXPECT_EQ(summary.at("status"), "completed") << summary.at("reason");
  const double force = ground_stiffness * strip.width * last_displacement;
  EXPECT_NEAR(run.history("displacement").back(), last_displacement, 1e-9 * last_displacement);
  EXPECT_NEAR(run.history("load").back(), force, 1e-9 * force);
  if (GetParam().rules.find("steps") == std::string::npos) {  // steps lose the energy of snap-back
    // Bands of two horizons dissipate up to twice the energy of one crack here.
    EXPECT_LT(summary.at("dissipated_energy").get<double>(),
              3.0 * strip.fracture_energy * strip.width);
  }
  EXPECT_LT(summary.at("energy_error").get<double>(), 1e-9);
  EXPECT_LT(summary.at("largest_residual").get<double>(), 1e-9);
}

std::vector<SpringCase> spring_cases() {
  const std::string stage =
      fmt::format("[[stages]]\nname = \"pull\"\ndisplacement = {}\n", last_displacement);
  const std::string stop = fmt::format("[stop]\ndisplacement = {}\n", last_displacement);
  const std::string single = "event_tolerance = 0\n";
  std::vector<SpringCase> cases;
  for (const std::string model : {"bond_based", "micropolar"}) {
    for (const bool driven : {true, false}) {
      const std::string name = model + (driven ? "_driven" : "_forced");
      cases.push_back({name + "_stage", model, driven, stage});
      cases.push_back({name + "_single_stage", model, driven, single + stage});
      cases.push_back({name, model, driven, stop});
      cases.push_back({name + "_single", model, driven, single + stop});
    }
    cases.push_back(
        {model + "_steps", model, true, "control = \"steps\"\nload_factors = [1, 3, 5]\n"});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(OnSprings, SeparatedStrips, testing::ValuesIn(spring_cases()),
                         [](const auto& test) { return test.param.name; });

/// Rules that springs never let come true: the run ends with the rows up to the separation.
TEST(SeparatedStrips, CollapseIfNoStopRuleGivesTheirEnd) {
  for (const char* rules : {"[[stages]]\nname = \"pull\"\nload_fraction = 0.001\n",
                            "[stop]\nload_fraction = 0.001\n"}) {
    for (const bool driven : {true, false}) {
      const WholeRun run(spring_case({"", "bond_based", driven, rules}));
      EXPECT_EQ(run.summary.json.at("status"), "collapsed") << rules;
      EXPECT_THAT(run.summary.json.at("reason").get<std::string>(),
                  testing::HasSubstr("the body separated"));
      EXPECT_LT(run.history("displacement").back(), last_displacement);
    }
  }
}

}  // namespace
}  // namespace perilink
