#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string base = small_case;

std::string with(const std::string& table) { return base + "\n" + table; }

TEST(CaseLoading, ReadsTractionsAndPressures) {
  const CaseFile input = parse_case(
      with("[[tractions]]\nregion = \"block\"\ntraction = [\"1 - y^2/4\", 2]\n"
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
  const CaseFile input = parse_case(
      with("[[displacements]]\nregion = \"surface\"\nx = \"0.1*x*y\"\n"
           "[[loads]]\nregion = \"body\"\nbody_force = [0, \"sin(pi*x)\"]\n"),
      "case.toml");
  EXPECT_EQ(input.displacements[0].value[0]->formula, "0.1*x*y");
  EXPECT_FALSE(input.displacements[0].value[1]);
  EXPECT_EQ((*input.loads[1].body_force)[1].formula, "sin(pi*x)");
}

TEST(CaseLoading, WritesFormulasThatReadBack) {
  const std::string text =
      with("[[tractions]]\nregion = \"block\"\ntraction = [\"1 - y^2/4\", 2]\n"
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

TEST(CaseLoading, RefusesFormulasWithTheirPlace) {
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\npressure = \"1 - q\"\n")),
              HasSubstr("tractions[1].pressure: holds the formula \"1 - q\""));
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\ntraction = [\"z\", 0]\n")),
              HasSubstr("write a number, or a formula of x and y with"));
  EXPECT_THAT(message_of(with("[[displacements]]\nregion = \"block\"\nx = true\n")),
              HasSubstr("must be a number or a formula"));
  EXPECT_THAT(message_of(with("[[displacements]]\nregion = \"block\"\nx = \"\"\n")),
              HasSubstr("nothing at character 1"));
  EXPECT_THAT(message_of(replaced(base, "force = [0, -1]", "force = [0, \"x\"]")),
              HasSubstr("write numbers without quotes"))
      << "a total force has no position";
}

TEST(CaseLoading, RefusesTractionsThatCannotBe) {
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\n")),
              HasSubstr("has none of `traction` or `pressure`"));
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\npressure = 0\n")),
              HasSubstr("is zero"));
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\ntraction = [0, 0]\n")),
              HasSubstr("is zero in every direction"));
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"block\"\ntraction = [1]\n")),
              HasSubstr("has 1 components, but the body has 2 dimensions"));
  EXPECT_THAT(message_of(with("[[tractions]]\npressure = 1\n")),
              HasSubstr("the name of the region whose surface is loaded"));
  EXPECT_THAT(message_of(with("[[tractions]]\nregion = \"surfaces\"\npressure = 1\n")),
              HasSubstr("did you mean `surface`?"));
  EXPECT_THAT(message_of(replaced(with("[[tractions]]\nregion = \"block\"\npressure = 1\n"),
                                  "columns = 11", "columns = 11\nsurface = \"ghost\"")),
              HasSubstr("middle of their cells"));
}

TEST(CaseLoading, KeepsTheNamesThatEveryCaseHas) {
  EXPECT_THAT(message_of(replaced(base, "name = \"block\"", "name = \"body\"")),
              HasSubstr("a name that stands for the whole body in every case"));
  EXPECT_THAT(message_of(replaced(base, "name = \"block\"", "name = \"surface\"")),
              HasSubstr("a name that stands for its whole surface in every case"));
  EXPECT_THAT(message_of(replaced(base, "region = \"block\"\nyoungs", "region = \"body\"\nyoungs")),
              HasSubstr("no [[regions]] has that name"))
      << "materials say where the body is";
  EXPECT_THAT(message_of(replaced(with("[[supports]]\nregion = \"surface\"\nfix = [\"x\"]\n"),
                                  "columns = 11", "columns = 11\nsurface = \"ghost\"")),
              HasSubstr("has no particles on it"));
}

}  // namespace
}  // namespace perilink
