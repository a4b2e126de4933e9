#include "io/mesh/gmsh_tokens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.hpp"

namespace perilink {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> texts(const std::string& script) {
  std::vector<GmshToken> hidden;
  std::vector<std::string> result;
  for (const GmshToken& token : gmsh_tokens(script, "a.geo", hidden)) result.push_back(token.text);
  return result;
}

/// As gmsh's own rules cut: the longest number or word counts.
TEST(GmshTokens, CutsNumbersWordsTextsAndSigns) {
  EXPECT_THAT(texts("1e5Save"), ElementsAre("1e5", "Save", ""));
  EXPECT_THAT(texts("1e+5e 2.e-3.5"), ElementsAre("1e+5", "e", "2.e-3", ".5", ""));
  EXPECT_THAT(texts("a_1+=1.;b.c\n"), ElementsAre("a_1", "+=", "1.", ";", "b", ".", "c", ""));
  EXPECT_THAT(texts("x>>\"a 'b' //\"'c\"'"), ElementsAre("x", ">>", "a 'b' //", "c\"", ""));
  EXPECT_THAT(texts("a/*\n*/b//c\nd"), ElementsAre("a", "b", "d", ""));
}

TEST(GmshTokens, KnowsLinesAndComments) {
  std::vector<GmshToken> hidden;
  const auto tokens = gmsh_tokens("a\n\"b\nc\" d // e\n/* f\n*/ g", "a.geo", hidden);
  ASSERT_EQ(tokens.size(), 5u);
  EXPECT_EQ(tokens[1].line, 2);
  EXPECT_EQ(tokens[1].kind, GmshToken::Kind::text);
  EXPECT_EQ(tokens[2].line, 3);
  EXPECT_EQ(tokens[3].line, 5);
  ASSERT_EQ(hidden.size(), 2u);
  EXPECT_EQ(hidden[1].line, 4);
}

TEST(GmshTokens, RefusesWithTheLine) {
  std::vector<GmshToken> hidden;
  try {
    gmsh_tokens("a\nb\n\"c", "a.geo", hidden);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.geo:3: has a text without an end\n  mend the script");
  }
}

}  // namespace
}  // namespace perilink
