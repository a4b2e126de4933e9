#include "app/model/from_case/case_bonds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// A strip whose bonds ranks can make.
CaseFile strip_in_parts() {
  CaseFile input = test::strip_case();
  input.body.surface = Surface::none;
  input.analysis.type = AnalysisType::elastic;
  return input;
}

TEST(CaseBonds, OfABoxAreLeftToRanks) {
  for (const bool frames : {false, true}) {
    CaseFile input = strip_in_parts();
    if (frames) {
      input.body.model = BodyModel::micropolar;
      input.materials[0].poissons_ratio = 0.2;
      input.cracks.push_back({{{-1, 45, 0}, {15, 45, 0}}});
    }
    const Model alone = build_model(input), shared = build_model(input, {}, 2);
    EXPECT_FALSE(alone.pattern);
    ASSERT_TRUE(shared.pattern);
    EXPECT_EQ(shared.network.num_elements(), 0);
    EXPECT_EQ(shared.pattern->num_bonds(), alone.network.num_elements());
    EXPECT_EQ(shared.network.particles.positions, alone.network.particles.positions);
    EXPECT_EQ(shared.loads.forces, alone.loads.forces);
    EXPECT_EQ(shared.unknowns.number, alone.unknowns.number);
    EXPECT_EQ(shared.unknowns.prescribed, alone.unknowns.prescribed);
    EXPECT_THAT(shared.notes.front(), testing::HasSubstr("2 processes makes its own part"));
    EXPECT_EQ(shared.network.cut_by_crack, alone.network.cut_by_crack);
    EXPECT_EQ(shared.notes.size(), alone.notes.size() + 1);
  }
}

TEST(CaseBonds, AreLeftToRanksWhereMaterialsDifferInNamesOnly) {
  CaseFile input = strip_in_parts();
  input.materials.push_back(input.materials[0]);
  input.materials[1].regions = {"lower end"};
  input.materials[0].poissons_ratio = 1.0 / 3.0;  // as bonds in plane stress have
  input.materials[1].poissons_ratio.reset();
  EXPECT_FALSE(have_unlike_constants(input));
  EXPECT_TRUE(build_model(input, {}, 2).pattern);
  input.materials[0].poissons_ratio = 0.333;  // with the digits that users write
  EXPECT_FALSE(have_unlike_constants(input));
  input.body.model = BodyModel::micropolar;  // whose bonds follow the ratio
  EXPECT_TRUE(have_unlike_constants(input));
}

TEST(CaseBonds, AreRefusedAloneAndByRanksForTheSameReasons) {
  CaseFile free = strip_in_parts(), missed = strip_in_parts(), cut_through = strip_in_parts();
  free.supports.clear();
  missed.cracks.push_back({{{41, 45, 0}, {55, 45, 0}}});
  cut_through.cracks.push_back({{{-1, 45, 0}, {41, 45, 0}}});
  for (const CaseFile& input : {free, missed, cut_through}) {
    std::string first;
    for (const int parts : {1, 2}) {
      try {
        build_model(input, {}, parts);
        ADD_FAILURE() << parts;
      } catch (const InputError& error) {
        if (parts == 1) first = error.what();
        EXPECT_EQ(error.what(), first);
      }
    }
  }
}

TEST(CaseBonds, AreMadeByOneProcessWhereRanksDoNotKnowEnough) {
  const std::vector<std::function<void(CaseFile&)>> changes = {
      [](CaseFile& input) { input.analysis.type = AnalysisType::damage; },
      [](CaseFile& input) { input.analysis.solver = LinearSolver::direct; },
      [](CaseFile& input) { input.body.surface = Surface::calibrated; },  // in the plane
      [](CaseFile& input) {                                               // in two parts, both held
        input.cracks.push_back({{{-1, 35, 0}, {41, 35, 0}}});
        input.supports.push_back(input.supports[0]);
        input.supports[1].region = "middle";
      },
      [](CaseFile& input) {
        input.materials.push_back(input.materials[0]);
        input.materials[1].regions = {"lower end"};
        input.materials[1].youngs_modulus *= 2.0;
      }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    CaseFile input = strip_in_parts();
    changes[k](input);
    const Model model = build_model(input, {}, 2);
    EXPECT_FALSE(model.pattern) << k;
    EXPECT_GT(model.network.num_elements(), 0) << k;
  }
}

}  // namespace
}  // namespace perilink
