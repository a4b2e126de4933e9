#include "model/reactions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;

CaseFile elastic_strip() {
  CaseFile input = strip_case();
  input.analysis.type = AnalysisType::elastic;
  return input;
}

struct Solved {
  explicit Solved(const CaseFile& input)
      : model(build_model(input)), motion(run_elastic_analysis(model).displacement) {}
  ModelState state() const { return {{}, motion}; }
  Model model;
  std::vector<double> motion;
};

TEST(Reactions, OfOneSupportAreTheLoad) {
  const CaseFile input = elastic_strip();
  const Solved solved(input);
  const std::vector<SupportRegion> places = support_regions(input, solved.model);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].name, "supports: lower end");
  EXPECT_EQ(places[0].particles.size(), 15u);
  const std::vector<double> forces = holding_forces(solved.model, solved.state());
  const Reaction reaction = reaction_on(solved.model, places[0].particles, forces);
  // Round-off of 12 times the condition of the matrix, below 1e3.
  EXPECT_NEAR(reaction.force[0], 0.0, 1e-11);
  EXPECT_NEAR(reaction.force[1], -12.0, 1e-11);
  EXPECT_NEAR(reaction.moment[2], 0.0, 1e-10);
  EXPECT_NEAR(reaction.middle[0], 20.0, 1e-12);
  EXPECT_NEAR(reaction.middle[1], 10.0, 1e-12);
}

/// A force of 3 along x with its middle at y = 70 bends the strip: 3 (70 - 10) about the middle of
/// the support; weights of the end row are halved.
TEST(Reactions, HaveTheMomentOfTheLoadsAboutTheSupport) {
  CaseFile input = elastic_strip();
  input.loads[0].force = {3.0, 0.0, 0.0};
  const Solved solved(input);
  const std::vector<SupportRegion> places = support_regions(input, solved.model);
  const Reaction reaction =
      reaction_on(solved.model, places[0].particles, holding_forces(solved.model, solved.state()));
  const double arm = (60.0 + 70.0 + 0.5 * 80.0) / 2.5 - 10.0;
  EXPECT_NEAR(reaction.force[0], -3.0, 1e-11);
  EXPECT_NEAR(reaction.moment[2], 3.0 * arm, 1e-9);
}

TEST(Reactions, OfMicropolarBodiesCountTheMomentsOfHeldRotations) {
  CaseFile input = elastic_strip();
  input.body.model = BodyModel::micropolar;
  input.materials[0].poissons_ratio = 0.2;
  input.supports[0].fix[5] = true;
  input.loads[0].force = {3.0, 0.0, 0.0};
  const Solved solved(input);
  const Reaction reaction =
      reaction_on(solved.model, support_regions(input, solved.model)[0].particles,
                  holding_forces(solved.model, solved.state()));
  const double arm = (60.0 + 70.0 + 0.5 * 80.0) / 2.5 - 10.0;
  EXPECT_NEAR(reaction.moment[2], 3.0 * arm, 1e-9);
}

/// Springs and a plane of symmetry share the load, and the table reports balance.
TEST(Reactions, OfAllPlacesBalanceTheLoads) {
  CaseFile input = elastic_strip();
  input.supports.clear();
  SymmetrySection plane;
  plane.axis = 0;
  plane.at = 0.0;
  input.symmetry.push_back(plane);
  SpringSection spring;
  spring.region = "lower end";
  spring.total = Vector3{0.0, 500.0, 0.0};
  input.springs.push_back(spring);
  input.loads[0].force = {2.0, 12.0, 0.0};
  const Solved solved(input);
  const std::vector<SupportRegion> places = support_regions(input, solved.model);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].name, "symmetry: x = 0");
  EXPECT_EQ(places[1].name, "springs: lower end");
  const std::string text = reaction_table(places, solved.model, solved.state()).text;
  const std::string last = text.substr(text.find("\nsum,") + 5);
  double x, y, fx, fy, moment;
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf,%lf,%lf", &x, &y, &fx, &fy, &moment), 5) << text;
  EXPECT_NEAR(fx, 0.0, 1e-10);
  EXPECT_NEAR(fy, 0.0, 1e-10);
  EXPECT_NEAR(moment, 0.0, 1e-8);
  EXPECT_NE(text.find("place,x,y,force_x,force_y,moment\n"), std::string::npos);
  EXPECT_NE(text.find("\nloads,0,0,2,12,"), std::string::npos) << text;
}

/// Displacements at load factor one under three times the load.
TEST(Reactions, GrowWithTheLoadFactor) {
  const CaseFile input = elastic_strip();
  const Solved solved(input);
  const std::vector<double> forces = holding_forces(solved.model, {{}, solved.motion, 3.0, 3.0});
  const Reaction reaction =
      reaction_on(solved.model, support_regions(input, solved.model)[0].particles, forces);
  EXPECT_NEAR(reaction.force[1], -36.0, 1e-10);
}

