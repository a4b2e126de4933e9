// Inputs that `check` and `run` refuse in identical words before they compute: the cases of
// malformed/run and some with extra files.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/gmsh_mesher.hpp"
#include "support/case_tables.hpp"
#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using test::run_program;
using test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class EditedCase : public ::testing::TestWithParam<test::CaseEntry> {
 protected:
  test::TemporaryDirectory directory_;
};

TEST_P(EditedCase, IsRefusedByCheckAndRun) {
  ASSERT_EQ(GetParam().base, "tension_strip_case");
  std::filesystem::create_directories(directory_ / "work");
  write_text(directory_ / "case.toml", test::edited_text(GetParam(), test::tension_strip_case));
  for (const char* command : {"check", "run"}) {
    const auto end = run_program(directory_ / "work", {command, "../case.toml"});
    EXPECT_EQ(end.exit_status, 2) << command;
    EXPECT_THAT(end.err, HasSubstr("perilink: bad input: ../case.toml:")) << command;
    for (const std::string& part : GetParam().expected) {
      EXPECT_THAT(end.err, HasSubstr(part)) << command;
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory_ / "work"));
}

INSTANTIATE_TEST_SUITE_P(Program, EditedCase, ::testing::ValuesIn(test::read_case_tables("run")),
                         [](const auto& entry) { return entry.param.name; });

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
                   "[analysis]\ntype = \"elastic\"\n" +
                   more_);
    arguments.insert(arguments.begin() + 1, "../case.toml");
    return run_program(directory_ / "work", arguments);
  }

  test::TemporaryDirectory directory_;
  std::string more_;  ///< at the end of the case
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

TEST_F(MeshedCase, MeshesOfOtherFormatsAreRefusedWithWhatConvertsThem) {
  const struct {
    const char *mesh, *text, *fault, *advice;
  } meshes[] = {
      {"body.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n",
       "body.msh:2: is in version \"4\" of gmsh's format",
       "gmsh \"../body.msh\" -save -format msh41 -o \"../body_41.msh\""},
      {"body.inp", "*ELEMENT, TYPE=CAX4\n1, 1, 2, 3, 4\n", "body.inp:1: has axisymmetric elements",
       "mesh the solid in space"},
      {"body.med", "\x89HDF", "no mesh of gmsh", "meshio convert \"../body.med\" \"../body.msh\""},
      {"body.vtk", "# vtk DataFile Version 2.0\n", "no mesh of gmsh",
       "gmsh \"../body.vtk\" -save -format msh41 -o \"../body_41.msh\""},
  };
  for (const auto& [mesh, text, fault, advice] : meshes) {
    write_text(directory_ / mesh, text);
    for (const char* command : {"check", "run"}) {
      const auto end = run(mesh, {command});
      EXPECT_EQ(end.exit_status, 2);
      EXPECT_THAT(end.err, AllOf(HasSubstr(fault), HasSubstr(advice)));
    }
  }
}

/// A square of 8 by 8 squares of two triangles, and a bent curve across them.
std::string square_with_curve() {
  constexpr int count = 8;
  std::string nodes, cells;
  for (int k = 0; k < (count + 1) * (count + 1); ++k) {
    nodes += fmt::format("{} {} 0\n", 0.125 * (k % (count + 1)), 0.125 * (k / (count + 1)));
  }
  for (int k = 0; k < count * count; ++k) {
    const int a = k % count + k / count * (count + 1) + 1, d = a + count + 1;
    cells += fmt::format("{} {} {} {}\n{} {} {} {}\n", 2 * k + 4, a, a + 1, d, 2 * k + 5, a + 1,
                         d + 1, d);
  }
  std::string tags;
  for (int k = 1; k <= 85; ++k) tags += fmt::format("{}\n", k);
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"bars\"\n2 2 \"all\"\n"
         "$EndPhysicalNames\n$Entities\n0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n1 0 0 0 1 1 0 1 2 0\n"
         "$EndEntities\n$Nodes\n1 85 1 85\n2 1 0 85\n" +
         tags + nodes +
         "0.05 0.1 0\n0.4 0.1 0\n0.7 0.1 0\n0.9 0.9 0\n$EndNodes\n"
         "$Elements\n2 131 1 131\n1 1 1 3\n1 83 82\n2 83 84\n3 84 85\n2 1 2 128\n" +
         cells + "$EndElements\n";
}

TEST_F(MeshedCase, BarsDrawnInTheMeshAreThoseOfTheirPoints) {
  write_text(directory_ / "body.msh", square_with_curve());
  const std::string steel = "youngs_modulus = 50\narea = 0.1\n";
  std::vector<std::string> fields;
  for (const std::string place :
       {"group = \"bars\"", "points = [[0.05, 0.1], [0.7, 0.1], [0.9, 0.9]]"}) {
    more_ = "[[rebar]]\n" + place + "\n" + steel;
    const auto end = run("body.msh", {"run", "--out", "out", "--force"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
    fields.push_back(test::read_text(directory_ / "work/out/bars_000.csv"));
  }
  EXPECT_EQ(fields[0], fields[1]);
  more_ = "[[rebar]]\ngroup = \"bar\"\n" + steel;
  for (const char* command : {"check", "run"}) {
    const auto end = run("body.msh", {command});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, AllOf(HasSubstr("rebar[1].group: is \"bar\""), HasSubstr("`bars`")));
  }
}

TEST_F(MeshedCase, CurvesBesideTheMeshAreNoRegions) {
  write_text(directory_ / "body.msh", square_with_curve());
  more_ = "[[regions]]\nname = \"tie\"\ngroup = \"bars\"\n";
  for (const char* command : {"check", "run"}) {
    const auto end = run("body.msh", {command});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(
        end.err,
        AllOf(HasSubstr("regions[3].group: is \"bars\", a line of which, at (0.4, 0.1), is not "
                        "an edge of a cell"),
              HasSubstr("Coherence")));
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
    EXPECT_THAT(refused.err,
                HasSubstr("body.geo:4: names the command SystemCall, which is not on the list"));
    EXPECT_THAT(refused.err, HasSubstr("--trust-geometry"));
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

/// Elastic answers of calibrated lattices do not depend on it.
TEST(ServingCase, ElasticAnalysesNeedNoFractureEnergy) {
  const test::TemporaryDirectory directory;
  const std::string key = "fracture_energy = \"infinite\"\n";
  std::filesystem::create_directories(directory / "work");
  std::vector<std::string> histories;
  for (const std::string& line : {std::string(), key, std::string("fracture_energy = 0.1\n")}) {
    const std::string text = replaced(test::tension_strip_case, key, line);
    write_text(directory / "work/case.toml", replaced(text, "\"none\"", "\"calibrated\""));
    const auto check = run_program(directory / "work", {"check", "case.toml"});
    EXPECT_THAT(check.out, HasSubstr("breakable bonds    none: the analysis is elastic\n"));
    const auto end = run_program(directory / "work", {"run", "case.toml", "--out", "r", "--force"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
    for (const char* word : {"critical stretch ", "energy correction", "strength", "infinite"}) {
      EXPECT_THAT(check.out, Not(HasSubstr(word))) << line;
      EXPECT_THAT(end.out, Not(HasSubstr(word))) << line;
    }
    histories.push_back(test::read_text(directory / "work/r/history.csv"));
  }
  EXPECT_EQ(histories[0], histories[1]);
  EXPECT_EQ(histories[0], histories[2]);
}

}  // namespace
}  // namespace perilink
