#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string base = small_case;

std::string with_loading(const std::string& table) { return base + "\n" + table; }

TEST(CaseLoading, ReadsTractionsAndPressures) {
  const CaseFile input =
      parse_case(with_loading("[[tractions]]\nregion = \"block\"\ntraction = [\"1 - y^2/4\", 2]\n"
                              "[[tractions]]\nregion = \"surface\"\npressure = -3\n"),
                 "case.toml");
  ASSERT_EQ(input.tractions.size(), 2u);
  EXPECT_EQ((*input.tractions[0].traction)[0].formula, "1 - y^2/4");
  EXPECT_EQ((*input.tractions[0].traction)[1].number, 2.0);
  EXPECT_FALSE(input.tractions[0].pressure);
  EXPECT_EQ(input.tractions[1].region, "surface");
  EXPECT_EQ(input.tractions[1].pressure->number, -3.0);
}

TEST(CaseLoading, ReadsFormulasOfDisplacementsAndBodyForces) {
  const CaseFile input =
      parse_case(with_loading("[[displacements]]\nregion = \"surface\"\nx = \"0.1*x*y\"\n"
                              "[[loads]]\nregion = \"body\"\nbody_force = [0, \"sin(pi*x)\"]\n"),
                 "case.toml");
  EXPECT_EQ(input.displacements[0].value[0]->formula, "0.1*x*y");
  EXPECT_FALSE(input.displacements[0].value[1]);
  EXPECT_EQ((*input.loads[1].body_force)[1].formula, "sin(pi*x)");
}

TEST(CaseLoading, WritesFormulasThatReadBack) {
  const std::string text = with_loading(
      "[[tractions]]\nregion = \"block\"\ntraction = [\"1 - y^2/4\", 2]\n"
      "[[tractions]]\nregion = \"surface\"\npressure = \"x\"\n"
      "[[displacements]]\nregion = \"surface\"\nx = \"0.1*x*y\"\n"
      "[[loads]]\nregion = \"body\"\nbody_force = [0, \"sin(pi*x)\"]\n");
  const std::string written = write_case(parse_case(text, ""));
  const CaseFile again = parse_case(written, "");
  EXPECT_EQ(write_case(again), written);
  EXPECT_EQ((*again.tractions[0].traction)[0].formula, "1 - y^2/4");
  EXPECT_EQ((*again.tractions[0].traction)[1].number, 2.0);
  EXPECT_EQ(again.tractions[1].pressure->formula, "x");
  EXPECT_EQ(again.displacements[0].value[0]->formula, "0.1*x*y");
  EXPECT_EQ((*again.loads[1].body_force)[1].formula, "sin(pi*x)");
}

const char* const micropolar_body = "columns = 11\nmodel = \"micropolar\"";

TEST(CaseLoading, ReadsPointLoadsSymmetryAndSprings) {
  const std::string text = with_loading(
      "[[point_loads]]\nat = [0.5, 2]\nforce = [0, -3]\n"
      "[[symmetry]]\naxis = \"x\"\nat = 0.0\n[[symmetry]]\naxis = \"y\"\nregion = \"block\"\n"
      "[[springs]]\nregion = \"surface\"\nstiffness = [0, 4]\n"
      "[[springs]]\nregion = \"block\"\ntotal = [1, 2]\n");
  for (const CaseFile& input :
       {parse_case(text, ""), parse_case(write_case(parse_case(text, "")), "")}) {
    ASSERT_EQ(input.point_loads.size(), 1u);
    EXPECT_EQ(input.point_loads[0].at, (Vector3{0.5, 2.0, 0.0}));
    EXPECT_EQ(input.point_loads[0].force, (Vector3{0.0, -3.0, 0.0}));
    ASSERT_EQ(input.symmetry.size(), 2u);
    EXPECT_EQ(input.symmetry[0].axis, 0);
    EXPECT_EQ(input.symmetry[0].at, 0.0);
    EXPECT_EQ(input.symmetry[1].axis, 1);
    EXPECT_EQ(input.symmetry[1].region, "block");
    ASSERT_EQ(input.springs.size(), 2u);
    EXPECT_EQ(*input.springs[0].stiffness, (Vector3{0.0, 4.0, 0.0}));
    EXPECT_EQ(*input.springs[1].total, (Vector3{1.0, 2.0, 0.0}));
  }
}

TEST(CaseLoading, ReadsMomentsOfMicropolarBodies) {
  const std::string text =
      replaced(replaced(with_loading("[[point_loads]]\nat = [0.5, 2]\nmoment = 7\n"),
                        "columns = 11", micropolar_body),
               "youngs_modulus = 30", "youngs_modulus = 30\npoissons_ratio = 0.2");
  for (const CaseFile& input :
       {parse_case(text, ""), parse_case(write_case(parse_case(text, "")), "")}) {
    EXPECT_EQ(input.point_loads[0].moment, (Vector3{0.0, 0.0, 7.0}));
    EXPECT_EQ(input.point_loads[0].force, (Vector3{}));
  }
}

TEST(CaseLoading, ReadsDrivenRotations) {
  const std::string flat = replaced(
      replaced(with_loading("[[displacements]]\nregion = \"block\"\nrotation = \"0.1*x\"\n"),
               "columns = 11", micropolar_body),
      "youngs_modulus = 30", "youngs_modulus = 30\npoissons_ratio = 0.2");
  for (const CaseFile& input :
       {parse_case(flat, ""), parse_case(write_case(parse_case(flat, "")), "")}) {
    EXPECT_EQ(input.displacements[0].value[5]->formula, "0.1*x");
    EXPECT_FALSE(input.displacements[0].value[0]);
  }
  EXPECT_THAT(message_of(replaced(flat, "rotation", "rz")),
              HasSubstr("displacements[1].rz: is no rotation of a body in two dimensions"));
}

TEST(CaseLoading, APointLoadAloneLoadsTheBody) {
  const std::string load = "[[loads]]\nregion = \"block\"\nforce = [0, -1]\n";
  EXPECT_EQ(message_of(replaced(base, load, "[[point_loads]]\nat = [0, 0]\nforce = [0, -3]\n")),
            "accepted");
}

/// Other refusals are entries of tests/cli/malformed/text.
TEST(CaseLoading, RefusesWithTheKeyAndWhatIsAllowed) {
  for (const auto& [table, text] : std::vector<std::pair<std::string, std::string>>{
           {"[[tractions]]\nregion = \"block\"\npressure = \"1 - q\"\n",
            "tractions[1].pressure: holds the formula \"1 - q\""},
           {"[[tractions]]\npressure = 1\n", "the name of the region whose surface is loaded"},
           {"[[symmetry]]\naxis = \"q\"\nat = 0\n", "Allowed: x, y"},
           {"[[symmetry]]\naxis = \"x\"\nregion = \"blok\"\n", "did you mean `block`?"},
           {"[[springs]]\nregion = \"block\"\ntotal = [0, 0]\n", "is zero in every direction"},
           {"[[springs]]\nregion = \"blok\"\ntotal = [0, 1]\n", "did you mean `block`?"}}) {
    EXPECT_THAT(message_of(with_loading(table)), HasSubstr(text));
  }
  EXPECT_THAT(message_of(replaced(base, "force = [0, -1]", "force = [0, \"x\"]")),
              HasSubstr("write numbers without quotes"))
      << "a total force has no position";
  EXPECT_THAT(message_of(replaced(base, "region = \"block\"\nyoungs", "region = \"body\"\nyoungs")),
              HasSubstr("no [[regions]] has that name"))
      << "materials say where the body is";
}

}  // namespace
}  // namespace perilink
