#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(CaseLoading, RefusesFormulasWithTheirPlace) {
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"block\"\npressure = \"1 - q\"\n")),
              HasSubstr("tractions[1].pressure: holds the formula \"1 - q\""));
  EXPECT_THAT(
      message_of(with_loading("[[tractions]]\nregion = \"block\"\ntraction = [\"z\", 0]\n")),
      HasSubstr("write a number, or a formula of x and y with"));
  EXPECT_THAT(message_of(with_loading("[[displacements]]\nregion = \"block\"\nx = true\n")),
              HasSubstr("must be a number or a formula"));
  EXPECT_THAT(message_of(with_loading("[[displacements]]\nregion = \"block\"\nx = \"\"\n")),
              HasSubstr("nothing at character 1"));
  EXPECT_THAT(message_of(replaced(base, "force = [0, -1]", "force = [0, \"x\"]")),
              HasSubstr("write numbers without quotes"))
      << "a total force has no position";
}

TEST(CaseLoading, RefusesTractionsThatCannotBe) {
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"block\"\n")),
              HasSubstr("has none of `traction` or `pressure`"));
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"block\"\npressure = 0\n")),
              HasSubstr("is zero"));
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"block\"\ntraction = [0, 0]\n")),
              HasSubstr("is zero in every direction"));
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"block\"\ntraction = [1]\n")),
              HasSubstr("has 1 components, but the body has 2 dimensions"));
  EXPECT_THAT(message_of(with_loading("[[tractions]]\npressure = 1\n")),
              HasSubstr("the name of the region whose surface is loaded"));
  EXPECT_THAT(message_of(with_loading("[[tractions]]\nregion = \"surfaces\"\npressure = 1\n")),
              HasSubstr("did you mean `surface`?"));
  EXPECT_THAT(message_of(replaced(with_loading("[[tractions]]\nregion = \"block\"\npressure = 1\n"),
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
  EXPECT_THAT(
      message_of(replaced(with_loading("[[supports]]\nregion = \"surface\"\nfix = [\"x\"]\n"),
                          "columns = 11", "columns = 11\nsurface = \"ghost\"")),
      HasSubstr("has no particles on it"));
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
  EXPECT_THAT(message_of(with_loading("[[displacements]]\nregion = \"block\"\nrotation = 1\n")),
              HasSubstr("displacements[1].rotation: is given, but the particles of a bond-based"));
  EXPECT_THAT(message_of(replaced(flat, "rotation", "rz")),
              HasSubstr("displacements[1].rz: is no rotation of a body in two dimensions"));
}

TEST(CaseLoading, APointLoadAloneLoadsTheBody) {
  const std::string load = "[[loads]]\nregion = \"block\"\nforce = [0, -1]\n";
  EXPECT_EQ(message_of(replaced(base, load, "[[point_loads]]\nat = [0, 0]\nforce = [0, -3]\n")),
            "accepted");
}

TEST(CaseLoading, RefusesPointLoadsThatCannotBe) {
  EXPECT_THAT(message_of(with_loading("[[point_loads]]\nforce = [0, 1]\n")),
              HasSubstr("the point that is loaded"));
  EXPECT_THAT(message_of(with_loading("[[point_loads]]\nat = [0, 1]\n")),
              HasSubstr("the force at load factor 1"));
  EXPECT_THAT(message_of(with_loading("[[point_loads]]\nat = [0, 1]\nforce = [0, 0]\n")),
              HasSubstr("is zero in every direction"));
  EXPECT_THAT(message_of(with_loading("[[point_loads]]\nat = [0, 1]\nmoment = 3\n")),
              HasSubstr("the particles of a bond-based body do not rotate"));
}

TEST(CaseLoading, RefusesPlanesOfSymmetryThatCannotBe) {
  EXPECT_THAT(message_of(with_loading("[[symmetry]]\nat = 0\n")),
              HasSubstr("the axis normal to the plane"));
  EXPECT_THAT(message_of(with_loading("[[symmetry]]\naxis = \"q\"\nat = 0\n")),
              HasSubstr("Allowed: x, y, z"));
  EXPECT_THAT(message_of(with_loading("[[symmetry]]\naxis = \"z\"\nat = 0\n")),
              HasSubstr("Allowed: x, y"));
  EXPECT_THAT(message_of(with_loading("[[symmetry]]\naxis = \"x\"\n")),
              HasSubstr("none of `at` or `region`"));
  EXPECT_THAT(message_of(with_loading("[[symmetry]]\naxis = \"x\"\nregion = \"blok\"\n")),
              HasSubstr("did you mean `block`?"));
}

TEST(CaseLoading, RefusesSpringsThatCannotBe) {
  EXPECT_THAT(message_of(with_loading("[[springs]]\nregion = \"block\"\n")),
              HasSubstr("none of `stiffness` or `total`"));
  EXPECT_THAT(message_of(with_loading("[[springs]]\nregion = \"block\"\ntotal = [1, -2]\n")),
              HasSubstr("holds a negative stiffness"));
  EXPECT_THAT(message_of(with_loading("[[springs]]\nregion = \"block\"\ntotal = [0, 0]\n")),
              HasSubstr("is zero in every direction"));
  EXPECT_THAT(message_of(with_loading("[[springs]]\nregion = \"blok\"\ntotal = [0, 1]\n")),
              HasSubstr("did you mean `block`?"));
  EXPECT_THAT(
      message_of(replaced(with_loading("[[springs]]\nregion = \"block\"\nstiffness = [0, 1]\n"),
                          "columns = 11", "columns = 11\nsurface = \"ghost\"")),
      HasSubstr("springs[1].stiffness: acts on the surface"));
}

}  // namespace
}  // namespace perilink
