#include "io/case/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CaseFile, FillsInDefaults) {
  const CaseFile input = parse_case(small_case, "case.toml");
  EXPECT_EQ(input.source.path, "case.toml");
  EXPECT_EQ(input.title, "");
  EXPECT_EQ(input.body.problem, Problem::plane_stress);
  EXPECT_EQ(input.body.thickness, 1.0);
  EXPECT_EQ(input.body.pattern, Pattern::rectangular);
  EXPECT_EQ(input.body.surface, Surface::calibrated);
  EXPECT_EQ(input.body.columns, 11);
  EXPECT_EQ(input.body.spacing, std::nullopt);
  EXPECT_EQ(input.body.horizon_ratio, 3.0);
  EXPECT_EQ(input.body.micromodulus, Constants::lattice);
  EXPECT_EQ(input.body.critical_stretch, CriticalStretch::dissipated);
  ASSERT_EQ(input.materials.size(), 1u);
  EXPECT_EQ(input.materials[0].name, "material 1");
  EXPECT_EQ(input.materials[0].poissons_ratio, std::nullopt);
  EXPECT_EQ(input.analysis.type, AnalysisType::damage);
  EXPECT_EQ(input.analysis.control, LoadControl::events);
  EXPECT_EQ(input.analysis.rigid_body_modes, RigidBodyModes::refuse);
  EXPECT_EQ(input.analysis.factor, FactorRoute::in_place);
  EXPECT_TRUE(input.analysis.load_factors.empty());
  EXPECT_EQ(input.stop.broken_bonds, std::nullopt);
  EXPECT_TRUE(input.output.fields_at.empty());
  EXPECT_TRUE(input.rebar.empty());
}

TEST(CaseFile, ReadsEveryKey) {
  const CaseFile input = parse_case(full_case, "case.toml");
  EXPECT_EQ(input.title, "Say \"beam\" \\ Träger");
  EXPECT_EQ(input.units, "kN, m");
  EXPECT_EQ(input.body.problem, Problem::three_dimensional);
  EXPECT_EQ(input.body.pattern, Pattern::face_centred);
  EXPECT_EQ(input.body.spacing, 0.1);
  EXPECT_EQ(input.body.horizon, 0.25);
  EXPECT_EQ(input.body.micromodulus, Constants::continuum);
  EXPECT_EQ(input.body.critical_stretch, CriticalStretch::continuum);
  ASSERT_EQ(input.regions.size(), 2u);
  EXPECT_EQ(input.regions[0].name, "beam");
  EXPECT_THAT(input.regions[0].box.lower, ElementsAre(0.0, -2.5, 0.0));
  EXPECT_THAT(input.regions[0].box.upper, ElementsAre(1.0, 2.5, 1.0 / 3.0));
  ASSERT_EQ(input.materials.size(), 2u);
  EXPECT_EQ(input.materials[0].name, "concrete");
  EXPECT_EQ(input.materials[0].poissons_ratio, 0.25);
  EXPECT_EQ(input.materials[0].youngs_modulus, 30e6);
  EXPECT_EQ(input.materials[1].name, "material 2");
  EXPECT_THAT(input.materials[1].regions, ElementsAre("cap"));
  EXPECT_EQ(input.materials[1].fracture_energy, std::numeric_limits<double>::infinity());
  EXPECT_THAT(input.supports.at(0).fix, ElementsAre(true, false, true, false, false, false));
  EXPECT_THAT(input.displacements.at(0).value,
              ElementsAre(0.1, std::nullopt, -1.0, std::nullopt, std::nullopt, std::nullopt));
  EXPECT_EQ(input.loads.at(0).body_force, ExpressionVector(Vector3{0.0, 0.0, -25.0}));
  EXPECT_EQ(input.loads.at(0).force, std::nullopt);
  EXPECT_EQ(input.loads.at(1).force, (Vector3{1.0, 2.0, 3.0}));
  ASSERT_EQ(input.rebar.size(), 2u);
  EXPECT_EQ(input.rebar[0].points.at(1), (Vector3{0.5, 3.0, 0.05}));
  EXPECT_EQ(input.rebar[0].yield_strength, 500e3);
  EXPECT_FALSE(input.rebar[0].yields);
  EXPECT_FALSE(input.rebar[0].bond.slip_springs_break);
  EXPECT_EQ(input.rebar[1].yield_strength, std::nullopt);
  EXPECT_TRUE(input.rebar[1].yields);
  EXPECT_TRUE(input.rebar[1].bond.slip_springs_break);
  EXPECT_EQ(input.analysis.control, LoadControl::steps);
  EXPECT_THAT(input.analysis.load_factors, ElementsAre(0.1, 0.2, 1.0));
  EXPECT_EQ(input.analysis.rigid_body_modes, RigidBodyModes::pin);
  EXPECT_EQ(input.analysis.factor, FactorRoute::cholmod_updown);
  EXPECT_EQ(input.stop.broken_bonds, 10);
  EXPECT_EQ(input.stop.load_fraction, 0.1);
  EXPECT_EQ(input.stop.displacement, 0.3);
  EXPECT_THAT(input.output.fields_at, ElementsAre(1, 20));
  EXPECT_EQ(input.output.fields_every, 50);
}

