#include "model/body/shell_rules.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;

/// A sheet of 8 by 4.
CaseFile mid_surface(const std::string& radius, double ratio, const std::string& more = "") {
  return parse_case(fmt::format("[body]\nproblem = \"shell\"\nthickness = 0.2\n{}spacing = 1.0\n"
                                "horizon_ratio = 2\npattern = \"hexagonal\"\n"
                                "[[regions]]\nname = \"sheet\"\nx = [0, 8]\ny = [0, 4]\n"
                                "[[materials]]\nregion = \"sheet\"\nyoungs_modulus = 100.0\n"
                                "poissons_ratio = {}\nfracture_energy = \"infinite\"\n"
                                "[[supports]]\nregion = \"surface\"\nfix = [\"x\", \"y\", \"z\"]\n"
                                "[[loads]]\nregion = \"body\"\nbody_force = [0, 0, -1]\n"
                                "[analysis]\ntype = \"elastic\"\n{}",
                                radius, ratio, more),
                    "sheet");
}

TEST(ShellRules, SheetsMayReachAlmostAroundTheirCylinder) {
  EXPECT_NO_THROW(build_model(mid_surface("radius = 1.3\n", 0.1)));
  expect_refused(mid_surface("radius = 1.27\n", 0.1), "body.radius", "the cylinder is 7.97965");
}

TEST(ShellRules, ParticlesMustBeHeldAgainstTurningWithinTheSheet) {
  EXPECT_NO_THROW(build_model(mid_surface("", 0.3)));
  expect_refused(mid_surface("", 0.33332), "materials[1].poissons_ratio", "rotate freely");
}

TEST(ShellRules, PlanesOfSymmetryAcrossACylinderLieAtItsTop) {
  const auto plane = [](const std::string& axis, int at) {
    return fmt::format("[[symmetry]]\naxis = \"{}\"\nat = {}\n", axis, at);
  };
  EXPECT_NO_THROW(build_model(mid_surface("radius = 5.0\n", 0.1, plane("x", 0) + plane("y", 4))));
  expect_refused(mid_surface("radius = 5.0\n", 0.1, plane("x", 8)), "symmetry[1]",
                 "away from its top");
  EXPECT_NO_THROW(build_model(mid_surface("", 0.1, plane("x", 8))));
}

}  // namespace
}  // namespace perilink
