#include "model/body/fracture_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;

double weakest(const CaseFile& input) {
  const std::vector<double> limits = build_model(input).network.critical_stretch;
  return *std::min_element(limits.begin(), limits.end());
}

CaseFile with_rule(CaseFile input, CriticalStretch rule) {
  input.body.critical_stretch = rule;
  return input;
}

/// G_F goes with the square of the critical stretch.
TEST(FractureRule, SharesTheFractureEnergyBetweenBondsAndPath) {
  const CaseFile input = strip_case();
  ASSERT_EQ(input.body.critical_stretch, CriticalStretch::dissipated);
  const Model model = build_model(input);
  ASSERT_EQ(model.crack_cost.size(), 1u);
  EXPECT_GT(model.crack_cost[0], 1.1);
  EXPECT_NEAR(weakest(with_rule(input, CriticalStretch::lattice)) / weakest(input),
              std::sqrt(model.crack_cost[0]), 1e-12);
  EXPECT_TRUE(build_model(with_rule(input, CriticalStretch::lattice)).crack_cost.empty());
  EXPECT_TRUE(build_model(with_rule(input, CriticalStretch::continuum)).crack_cost.empty());
}

TEST(FractureRule, LeavesUnbreakableMaterialsUnbreakable) {
  CaseFile input = strip_case();
  input.analysis.type = AnalysisType::relaxation;
  input.materials[0].fracture_energy = INFINITY;
  EXPECT_TRUE(std::isinf(weakest(input)));
}

TEST(FractureRule, IsNotAskedInElasticAnalyses) {
  CaseFile input = strip_case();
  input.analysis.type = AnalysisType::elastic;
  const Model model = build_model(input);
  EXPECT_TRUE(model.network.critical_stretch.empty());
  EXPECT_TRUE(model.network.report.strengths.empty());
  EXPECT_TRUE(model.crack_cost.empty());
}

/// The bonds between two materials take the mean of what the bonds of each may release.
TEST(FractureRule, HoldsBetweenMaterials) {
  CaseFile input = strip_case();
  Region half = input.regions[0];
  half.name = "weak half";
  half.box.upper[0] = 0.5 * (half.box.lower[0] + half.box.upper[0]);
  input.regions.push_back(half);
  MaterialSection weak = input.materials[0];
  weak.name = "weak";
  weak.regions = {half.name};
  weak.fracture_energy *= 0.25;
  input.materials.push_back(weak);
  const std::vector<double> path = build_model(input).network.critical_stretch;
  const Model plain = build_model(with_rule(input, CriticalStretch::lattice));
  const double root = std::sqrt(build_model(input).crack_cost[0]);
  for (std::size_t b = 0; b < path.size(); ++b) {
    EXPECT_NEAR(path[b] * root, plain.network.critical_stretch[b],
                1e-12 * plain.network.critical_stretch[b]);
  }
}

bool has_note(const CaseFile& input, const std::string& part = "spacings: below 3") {
  const std::vector<std::string> notes = build_model(input).notes;
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(FractureRule, NotesShortHorizonsWhereBondsBreak) {
  CaseFile input = strip_case();
  input.body.horizon.reset();
  input.body.horizon_level.reset();
  input.body.horizon_ratio = 2.5;
  EXPECT_TRUE(has_note(input));
  input.body.horizon_ratio = 3.0;
  EXPECT_FALSE(has_note(input));
  input.body.horizon_ratio = 2.5;
  input.analysis.type = AnalysisType::elastic;
  EXPECT_FALSE(has_note(input));
}

TEST(FractureRule, NotesLatticesWhoseStepsDiffer) {
  const auto strip = [](double width) {
    CaseFile input = strip_case();
    input.regions[0].box.upper[0] = width;
    return input;
  };
  EXPECT_TRUE(has_note(strip(14.0), "whose steps differ by 40 %"));
  EXPECT_TRUE(has_note(strip(33.6), "whose steps differ by 12 %"));
  EXPECT_FALSE(has_note(strip(32.0), "whose steps differ")) << "by 7 %";
  EXPECT_FALSE(has_note(strip_case(), "not measured"));
  EXPECT_FALSE(has_note(with_rule(strip(14.0), CriticalStretch::lattice), "not measured"))
      << "no cost is taken";
  CaseFile elastic = strip(14.0);
  elastic.analysis.type = AnalysisType::elastic;
  EXPECT_FALSE(has_note(elastic, "not measured"));
}

TEST(FractureRule, NotesIrregularCloudsInSpaceWhoseBondsBend) {
  Model model;
  model.crack_cost = {1.0};
  model.lattice.pattern = Pattern::irregular;
  model.network.particles.dim = 3;
  model.network.critical_stretch = {INFINITY, 0.1};
  EXPECT_FALSE(unmeasured_cost_note(model)) << "measured";
  model.network.bending = {1.0, 1.0};
  EXPECT_TRUE(unmeasured_cost_note(model));
  model.network.particles.dim = 2;
  EXPECT_FALSE(unmeasured_cost_note(model)) << "measured";
  model.network.particles.dim = 3;
  model.network.critical_stretch = {INFINITY, INFINITY};
  EXPECT_FALSE(unmeasured_cost_note(model)) << "nothing can break";
}

}  // namespace
}  // namespace perilink
