#include "io/case/case_words.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(CaseWords, SpellWhatTheyMean) {
  EXPECT_EQ(word_of(Pattern::hexagonal), "hexagonal");
  EXPECT_EQ(word_of(Pattern::face_centred), "face_centred");
  EXPECT_EQ(word_of(Surface::calibrated), "calibrated");
  EXPECT_EQ(word_of(Problem::three_dimensional), "three_dimensional");
  EXPECT_EQ(word_of(BodyMethod::linear_elements), "linear_elements");
  EXPECT_EQ(word_of(BodyModel::particles), "particles");
  EXPECT_EQ(word_of(Constants::continuum), "continuum");
  EXPECT_EQ(word_of(CriticalStretch::continuum), "continuum");
  EXPECT_EQ(word_of(LatticeRules::least_2018), "2018");
  EXPECT_EQ(word_of(LatticeRules::mean_2017), "2017");
  EXPECT_EQ(word_of(AnalysisType::explicit_), "explicit");
  EXPECT_EQ(word_of(AnalysisType::relaxation), "relaxation");
  EXPECT_EQ(word_of(LoadControl::steps), "steps");
  EXPECT_EQ(word_of(RigidBodyModes::pin), "pin");
  EXPECT_EQ(word_of(FactorRoute::cholmod_updown), "cholmod_updown");
  EXPECT_EQ(word_of(FactorRoute::refactorize), "refactorize");
  EXPECT_EQ(word_of(MassScaling::none), "volume");
  EXPECT_EQ(word_of(Strain::green), "green");
  EXPECT_EQ(word_of(Refinement::mesh_size), "mesh_size");
  EXPECT_EQ(word_of(Quantity::dissipated_energy), "dissipated_energy");
  EXPECT_EQ(word_of(Reference::extrapolated), "extrapolated");
  EXPECT_EQ(word_of(RigidMotion::removed), "removed");
  EXPECT_TRUE(is_flat(Pattern::hexagonal));
  EXPECT_FALSE(is_flat(Pattern::cubic));
}

TEST(CaseWords, KnowGeometriesByTheirNames) {
  for (const char* name : {"a.geo", "b/c.STEP", "d.stp", "e.Brep"}) EXPECT_TRUE(is_geometry(name));
  for (const char* name : {"a.msh", "geo", "step.", "a.geo.msh", ""}) {
    EXPECT_FALSE(is_geometry(name));
  }
  EXPECT_TRUE(is_gmsh_script("a.GEO"));
  EXPECT_FALSE(is_gmsh_script("a.step"));
}

}  // namespace
}  // namespace perilink
