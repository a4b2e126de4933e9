#include "io/case/sections/case_unused.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a user gives who compares an implicit run with an explicit one and one to rest.
std::string serving_all(const std::string& type) {
  const std::string text = replaced(small_case, "fracture_energy", "density = 1\nfracture_energy");
  return text + "[analysis]\ntype = \"" + type + R"("
control = "events"
factor = "refactorize"
duration = 2
rows = 20
damping_rate = 3
tolerance = 1e-3

[stop]
broken_bonds = 7

[output]
fields_every = 5
fields_times = [1, 2]
)";
}

TEST(CaseUnused, OneCaseServesAllAnalyses) {
  const CaseFile damage = parse_case(serving_all("damage"), "a.toml");
  EXPECT_THAT(damage.source.unused,
              ElementsAre("analysis.duration", "analysis.rows", "analysis.damping_rate",
                          "analysis.tolerance", "output.fields_times"));
  EXPECT_EQ(damage.analysis.factor, FactorRoute::refactorize);
  EXPECT_EQ(damage.stop.broken_bonds, 7);
  EXPECT_THAT(damage.output.fields_times, IsEmpty());
  EXPECT_EQ(damage.output.fields_every, 5);

  const CaseFile elastic = parse_case(serving_all("elastic"), "a.toml");
  EXPECT_THAT(
      elastic.source.unused,
      ElementsAre("analysis.control", "analysis.duration", "analysis.rows", "analysis.damping_rate",
                  "analysis.factor", "stop", "output.fields_every", "output.fields_times"));
  EXPECT_FALSE(elastic.stop.broken_bonds);
  EXPECT_FALSE(elastic.output.fields_every);

  const CaseFile moving = parse_case(serving_all("explicit"), "a.toml");
  EXPECT_THAT(moving.source.unused,
              ElementsAre("analysis.control", "analysis.tolerance", "analysis.factor",
                          "stop.broken_bonds", "output.fields_every"));
  EXPECT_EQ(moving.analysis.duration, 2.0);
  EXPECT_EQ(moving.analysis.ramp_time, 2.0);
  EXPECT_FALSE(moving.stop.broken_bonds);
  EXPECT_THAT(moving.output.fields_times, ElementsAre(1, 2));

  const CaseFile resting = parse_case(serving_all("relaxation"), "a.toml");
  EXPECT_THAT(resting.source.unused,
              ElementsAre("analysis.control", "analysis.duration", "analysis.rows",
                          "analysis.damping_rate", "analysis.factor", "stop.broken_bonds",
                          "output.fields_every", "output.fields_times"));
  EXPECT_EQ(resting.analysis.tolerance, 1e-3);
  EXPECT_THAT(resting.analysis.load_factors, ElementsAre(1));
}

TEST(CaseUnused, TheNoteNamesTypeAndKeys) {
  EXPECT_EQ(note_of_unused(parse_case(small_case, "a.toml")), std::nullopt);
  const std::string text = std::string(small_case) + "[analysis]\nduration = 1\n";
  EXPECT_EQ(note_of_unused(parse_case(text, "a.toml")),
            "not used by type = \"damage\": analysis.duration");
}

TEST(CaseUnused, ValuesOfOtherTypesMustBeRight) {
  for (const char* line : {"duration = -1", "rows = \"many\"", "masses = \"small\"",
                           "tolerance = 2", "iterations = 0", "strain = \"large\""}) {
    EXPECT_THAT(message_of(std::string(small_case) + "[analysis]\n" + line + "\n"),
                HasSubstr("analysis."))
        << line;
  }
  EXPECT_THAT(message_of(replaced(serving_all("explicit"), "\"events\"", "\"often\"")),
              HasSubstr("analysis.control"));
}

TEST(CaseUnused, AreNotWritten) {
  const std::string once = write_case(parse_case(serving_all("damage"), "a.toml"));
  EXPECT_THAT(once, Not(HasSubstr("duration")));
  EXPECT_THAT(parse_case(once, "a.toml").source.unused, IsEmpty());
}

std::string message_of_type(const std::string& type, const std::string& analysis,
                            const std::string& tables = "") {
  const std::string text = replaced(small_case, "fracture_energy", "density = 1\nfracture_energy");
  return message_of(text + "[analysis]\nduration = 1\ntype = \"" + type + "\"\n" + analysis + "\n" +
                    tables);
}

TEST(CaseUnused, ChecksUnusedListsLikeUsedOnes) {
  for (const char* type : {"damage", "elastic", "explicit", "relaxation"}) {
    EXPECT_THAT(message_of_type(type, "", "[output]\nfields_at = [5, 3]"),
                HasSubstr("output.fields_at: has 3 after 5"))
        << type;
    EXPECT_THAT(message_of_type(type, "", "[output]\nfields_times = [0.5, 0.5]"),
                HasSubstr("output.fields_times: has 0.5 after 0.5"))
        << type;
    EXPECT_THAT(message_of_type(type, "", "[output]\nfields_times = [-2]"),
                HasSubstr("output.fields_times: is -2, but must be greater than zero"))
        << type;
  }
  for (const char* type : {"elastic", "explicit", "relaxation"}) {
    EXPECT_THAT(message_of_type(type, "load_factors = []"),
                HasSubstr("analysis.load_factors: is empty"))
        << type;
    EXPECT_THAT(message_of_type(type, "load_factors = [0.0, 0]"), HasSubstr("only zeros")) << type;
    EXPECT_EQ(message_of_type(type, "load_factors = [0, 2]"), "accepted") << type;
  }
}

TEST(CaseUnused, ChecksUnusedKeysThatExcludeEachOther) {
  for (const char* type : {"damage", "elastic", "explicit"}) {
    EXPECT_THAT(message_of_type(type, "", "[elements]\nsize = 1\nalert = 0.5\nalert_strain = 0.1"),
                HasSubstr("elements.alert_strain: is given together with `alert`"))
        << type;
    EXPECT_THAT(message_of_type(type, "time_step = 0.1\nsafety = 0.5"),
                HasSubstr("analysis.safety: is given together with `time_step`"))
        << type;
    EXPECT_THAT(message_of_type(type, "", "[stop]\nabove = 1"),
                HasSubstr("stop.above: is given without `gauge`"))
        << type;
  }
}

}  // namespace
}  // namespace perilink