TEST(CaseFile, TakesCubicPatternInSpaceByDefault) {
  const std::string text = replaced(full_case, "pattern = \"face_centred\"\n", "");
  EXPECT_EQ(parse_case(text, "").body.pattern, Pattern::cubic);
}

TEST(CaseFile, KnowsLinesOfKeys) {
  const CaseFile input = parse_case(small_case, "case.toml");
  EXPECT_EQ(input.where("body").line, 1);
  EXPECT_EQ(input.where("body.horizon_ratio").line, 3);
  EXPECT_EQ(input.where("regions[1].y").line, 8);
  EXPECT_EQ(input.where(item_key("loads", 0, "force")).line, 17);
  EXPECT_EQ(input.where("body.spacing").line, 1) << "an absent key has the line of its table";
  EXPECT_EQ(input.where("body.spacing").key, "body.spacing");
  EXPECT_EQ(input.where("analysis.type").line, 0);
  EXPECT_EQ(input.where("").line, 0);
  EXPECT_EQ(parse_case(full_case, "").where("materials[2].regions").line, 33);
}

TEST(CaseFile, AcceptsTomlOfOtherShapes) {
  const std::string inline_tables = R"(body = { columns = 11, horizon_ratio = 3 }
regions = [ { name = 'block', x = [0, 1], y = [0, 2] } ]
materials = [ { region = "block", youngs_modulus = 3_0, fracture_energy = 0.1 } ]
loads = [ { region = "block", force = [0, -1] } ]
)";
  EXPECT_EQ(write_case(parse_case(inline_tables, "")), write_case(parse_case(small_case, "")));
  const std::string marked = "\xEF\xBB\xBF# Maße in m\r\n" + std::string(small_case);
  EXPECT_EQ(write_case(parse_case(marked, "")), write_case(parse_case(small_case, "")));
}

TEST(CaseFile, SurvivesEveryTruncationOfAFile) {
  const std::string text = full_case;
  for (std::size_t length = 0; length < text.size(); ++length) {
    try {
      parse_case(text.substr(0, length), "cut.toml");
    } catch (const InputError&) {
    }
  }
}

TEST(CaseFile, RefusesHugeText) {
  EXPECT_THAT(message_of(std::string((std::size_t{16} << 20) + 1, '#')), HasSubstr("16 MiB"));
  EXPECT_THAT(message_of("title = \"" + std::string(std::size_t{1} << 20, 'x') + "\""),
              HasSubstr("1048576 characters"));
  EXPECT_THAT(message_of(std::string(std::size_t{1} << 20, '[')), HasSubstr("nest deeper"));
  EXPECT_THAT(message_of("[a" + std::string(std::size_t{1} << 20, '.')), HasSubstr("nest deeper"));
}

TEST(CaseFile, TellsFilesThatCannotBeRead) {
  const std::filesystem::path folder = testing::TempDir();
  EXPECT_THROW(read_case_file((folder / "no such case.toml").string()), FileError);
  EXPECT_THROW(read_case_file(folder.string()), FileError);
  EXPECT_THROW(read_case_file("/dev/zero"), FileError) << "a device never ends";
}

TEST(CaseFile, ReadsTheCasesOfThePaper) {
  const std::filesystem::path meshes = std::filesystem::path(PERILINK_SOURCE_DIR) / "meshes";
  const CaseFile tension = read_case_file((meshes / "block_tension.toml").string());
  const CaseFile compression = read_case_file((meshes / "block_compression.toml").string());
  const CaseFile cantilever = read_case_file((meshes / "rc_cantilever.toml").string());
  EXPECT_EQ(tension.loads.at(0).force, (Vector3{0.0, -100.0, 0.0}));
  EXPECT_EQ(compression.loads.at(0).force, (Vector3{0.0, 100.0, 0.0}));
  EXPECT_EQ(tension.stop.broken_bonds, 150);
  EXPECT_EQ(cantilever.stop.broken_bonds, 400);
  EXPECT_EQ(cantilever.rebar.at(0).area, 3.0);
  for (const CaseFile* input : {&tension, &compression, &cantilever}) {
    EXPECT_EQ(input->body.surface, Surface::ghost);
    EXPECT_EQ(input->body.horizon, 31.45);
    EXPECT_EQ(input->regions.size(), 4u);
    EXPECT_EQ(input->materials.at(2).fracture_energy, 0.00095);
  }
}

}  // namespace
}  // namespace perilink