TEST(Reactions, KnowWhatIsHeld) {
  const Model model = build_model(elastic_strip());
  const std::vector<std::uint8_t> held = held_slots(model);
  EXPECT_EQ(std::count(held.begin(), held.end(), 1), 30);
}

/// The middle of the facet from x = 10 to 20 lies in the region, its corners do not all.
TEST(Reactions, SupportsAndLoadsAreFields) {
  CaseFile input = elastic_strip();
  input.supports[0].fix = {true, false};
  DisplacementSection down;
  down.region = "lower end";
  down.value[1] = -0.5;
  input.displacements.push_back(down);
  const Model model = build_model(input);
  const std::vector<VtuArray> fields = condition_fields(model);
  ASSERT_EQ(fields.size(), 3u);
  EXPECT_EQ(fields[0].name, "held");
  EXPECT_EQ(fields[0].values[0], 3.0);
  EXPECT_EQ(fields[0].values.back(), 0.0);
  EXPECT_EQ(fields[1].name, "applied_force");
  double sum = 0.0;
  for (std::size_t k = 1; k < fields[1].values.size(); k += 3) sum += fields[1].values[k];
  EXPECT_NEAR(sum, 12.0, 1e-12);
  EXPECT_EQ(fields[2].name, "prescribed_displacement");
  EXPECT_EQ(fields[2].values[1], -0.5);

  input = elastic_strip();
  EXPECT_EQ(condition_fields(build_model(input)).size(), 2u) << "nothing is displaced";
}

TEST(Reactions, OfSpringsCountParticlesAroundTheirFacets) {
  CaseFile input = elastic_strip();
  input.regions.push_back({"part", {{4.0, 80.0, 0.0}, {16.0, 80.0, 0.0}}, {}, ""});
  SpringSection spring;
  spring.region = "part";
  spring.stiffness = Vector3{10.0, 100.0, 0.0};
  input.springs.push_back(spring);
  const Solved solved(input);
  const std::vector<SupportRegion> places = support_regions(input, solved.model);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[1].particles.size(), 3u);
  const Reaction sum = reaction_table(places, solved.model, solved.state()).sum;
  EXPECT_NEAR(sum.force[1], 0.0, 1e-10);
  EXPECT_NEAR(sum.moment[2], 0.0, 1e-9);
  input.regions.back().box = {{14.0, 80.0, 0.0}, {16.0, 80.0, 0.0}};
  test::expect_refused(input, "springs[1].region", "no particle lies in the region \"part\"");
}

/// A strip that moves by 0.01 as a whole and is stretched by 1e-15 has reactions of last digits.
TEST(Reactions, OfNearlyRigidMotionsAreRoundOff) {
  const CaseFile input = parse_case(R"(
[body]
spacing = 1
horizon_ratio = 3
[[regions]]
name = "strip"
x = [0, 7]
y = [0, 4]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 4]
[[regions]]
name = "right"
x = [7, 7]
y = [0, 4]
[[materials]]
region = "strip"
youngs_modulus = 1000
fracture_energy = "infinite"
[[displacements]]
region = "left"
x = 0.01
y = 0
[[displacements]]
region = "right"
x = 0.010000000000001
[analysis]
type = "elastic"
)",
                                    "strip.toml");
  const Solved solved(input);
  const ReactionTable table =
      reaction_table(support_regions(input, solved.model), solved.model, solved.state());
  ReactionBalance by_load, balance;
  by_load.add(1, table.sum, 7.0, 1e-8);
  EXPECT_TRUE(by_load.warning()) << "round-off is more than 1e-8 of the reactions";
  balance.add(1, table.sum, 7.0, 1e-8, table.round_off);
  EXPECT_FALSE(balance.warning());
  EXPECT_LT(table.round_off, 1e-10);
}

TEST(Reactions, OutOfBalanceAreReportedOnce) {
  Reaction sum;
  sum.force_size = 100.0;
  sum.force[0] = 0.9e-6;
  ReactionBalance balance;
  balance.add(1, sum, 10.0, 1e-8);
  EXPECT_FALSE(balance.warning());
  sum.moment[2] = 20.0;
  balance.add(7, sum, 10.0, 1e-8);
  sum.moment[2] = 30.0;
  balance.add(8, sum, 10.0, 1e-8);
  ASSERT_TRUE(balance.warning());
  EXPECT_NE(balance.warning()->find("row 7 are out of balance by 0.02"), std::string::npos)
      << *balance.warning();
  ReactionBalance loose;
  loose.add(7, sum, 10.0, 0.05);
  EXPECT_FALSE(loose.warning()) << "within what the iterations leave";
  sum.force_size = 0.0;
  sum.moment_size = 1000.0;
  sum.moment = {};
  ReactionBalance moments;
  moments.add(1, sum, 10.0, 1e-7);
  EXPECT_FALSE(moments.warning()) << "round-off of forces against moments";
  sum.force[0] = NAN;
  loose.add(8, sum, 10.0, 0.05, 1.0);
  EXPECT_TRUE(loose.warning());
}

}  // namespace
}  // namespace perilink
