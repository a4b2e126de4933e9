// One small case with an edit each: what `check` and `run` refuse alike, in the same words, before
// anything is computed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/gmsh_mesher.hpp"
#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink {
namespace {

using test::run_program;
using test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Edit {
  const char* name;
  std::vector<std::pair<std::string, std::string>> replaced;
  std::vector<std::string> message;
};

void PrintTo(const Edit& edit, std::ostream* stream) { *stream << edit.name; }

/// A region "half" of its own material in the right half of the strip.
std::string right_half(const std::string& modulus) {
  return "[[regions]]\nname = \"half\"\nx = [1, 2]\ny = [0, 1]\n[[materials]]\nregion = \"half\"\n"
         "youngs_modulus = " +
         modulus + "\nfracture_energy = 1\n[[supports]]";
}

const std::string driven = "[[displacements]]\nregion = \"right side\"\nx = 0.04";

const std::vector<Edit>& edits() {
  static const std::vector<Edit> all = {
      {"horizon200",
       {{"horizon = 0.6", "horizon_ratio = 200"}},
       {"body.horizon_ratio: makes the", "the body's diagonal is 2.23607",
        "bonded to every other"}},
      {"horizon200calibrated",
       {{"horizon = 0.6", "horizon_ratio = 200"}, {"\"none\"", "\"calibrated\""}},
       {"bonded to every other"}},
      {"horizon2e9", {{"horizon = 0.6", "horizon_ratio = 2e9"}}, {"bonded to every other"}},
      {"horizon1e40", {{"horizon = 0.6", "horizon = 1e40"}}, {"body.horizon: makes the horizon"}},
      {"tooManyBonds",
       {{"spacing = 0.25", "spacing = 0.001"}, {"horizon = 0.6", "horizon = 0.1"}},
       {"body.horizon:", "3.14e+04 neighbours", "3.1e+10 bonds"}},
      {"horizonAlongRows",
       {{"horizon = 0.6", "horizon_ratio = 1"}},
       {"body.horizon_ratio:", "do not resist shear", "horizon_ratio = 1.4143"}},
      {"stiffness",
       {{"[[supports]]", right_half("1e22")}},
       {"materials[2].youngs_modulus: is 1e+22", "1e+20 times", "at most 1e+10 times"}},
      {"unbending",
       {{"[body]", "[body]\nmodel = \"micropolar\""},
        {"\"none\"", "\"calibrated\""},
        {"youngs_modulus", "poissons_ratio = 0.3333\nyoungs_modulus"}},
       {"materials[1].poissons_ratio: is 0.3333", "do not bend", "at most 0.3330"}},
      {"smallDisplacement",
       {{"x = 0.04", "x = \"1e-300\""}},
       {"displacements[1]", "too small to compute with"}},
      {"smallBodyForce",
       {{driven, "[[loads]]\nregion = \"strip\"\nbody_force = [\"1e-300\", 0]"}},
       {"loads[1]", "too small to compute with"}},
      {"smallTraction",
       {{driven, "[[tractions]]\nregion = \"right side\"\ntraction = [\"1e-300*x\", 0]"}},
       {"tractions[1]", "too small to compute with"}},
      {"largeDisplacement",
       {{"x = 0.04", "x = \"1e200\""}},
       {"displacements[1].x: is 1e+200", "below 1e+50"}},
      {"idleLoad",
       {{driven, "[[loads]]\nregion = \"corner\"\nforce = [1, 1]"}},
       {"loads[1]", "supports hold all particles"}},
      {"mereShift",
       {{"fix = [\"x\"]", "fix = [\"y\"]"}},
       {"displacements[1]", "only moves the body as a whole"}},
      {"regionBetweenParticles",
       {{"x = [2, 2]", "x = [2.05, 2.1]"}},
       {"no particle lies in the region \"right side\"", "0.05 outside, at (2, 0)"}},
      {"holesLeaveNothing",
       {{"youngs_modulus", "holes = [\"all\"]\nyoungs_modulus"},
        {"[[materials]]", "[[regions]]\nname = \"all\"\nx = [-1, 3]\ny = [0, 1]\n[[materials]]"}},
       {"materials[1].holes", "take all of the material away"}},
  };
  return all;
}

class EditedCase : public ::testing::TestWithParam<Edit> {
 protected:
  test::TemporaryDirectory directory_;
};

TEST_P(EditedCase, IsRefusedByCheckAndRun) {
  std::string text = test::tension_strip_case;
  for (const auto& [from, to] : GetParam().replaced) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  }
  std::filesystem::create_directories(directory_ / "work");
  write_text(directory_ / "case.toml", text);
  for (const char* command : {"check", "run"}) {
    const auto end = run_program(directory_ / "work", {command, "../case.toml"});
    EXPECT_EQ(end.exit_status, 2) << command;
    EXPECT_THAT(end.err, HasSubstr("perilink: bad input: ../case.toml:")) << command;
    for (const std::string& part : GetParam().message) {
      EXPECT_THAT(end.err, HasSubstr(part)) << command;
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory_ / "work"));
}

