#include "app/report/report_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

const UnitNames newtons = UnitNames::of("N, mm");

TomlValue plate() {
  return parse_toml(R"(title = "Plate"
[body]
problem = "plane_stress"
thickness = 50
spacing = 2.5
[[regions]]
name = "plate"
x = [0, 100]
[[materials]]
regions = ["plate", "rim"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[supports]]
region = "left"
fix = ["x", "y"]
[[displacements]]
region = "right"
x = -0.5
[[cracks]]
points = [[0, 1], [2, 3]]
[output]
fields_at = []
)",
                    "plate.toml");
}

TEST(ReportWords, TablesHaveNamesValuesAndUnits) {
  const std::vector<WordedTable> tables = tables_of_case(plate(), newtons);
  ASSERT_EQ(tables.size(), 7u) << "a title is no table";
  EXPECT_EQ(tables[0].heading, "Body");
  EXPECT_EQ(tables[0].entries.at(1), std::pair(std::string("thickness"), std::string("50 mm")));
  EXPECT_EQ(tables[1].entries.at(0), std::pair(std::string("plate"), std::string("x 0, 100 mm")));
  EXPECT_EQ(tables[2].entries.at(0).first, "plate, rim");
  EXPECT_EQ(tables[2].entries.at(0).second, "youngs modulus 30000 N/mm²; fracture energy infinite");
  EXPECT_EQ(tables[3].entries.at(0).second, "fix x, y");
  EXPECT_EQ(tables[4].entries.at(0).second, "x -0.5 mm");
  EXPECT_EQ(tables[5].entries.at(0),
            std::pair(std::string("1"), std::string("points (0, 1), (2, 3) mm")));
  EXPECT_EQ(tables[6].entries.at(0).second, "none");
}

TEST(ReportWords, SentencesSayWhatIsKnown) {
  const auto summary = nlohmann::ordered_json::parse(R"({
    "analysis": "damage", "model": "bond_based", "status": "completed", "reason": "it stopped",
    "particles": 861, "bonds": 10956, "spacing": 5.0, "horizon": 15.0, "peak_load": 128.634,
    "peak_displacement": 0.0226, "broken_bonds": 40, "dissipated_energy": 4.3,
    "energy_error": 4.2e-13})");
  std::string text;
  for (const std::string& sentence : sentences_of_run(summary, plate(), newtons)) {
    text += sentence + " ";
  }
  EXPECT_THAT(text, HasSubstr("Damage analysis."));
  EXPECT_THAT(text,
              HasSubstr("The body (plane stress, bond based) has 861 particles, 5 mm apart, "
                        "and 10956 bonds within a horizon of 15 mm; its thickness is 50 mm."));
  EXPECT_THAT(text, HasSubstr("Status: completed (it stopped)."));
  EXPECT_THAT(text, HasSubstr("Peak load 128.6 N at displacement 0.0226 mm."));
  EXPECT_THAT(text, HasSubstr("Dissipated energy 4.3 N mm; 40 broken bonds"));
}

TEST(ReportWords, UnknownFactsAreLeftOut) {
  EXPECT_TRUE(sentences_of_run(nlohmann::ordered_json::object(), {}, {}).empty());
  const auto summary = nlohmann::ordered_json::parse(R"({"status": "running", "peak_load": null})");
  const auto sentences = sentences_of_run(summary, {}, {});
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0], "Status: running.");
}

TEST(ReportWords, TextsOfUsersArePrintable) {
  const TomlValue root = parse_toml("[[regions]]\nname = \"a\\u001bb\"\nx = [0, 1]\n", "case.toml");
  EXPECT_EQ(tables_of_case(root, {}).at(0).entries.at(0).first, "a\\x1bb");
}

}  // namespace
}  // namespace perilink
