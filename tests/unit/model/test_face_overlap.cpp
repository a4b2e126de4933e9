#include "model/face_overlap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// A strip of width 40, cut along y = 45 up to x = 32.
Model cut_strip(std::optional<bool> closing) {
  CaseFile input = test::strip_case();
  CrackSection crack;
  crack.points = {{-1.0, 45.0, 0.0}, {32.0, 45.0, 0.0}};
  crack.closing = closing;
  input.cracks.push_back(crack);
  return build_model(input);
}

/// Displacements along y: of a part above the crack that turns about the other side by `above` at
/// x = 0, and of a compression everywhere.
std::vector<double> motion_of(const Model& model, double above, double strain) {
  std::vector<double> motion;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const auto x = model.network.particles.position(i);
    const double turned = x[1] > 45.0 ? above * (1.0 - x[0] / 40.0) : 0.0;
    motion.insert(motion.end(), {0.0, turned - strain * x[1]});
  }
  return motion;
}

TEST(FaceOverlap, IsTheDeepestApproachOfTwoFaces) {
  const Model model = cut_strip(std::nullopt);
  const FaceOverlap found = deepest_overlap(model, motion_of(model, -0.5, 0.001));
  EXPECT_NEAR(found.depth, 0.5 + 0.001 * 10.0, 1e-12) << "of rows ten apart";
  EXPECT_EQ(found.entry, 0u);
  const auto text = warning_about_overlap(found, 2);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("the faces of crack 1 pass through each other, by up to 0.51"));
  EXPECT_EQ(deepest_overlap(model, motion_of(model, -0.1, 0.0), found).depth, found.depth);
}

TEST(FaceOverlap, IsNoneOfOpenFacesSoundMaterialAndGivenClosing) {
  const Model model = cut_strip(std::nullopt);
  EXPECT_EQ(deepest_overlap(model, motion_of(model, 0.5, 0.001)).depth, 0.0);
  EXPECT_EQ(deepest_overlap(model, motion_of(model, 0.0, 0.001)).depth, 0.0);
  EXPECT_EQ(warning_about_overlap({}, 2), std::nullopt);
  for (const bool closing : {false, true}) {
    const Model known = cut_strip(closing);
    EXPECT_EQ(deepest_overlap(known, motion_of(known, -0.5, 0.001)).depth, 0.0);
  }
}

}  // namespace
}  // namespace perilink