INSTANTIATE_TEST_SUITE_P(Program, EditedCase, ::testing::ValuesIn(edits()),
                         [](const auto& edit) { return std::string(edit.param.name); });

class MeshedCase : public ::testing::Test {
 protected:
  MeshedCase() { std::filesystem::create_directories(directory_ / "work"); }

  test::ProcessEnd run(const std::string& mesh, std::vector<std::string> arguments) const {
    write_text(directory_ / "case.toml",
               "[body]\nmesh = \"" + mesh +
                   "\"\nhorizon_ratio = 3\n[[regions]]\nname = \"all\"\nx = [-9, 9]\ny = [-9, 9]\n"
                   "[[regions]]\nname = \"left\"\nx = [-9, 0.3]\ny = [-9, 9]\n"
                   "[[materials]]\nregion = \"all\"\nyoungs_modulus = 1\nfracture_energy = 1\n"
                   "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
                   "[[loads]]\nregion = \"all\"\nforce = [1, 0]\n"
                   "[analysis]\ntype = \"elastic\"\n");
    arguments.insert(arguments.begin() + 1, "../case.toml");
    return run_program(directory_ / "work", arguments);
  }

  test::TemporaryDirectory directory_;
};

/// Two triangles written twice with corners of their own, shifted by a quarter of the square.
TEST_F(MeshedCase, OverlappingPartsAreRefusedWithTheirElements) {
  write_text(
      directory_ / "body.msh",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 8 1 8\n2 1 0 8\n1\n2\n3\n4\n5\n6\n7\n8\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.51 0 0\n1.51 0 0\n1.51 1 0\n0.51 1 0\n$EndNodes\n"
      "$Elements\n1 4 21 24\n2 1 2 4\n21 1 2 3\n22 1 3 4\n23 5 6 7\n24 5 7 8\n$EndElements\n");
  for (const char* command : {"check", "run"}) {
    const auto end = run("body.msh", {command});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, AllOf(HasSubstr("../case.toml:2: body.mesh: names ../body.msh"),
                               HasSubstr("the elements 21 and 23 overlap at ("),
                               HasSubstr("BooleanFragments or Coherence")));
  }
}

TEST_F(MeshedCase, ScriptsThatRunCommandsNeedTrust) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  write_text(directory_ / "body.geo",
             "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\nMesh.MeshSizeMax = 0.3;\n"
             "SystemCall \"touch planted\";\n");
  for (const char* command : {"check", "run"}) {
    const auto refused = run("body.geo", {command});
    EXPECT_EQ(refused.exit_status, 2);
    EXPECT_THAT(refused.err, HasSubstr("body.geo:4: has SystemCall, which runs a command"));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "work/planted"));
    EXPECT_EQ(run("body.geo", {command, "--trust-geometry"}).exit_status, 0);
    EXPECT_TRUE(std::filesystem::remove(directory_ / "work/planted"));
  }
}

TEST(EditedStudy, MembersWithHugeHorizonsAreRefused) {
  const test::TemporaryDirectory directory;
  write_text(directory / "case.toml", test::tension_strip_case);
  write_text(directory / "study.toml",
             "case = \"case.toml\"\n[vary]\nspacing = [0.25, 0.125]\nhorizon_ratio = [200, 2e9]\n"
             "[[error]]\nquantity = \"strain_energy\"\nreference = 0.04\n");
  std::filesystem::create_directories(directory / "work");
  const auto end = run_program(directory / "work", {"converge", "../study.toml"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("bonded to every other"));
}

/// One case for an implicit and an explicit run.
TEST(ServingCase, KeysOfTheOtherAnalysisAreNoted) {
  const test::TemporaryDirectory directory;
  std::string text = test::tension_strip_case;
  text.replace(text.find("type = "), 16, "type = \"elastic\"\nduration = 1\nrows = 20");
  write_text(directory / "case.toml", text);
  std::filesystem::create_directories(directory / "work");
  const std::string note = "not used by type = \"elastic\": analysis.duration, analysis.rows";
  EXPECT_THAT(run_program(directory / "work", {"check", "../case.toml"}).out, HasSubstr(note));
  const auto end = run_program(directory / "work", {"run", "../case.toml", "--out", "out"});
  EXPECT_EQ(end.exit_status, 0);
  EXPECT_THAT(end.out, HasSubstr(note));
  EXPECT_THAT(test::read_text(directory / "work/out/summary.json"),
              HasSubstr("analysis.duration, analysis.rows"));
}

}  // namespace
}  // namespace perilink
