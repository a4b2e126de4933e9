#include "results/case_json_schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "io/case/case_keys.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using SchemaJson = nlohmann::json;

const SchemaJson& json_schema() {
  static const SchemaJson json = SchemaJson::parse(case_json_schema());
  return json;
}

TEST(CaseJsonSchema, HasEveryTableAndKey) {
  for (const TableSchema& table : case_schema()) {
    const std::string name(table.name);
    SchemaJson keys = json_schema();
    if (!name.empty())
      keys = table.list ? keys["properties"][name]["items"] : keys["properties"][name];
    EXPECT_EQ(keys["additionalProperties"], false) << name;
    for (const KeySchema& key : table.keys) {
      const SchemaJson& entry = keys["properties"][std::string(key.name)];
      EXPECT_TRUE(entry.contains("type") || entry.contains("anyOf")) << name << "." << key.name;
      EXPECT_THAT(entry["description"].get<std::string>(), HasSubstr("Values: "))
          << name << "." << key.name;
    }
  }
}

TEST(CaseJsonSchema, HasTypesRangesWordsAndDefaults) {
  const SchemaJson& analysis = json_schema()["properties"]["analysis"]["properties"];
  EXPECT_EQ(analysis["iterations"]["type"], "integer");
  EXPECT_EQ(analysis["iterations"]["minimum"], 1);
  EXPECT_EQ(analysis["iterations"]["default"], 1000000);
  EXPECT_EQ(analysis["safety"]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(analysis["safety"]["maximum"], 1.0);
  EXPECT_EQ(analysis["control"]["enum"], (SchemaJson{"events", "steps"}));
  EXPECT_EQ(analysis["control"]["default"], "events");
  EXPECT_FALSE(analysis["ramp_time"].contains("default")) << "it is the duration";
  EXPECT_EQ(analysis["load_factors"]["items"]["minimum"], 0.0);
  const SchemaJson& materials = json_schema()["properties"]["materials"]["items"]["properties"];
  EXPECT_EQ(materials["compression_ratio"]["default"], 6);
  EXPECT_FALSE(materials["compression_threshold"].contains("default")) << "it follows `variant`";
  EXPECT_EQ(materials["softening_error"]["minimum"], 1e-5);
  const SchemaJson& loads = json_schema()["properties"]["point_loads"]["items"]["properties"];
  EXPECT_FALSE(loads["force"].contains("default"));
}

TEST(CaseJsonSchema, HasKeysThatATableNeeds) {
  EXPECT_EQ(json_schema()["required"], (SchemaJson{"body", "regions", "materials"}));
  const SchemaJson& loads = json_schema()["properties"]["loads"]["items"];
  EXPECT_EQ(loads["required"], SchemaJson::array({"region"}));
  EXPECT_EQ(loads["oneOf"][1]["required"], SchemaJson::array({"body_force"}));
}

TEST(CaseJsonSchema, TakesUnitsAndMeaningsFromThePage) {
  const SchemaJson& materials = json_schema()["properties"]["materials"]["items"]["properties"];
  EXPECT_EQ(materials["density"]["description"],
            "mass per volume. Values: > 0 [M/L³]. Default: needed: explicit, state-based.");
  EXPECT_THAT(case_reference(), HasSubstr("\n[[materials]]\n"));
  EXPECT_THAT(case_reference(), HasSubstr("  density: mass per volume."));
}

TEST(CaseJsonSchema, NamesKeysAsSettings) {
  EXPECT_THAT(settable_keys(),
              testing::IsSupersetOf({"title", "body.spacing", "materials[1].density"}));
}

}  // namespace
}  // namespace perilink
