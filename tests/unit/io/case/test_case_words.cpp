#include "io/case/case_words.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(CaseWords, ReadBackAsTheSameEnumerator) {
  for (const Pattern pattern :
       {Pattern::rectangular, Pattern::hexagonal, Pattern::cubic, Pattern::face_centred}) {
    EXPECT_EQ(pattern_of(word_of(pattern)), pattern);
  }
  for (const Surface surface : {Surface::none, Surface::ghost}) {
    EXPECT_EQ(surface_of(word_of(surface)), surface);
  }
}

TEST(CaseWords, SpellWhatTheyMean) {
  EXPECT_EQ(word_of(Pattern::hexagonal), "hexagonal");
  EXPECT_EQ(word_of(Pattern::face_centred), "face_centred");
  EXPECT_EQ(word_of(Surface::ghost), "ghost");
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
