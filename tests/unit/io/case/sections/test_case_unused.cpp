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
  EXPECT_THAT(damage.unused,
              ElementsAre("analysis.duration", "analysis.rows", "analysis.damping_rate",
                          "analysis.tolerance", "output.fields_times"));
  EXPECT_EQ(damage.analysis.factor, FactorRoute::refactorize);
  EXPECT_EQ(damage.stop.broken_bonds, 7);
  EXPECT_THAT(damage.output.fields_times, IsEmpty());
  EXPECT_EQ(damage.output.fields_every, 5);

  const CaseFile elastic = parse_case(serving_all("elastic"), "a.toml");
  EXPECT_THAT(elastic.unused, ElementsAre("analysis.control", "analysis.duration", "analysis.rows",
                                          "analysis.damping_rate", "analysis.factor", "stop",
                                          "output.fields_every", "output.fields_times"));
  EXPECT_FALSE(elastic.stop.broken_bonds);
  EXPECT_FALSE(elastic.output.fields_every);

  const CaseFile moving = parse_case(serving_all("explicit"), "a.toml");
  EXPECT_THAT(moving.unused,
              ElementsAre("analysis.control", "analysis.tolerance", "analysis.factor",
                          "stop.broken_bonds", "output.fields_every"));
  EXPECT_EQ(moving.analysis.duration, 2.0);
  EXPECT_EQ(moving.analysis.ramp_time, 2.0);
  EXPECT_FALSE(moving.stop.broken_bonds);
  EXPECT_THAT(moving.output.fields_times, ElementsAre(1, 2));

  const CaseFile resting = parse_case(serving_all("relaxation"), "a.toml");
  EXPECT_THAT(resting.unused,
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
  EXPECT_THAT(parse_case(once, "a.toml").unused, IsEmpty());
}

}  // namespace
}  // namespace perilink
