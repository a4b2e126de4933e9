#include "io/case/case_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// The strip with other values, given as on the command line.
CaseFile set_strip(const std::vector<std::string>& settings) {
  return parse_case(test::strip_text, "strip.toml", parse_settings(settings), {});
}

TEST(CaseSettings, ReplaceAddAndCreate) {
  const CaseFile input =
      set_strip({"body.spacing=5", "body.pattern = hexagonal", "materials[1].fracture_energy=0.25",
                 "regions.upper end.y=[70, 80]", "regions.\"lower end\".x=[0, 30]",
                 "regions[1].x[2]=30", "title=A strip, 1/2", "stop={load_fraction = 0.5}"});
  EXPECT_EQ(input.body.spacing, 5.0);
  EXPECT_EQ(input.body.pattern, Pattern::hexagonal);
  EXPECT_EQ(input.materials[0].fracture_energy, 0.25);
  EXPECT_EQ(input.title, "A strip, 1/2");
  EXPECT_EQ(input.stop.load_fraction, 0.5);
  const CaseFile edited = parse_case(
      [] {
        std::string text = test::strip_text;
        text.replace(text.find("y = [60, 80]"), 12, "y = [70, 80]");
        text.replace(text.find("x = [0, 40]"), 11, "x = [0, 30]");
        text.replace(text.find("x = [0, 40]"), 11, "x = [0, 30]");
        return text;
      }(),
      "");
  const std::string expected = write_case(edited), found = write_case(input);
  const std::string tables = "[[regions]]";
  EXPECT_EQ(found.substr(found.find(tables), found.find("[[materials]]") - found.find(tables)),
            expected.substr(expected.find(tables),
                            expected.find("[[materials]]") - expected.find(tables)));
}

TEST(CaseSettings, TakeThePlaceOfAlternatives) {
  EXPECT_EQ(set_strip({"body.columns=9"}).body.spacing, std::nullopt);
  EXPECT_EQ(set_strip({"body.horizon_level=3"}).body.horizon, std::nullopt);
  EXPECT_FALSE(set_strip({"loads[1].body_force=[0, 1]"}).loads[0].force.has_value());
}

struct SettingRefusal {
  const char* name;
  std::vector<std::string> settings;
  std::vector<std::string> says;
};
void PrintTo(const SettingRefusal& refusal, std::ostream* stream) { *stream << refusal.name; }

class SettingRefusals : public testing::TestWithParam<SettingRefusal> {};

TEST_P(SettingRefusals, NameTheOptionTheValueAndTheRemedy) {
  try {
    set_strip(GetParam().settings);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& part : GetParam().says) EXPECT_THAT(error.what(), HasSubstr(part));
    EXPECT_TRUE(std::string(error.what()).starts_with("--set ")) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Keys, SettingRefusals,
    testing::Values(
        SettingRefusal{"noValue", {"body.spacing"}, {"--set body.spacing: has no value", "KEY="}},
        SettingRefusal{
            "emptyValue", {"body.spacing="}, {"--set body.spacing: has nothing after ="}},
        SettingRefusal{"noKey", {"=3"}, {"has no key"}},
        SettingRefusal{"noName", {"body..spacing=3"}, {"body..spacing: is not a key"}},
        SettingRefusal{"brokenToml", {"regions[1].x=[0, 1"}, {"is [0, 1, which is not TOML"}},
        SettingRefusal{"misspeltKey",
                       {"body.spacng=3"},
                       {"--set body.spacng: [body] has no such key", "did you mean `spacing`?"}},
        SettingRefusal{"misspeltTable",
                       {"bdy.spacing=3"},
                       {"--set bdy: a case has no such table", "did you mean `body`?"}},
        SettingRefusal{"keyWithoutTable", {"spacing=3"}, {"`spacing` belongs to [body]"}},
        SettingRefusal{"wrongType",
                       {"body.spacing=fine"},
                       {"--set body.spacing: is the text \"fine\", but must be a number"}},
        SettingRefusal{"wrongValue",
                       {"body.spacing=-1"},
                       {"--set body.spacing: is -1, but must be greater than zero"}},
        SettingRefusal{"wrongWord",
                       {"body.pattern=hexgonal"},
                       {"--set body.pattern: is \"hexgonal\"", "did you mean `hexagonal`?"}},
        SettingRefusal{
            "noSuchEntry",
            {"materials[2].fracture_energy=1"},
            {"there is no materials[2]: the list has 1 entry", "only entry is materials[1]"}},
        SettingRefusal{"zero", {"regions[0].x=[0, 1]"}, {"\"0\" between brackets", "from 1"}},
        SettingRefusal{"nameInBrackets",
                       {"regions[upper end].x=[0, 1]"},
                       {"\"upper end\" between brackets", "'regions.upper end.KEY'"}},
        SettingRefusal{"noSuchName",
                       {"regions.uper end.x=[0, 1]"},
                       {"no entry of regions is named \"uper end\"", "from 1 to 4",
                        "did you mean `upper end`?"}},
        SettingRefusal{
            "noNumber", {"materials.fracture_energy=1"}, {"the only entry is materials[1]"}},
        SettingRefusal{"noSuchList",
                       {"cracks[1].points=[[0, 0], [1, 1]]"},
                       {"the case has no cracks", "add it"}},
        SettingRefusal{"keyOfANumber", {"body.spacing.x=1"}, {"body.spacing is the number 10"}},
        SettingRefusal{"numberOfATable", {"body[1].spacing=1"}, {"body is a table", "leave out"}},
        SettingRefusal{"twice", {"body.spacing=5", "body.spacing=4"}, {"is given twice"}},
        SettingRefusal{"alternatives",
                       {"body.spacing=5", "body.columns=4"},
                       {"--set body.spacing: is given together with `columns`"}},
        SettingRefusal{
            "contradiction", {"body.mesh=a.msh"}, {"--set body.mesh: is given together"}},
        SettingRefusal{"otherKind", {"body.torsion=2"}, {"--set body.torsion: "}}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

/// Faults that the body shows come later, with the place of their key.
TEST(CaseSettings, AreNamedWhereTheCaseLooksForAKey) {
  EXPECT_EQ(set_strip({"body.spacing=5"}).where("body.spacing").line, from_option);
  EXPECT_EQ(set_strip({"stop.broken_bonds=5"}).where("stop.load_fraction").line, from_option);
  EXPECT_GT(set_strip({"body.spacing=5"}).where("body.horizon").line, 0);
}

TEST(CaseSettings, StudiesKeepTheirOwnKeys) {
  try {
    parse_case(test::strip_text, "strip.toml", parse_settings({"body.spacing=5"}),
               parse_toml("columns = 9", "").entries);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--set body.spacing: is given, but the study varies it"));
  }
}

TEST(CaseSettings, AreReadBackFromTheirText) {
  for (const char* text :
       {"body.spacing=0.5", "a=2", "a=2.0", "a=\"b \\\"c\\\" \\\\\"", "a=[1, [2]]", "a=true",
        "\"a=b\".c=1e-07", "a={\"b\" = \"ü\"}", "a=inf"}) {
    EXPECT_EQ(setting_text(parse_setting(text)), text);
  }
  EXPECT_EQ(setting_text(parse_setting("a = 1 - x^2")), "a=\"1 - x^2\"");
}

}  // namespace
}  // namespace perilink
