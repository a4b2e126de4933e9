#include "io/case/scan_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string scan_head = "case = \"b.toml\"\n";

ScanFile scan_of(const std::string& text) { return parse_scan(scan_head + text, "scans/a.toml"); }

std::vector<std::string> texts_of(const ScanFile& scan) {
  std::vector<std::string> texts;
  for (const ScanMember& member : scan.members) texts.push_back(member_text(member.settings));
  return texts;
}

TEST(ScanFile, ValuesFormAGridWhoseLastKeyVariesFastest) {
  const ScanFile scan = scan_of(
      "title = \"A grid\"\n[values]\n\"materials[1].area\" = [2, 3.5]\nbody.surface = [\"none\", "
      "\"ghost\"]\n");
  EXPECT_EQ(scan.case_path, "scans/b.toml");
  EXPECT_EQ(scan.title, "A grid");
  EXPECT_THAT(scan.keys, ElementsAre("materials[1].area", "body.surface"));
  EXPECT_THAT(texts_of(scan), ElementsAre("materials[1].area = 2, body.surface = none",
                                          "materials[1].area = 2, body.surface = ghost",
                                          "materials[1].area = 3.5, body.surface = none",
                                          "materials[1].area = 3.5, body.surface = ghost"));
  EXPECT_EQ(scan.members[3].find("body.surface")->line, 5);
}

TEST(ScanFile, RunsAreSetsOfValues) {
  const ScanFile scan =
      scan_of("[[runs]]\nbody.spacing = 1\n[[runs]]\ntitle = \"b\"\n\"body.spacing\" = 2\n");
  EXPECT_THAT(scan.keys, ElementsAre("body.spacing", "title"));
  EXPECT_THAT(texts_of(scan), ElementsAre("body.spacing = 1", "title = b, body.spacing = 2"));
  EXPECT_EQ(scan.members[0].find("title"), nullptr);
  EXPECT_EQ(scan.members[1].line, 4);
}

struct ScanRefusal {
  const char* name;
  std::string text;
  int line;
  std::string says;
};
void PrintTo(const ScanRefusal& refusal, std::ostream* stream) { *stream << refusal.name; }

class ScanRefusals : public testing::TestWithParam<ScanRefusal> {};

