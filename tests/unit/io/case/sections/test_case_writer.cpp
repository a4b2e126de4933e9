#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "io/case/case_file.hpp"
#include "support/case_texts.hpp"

namespace perilink {
namespace {

TEST(CaseWriter, WritesWhatItReads) {
  for (const char* text : {small_case, full_case, mesh_case, lattice_case}) {
    const CaseFile input = parse_case(text, "case.toml");
    const std::string written = write_case(input);
    const CaseFile again = parse_case(written, "written.toml");
    EXPECT_EQ(write_case(again), written);
    EXPECT_EQ(again.title, input.title);
    EXPECT_EQ(again.body.mesh, input.body.mesh);
    ASSERT_EQ(again.regions.size(), input.regions.size());
    for (std::size_t i = 0; i < input.regions.size(); ++i) {
      EXPECT_EQ(again.regions[i].group, input.regions[i].group);
      EXPECT_EQ(again.regions[i].box.upper, input.regions[i].box.upper) << "to the last bit";
    }
    EXPECT_EQ(again.materials.back().fracture_energy, input.materials.back().fracture_energy);
    EXPECT_EQ(again.supports.size(), input.supports.size());
    EXPECT_EQ(again.displacements.size(), input.displacements.size());
    ASSERT_EQ(again.loads.size(), input.loads.size());
    for (std::size_t i = 0; i < input.loads.size(); ++i) {
      EXPECT_EQ(again.loads[i].force, input.loads[i].force);
    }
    ASSERT_EQ(again.cracks.size(), input.cracks.size());
    for (std::size_t i = 0; i < input.cracks.size(); ++i) {
      EXPECT_EQ(again.cracks[i].points, input.cracks[i].points);
    }
    EXPECT_EQ(again.rebar.size(), input.rebar.size());
    EXPECT_EQ(again.analysis.load_factors, input.analysis.load_factors);
    EXPECT_EQ(again.stop.displacement, input.stop.displacement);
    EXPECT_EQ(again.output.fields_at, input.output.fields_at);
  }
}

/// Every example reads back from what is written, so that results run again.
TEST(CaseWriter, WritesExamplesThatReadBack) {
  int examples = 0;
  for (const char* folder : {"/meshes", "/tests/cli/malformed/bases"}) {
    const std::filesystem::path place = std::string(PERILINK_SOURCE_DIR) + folder;
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      if (entry.path().extension() != ".toml") continue;
      SCOPED_TRACE(entry.path());
      const std::string written = write_case(read_case_file(entry.path().string()));
      EXPECT_EQ(write_case(parse_case(written, entry.path().string())), written);
      ++examples;
    }
  }
  EXPECT_GT(examples, 30);
}

TEST(CaseWriter, WritesNumbersThatReadBackExactly) {
  std::mt19937_64 random(20050806);
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  CaseFile input = parse_case(small_case, "");
  for (int i = 0; i < 1000; ++i) {
    const double number = std::pow(10.0, exponent(random));
    input.materials[0].youngs_modulus = number;
    EXPECT_EQ(parse_case(write_case(input), "").materials[0].youngs_modulus, number);
  }
}

TEST(CaseWriter, WritesMicropolarBodies) {
  CaseFile input = parse_case(full_case, "");
  input.body.model = BodyModel::micropolar;
  input.body.torsion = 0.25;
  for (MaterialSection& material : input.materials) material.poissons_ratio = 0.2;
  input.supports.at(0).fix = {true, false, true, false, true, true};
  const CaseFile again = parse_case(write_case(input), "");
  EXPECT_EQ(again.body.model, BodyModel::micropolar);
  EXPECT_EQ(again.body.torsion, 0.25);
  EXPECT_EQ(again.supports.at(0).fix, input.supports.at(0).fix);
}

TEST(CaseWriter, WritesBodiesOfLinearElements) {
  const CaseFile input = parse_case(
      replaced(fmt::format("{}[analysis]\ntype = \"elastic\"\nsolver = \"direct\"\n", small_case),
               "horizon_ratio = 3", "method = \"linear_elements\""),
      "");
  const std::string written = write_case(input);
  EXPECT_EQ(parse_case(written, "").body.method, BodyMethod::linear_elements);
  EXPECT_EQ(parse_case(written, "").analysis.solver, LinearSolver::direct);
  EXPECT_EQ(write_case(parse_case(written, "")), written);
}

TEST(CaseWriter, WritesMinusZeroAsZero) {
  const CaseFile input = parse_case(replaced(small_case, "x = [0,", "x = [-0.0,"), "");
  EXPECT_EQ(write_case(input), write_case(parse_case(small_case, "")));
}

TEST(CaseWriter, WritesEveryNameSoThatItReadsBack) {
  CaseFile input = parse_case(small_case, "");
  for (const char* name :
       {"a \"b\"", "back\\slash", "tab", "#", "[x]", "ü", "'''", "\"\"\"", "a = 1"}) {
    input.title = name;
    input.regions[0].name = input.materials[0].regions[0] = input.loads[0].region = name;
    const CaseFile again = parse_case(write_case(input), "");
    EXPECT_EQ(again.title, name);
    EXPECT_EQ(again.regions[0].name, name);
  }
}

}  // namespace
}  // namespace perilink