TEST_P(ScanRefusals, NameLineAndFault) {
  try {
    parse_scan(GetParam().text, "a.toml");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, GetParam().line) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Keys, ScanRefusals,
    testing::Values(
        ScanRefusal{"noCase", "[values]\na = [1]\n", 1, "case: is missing"},
        ScanRefusal{"nothing", scan_head, 0, "neither [values] nor [[runs]]"},
        ScanRefusal{"both", scan_head + "[values]\na = [1]\n[[runs]]\na = 1\n", 4, "has both"},
        ScanRefusal{"misspelt", scan_head + "[value]\na = [1]\n", 2, "did you mean `values`?"},
        ScanRefusal{"unknownKey", scan_head + "jobs = 2\n[values]\na = [1]\n", 2, "no such key"},
        ScanRefusal{"noList", scan_head + "[values]\na = 1\n", 3,
                    "values.a: is the integer 1, but must be a list"},
        ScanRefusal{"emptyList", scan_head + "[values]\na = []\n", 3, "values.a: is empty"},
        ScanRefusal{"twice", scan_head + "[values]\na = [1, 2, 1]\n", 3, "holds 1 twice"},
        ScanRefusal{"noQuotes", scan_head + "[values]\na[1].b = [1]\n", 3,
                    "between quotes: \"materials[1].tensile_strength\" = [2, 3]"},
        ScanRefusal{"noKeys", scan_head + "[values]\n", 2, "has no key"},
        ScanRefusal{"emptyRun", scan_head + "[[runs]]\n", 2, "runs[1]: has no key"},
        ScanRefusal{"oneTable", scan_head + "[runs]\na = 1\n", 2, "[[runs]] with two brackets"},
        ScanRefusal{"noSeeds", scan_head + "seeds = 0\n", 2, "seeds: is the integer 0"},
        ScanRefusal{"emptySeeds", scan_head + "seeds = []\n", 2, "seeds: is empty"},
        ScanRefusal{"seedTwice", scan_head + "seeds = [3, 4, 3]\n", 2, "holds a seed twice"},
        ScanRefusal{"seedTooLarge", scan_head + "seeds = [1000000]\n", 2, "seeds"},
        ScanRefusal{"aCase", "[body]\nspacing = 1\n", 1, "`perilink run a.toml`"},
        ScanRefusal{"aStudy", "[vary]\nspacing = [1]\n", 1, "`perilink converge a.toml`"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

ScanFile seeded(const std::string& text, const std::string& random) {
  ScanFile scan = scan_of(text);
  give_seeds(scan, parse_toml(random, "b.toml"));
  return scan;
}

TEST(ScanFile, SeedsVaryFastest) {
  const ScanFile scan = seeded("seeds = [5, 2]\n[values]\nbody.spacing = [1, 2]\n", "[[random]]\n");
  EXPECT_THAT(scan.keys, ElementsAre("body.spacing", "random[1].seed"));
  EXPECT_THAT(
      texts_of(scan),
      ElementsAre("body.spacing = 1, random[1].seed = 5", "body.spacing = 1, random[1].seed = 2",
                  "body.spacing = 2, random[1].seed = 5", "body.spacing = 2, random[1].seed = 2"));
  EXPECT_TRUE(is_seed(scan, "random[1].seed"));
  EXPECT_FALSE(is_seed(scan, "body.spacing"));
}

TEST(ScanFile, SeedsThatAreEqualInTheCaseStayEqual) {
  const ScanFile scan = seeded("seeds = 2\n",
                               "[[random]]\nseed = 1\n[[random]]\nseed = 2\n"
                               "[[random]]\n");
  EXPECT_THAT(texts_of(scan),
              ElementsAre("random[1].seed = 1, random[2].seed = 1000001, random[3].seed = 1",
                          "random[1].seed = 2, random[2].seed = 1000002, random[3].seed = 2"));
}

TEST(ScanFile, SeedsPlaceUnstructuredParticles) {
  const ScanFile scan = seeded("seeds = [5, 2]\n", "[body]\npattern = \"unstructured\"\n");
  EXPECT_THAT(texts_of(scan), ElementsAre("body.seed = 5", "body.seed = 2"));
  EXPECT_TRUE(is_seed(scan, "body.seed"));
  EXPECT_THROW(seeded("seeds = 2\n", "[body]\npattern = \"hexagonal\"\n"), InputError);
}

/// The seed of the body is that of the members with unstructured particles.
TEST(ScanFile, SeedsFollowThePatternsOfTheMembers) {
  const std::string body = "[body]\npattern = \"hexagonal\"\n";
  const ScanFile scan =
      seeded("seeds = [4, 9]\n[values]\nbody.pattern = [\"unstructured\"]\n", body);
  EXPECT_THAT(texts_of(scan), ElementsAre("body.pattern = unstructured, body.seed = 4",
                                          "body.pattern = unstructured, body.seed = 9"));
  const ScanFile mixed =
      seeded("seeds = [4]\n[values]\nbody.pattern = [\"hexagonal\", \"unstructured\"]\n",
             body + "[[random]]\nseed = 7\n");
  EXPECT_THAT(texts_of(mixed),
              ElementsAre("body.pattern = hexagonal, random[1].seed = 4",
                          "body.pattern = unstructured, random[1].seed = 4, body.seed = 1000004"));
  EXPECT_THROW(
      seeded("seeds = 2\n[values]\nbody.pattern = [\"unstructured\", \"rectangular\"]\n", body),
      InputError);
}

TEST(ScanFile, RefusesSeedsWithoutUseOrGivenTwice) {
  EXPECT_THROW(seeded("seeds = 2\n", "title = \"a\"\n"), InputError);
  EXPECT_THROW(seeded("seeds = 2\n[values]\n\"random[1].seed\" = [1, 2]\n", "[[random]]\n"),
               InputError);
}

TEST(ScanFile, RefusesMoreMembersThanDirectoriesHaveNames) {
  std::string list = "[0";
  for (int k = 1; k <= 100; ++k) list += ", " + std::to_string(k);
  list += "]";
  EXPECT_THROW(scan_of("[values]\na = " + list + "\nb = " + list + "\n"), InputError);
}

}  // namespace
}  // namespace perilink
