#include "model/from_case/lattice_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "base/error.hpp"
#include "solver/factor_routes.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

ExplicitCase built(const std::string& text) { return build_explicit_case(parse_case(text, "")); }

std::string lattice_message(const std::string& text) {
  try {
    built(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ExplicitCase, FillsTheBodyWithAHexagonalLattice) {
  const ExplicitCase strip = built(test::lattice_strip_case());
  const LatticeRows& lattice = strip.model.lattice;
  // 2 by 1 at spacing 0.1 from the corner: rows of 21 and 20, 0.0866 apart, 11 and ... of them.
  const int rows = 1 + static_cast<int>(1.0 / (0.05 * std::numbers::sqrt3));
  EXPECT_EQ(lattice.rows.size(), static_cast<std::size_t>(rows));
  EXPECT_EQ(lattice.particles(), 21 * ((rows + 1) / 2) + 20 * (rows / 2));
  for (const Index slot : lattice.particle_slot) {
    EXPECT_GE(lattice.positions[lattice.at(0, slot)], -1e-9);
    EXPECT_LE(lattice.positions[lattice.at(0, slot)], 2.0 + 1e-9);
  }
  EXPECT_EQ(strip.model.rules, LatticeRules::consistent);
  EXPECT_EQ(strip.model.problem, Problem::plane_stress);
  EXPECT_EQ(strip.model.material.density, 1.0);
  EXPECT_EQ(strip.model.material.internal_damping, 0.1);
  // Own halves of all bonds, counted one by one.
  double bonds = 0.0;
  for (const double present : lattice.present) bonds += present;
  EXPECT_EQ(strip.bonds, static_cast<Index>(bonds));
}

TEST(ExplicitCase, TurnsAndShiftsTheLattice) {
  const std::string text = replaced(test::lattice_strip_case(), "spacing = 0.1",
                                    "spacing = 0.1\nrotation = 30\noffset = [0.03, 0.04]");
  const LatticeRows lattice = built(text).model.lattice;
  EXPECT_NEAR(lattice.bonds[0].direction[0], 0.5 * std::numbers::sqrt3, 1e-15);
  EXPECT_NEAR(lattice.bonds[0].direction[1], 0.5, 1e-15);
  bool found = false;
  for (const Index slot : lattice.particle_slot) {
    found = found || (std::abs(lattice.positions[lattice.at(0, slot)] - 0.03) < 1e-12 &&
                      std::abs(lattice.positions[lattice.at(1, slot)] - 0.04) < 1e-12);
  }
  EXPECT_TRUE(found) << "the offset is a lattice point";
}

TEST(ExplicitCase, LeavesOutWhatNoMaterialCovers) {
  const Index whole = built(test::lattice_strip_case()).model.lattice.particles();
  const std::string notched = replaced(replaced(test::lattice_strip_case(), "region = \"strip\"",
                                                "regions = [\"strip\", \"right side\"]"),
                                       "x = [0, 2]", "x = [0, 1]");
  const Index half = built(notched).model.lattice.particles();
  EXPECT_GT(half, 0.5 * whole);  // the right side is a second part of the body
  EXPECT_LT(half, 0.7 * whole);
}

TEST(ExplicitCase, PrescribesSupportsAndDisplacements) {
  const std::string text = replaced(test::lattice_strip_case(), "x = 0.04", "x = \"-0.02*x\"");
  const ExplicitCase strip = built(text);
  int held = 0, driven = 0;
  for (const auto& row : strip.model.prescribed) {
    for (const PrescribedMotion& motion : row) {
      const double x = strip.model.lattice.positions[strip.model.lattice.at(0, motion.slot)];
      if (motion.amplitude == 0.0) {
        ++held;
        EXPECT_LE(x, 0.1 + 1e-9);
      } else {
        ++driven;
        EXPECT_EQ(motion.component, 0);
        EXPECT_NEAR(motion.amplitude, -0.02 * x, 1e-15);
        EXPECT_GE(x, 1.9 - 1e-9);
      }
    }
  }
  EXPECT_GT(held, 10);
  EXPECT_GT(driven, 10);
  EXPECT_EQ(strip.model.load_component, 0);
  EXPECT_NEAR(strip.options.reference, 0.04, 1e-15) << "the largest, without its sign";
}

TEST(ExplicitCase, TakesAPartOfTheCriticalStep) {
  const ExplicitCase strip = built(test::lattice_strip_case());
  EXPECT_EQ(strip.critical_time_step, critical_time_step(strip.model));
  EXPECT_EQ(strip.options.time_step, 0.9 * strip.critical_time_step);
  EXPECT_EQ(strip.options.steps(), static_cast<Index>(std::ceil(2.0 / strip.options.time_step)));
  EXPECT_EQ(strip.options.duration, 2.0);
  EXPECT_EQ(strip.options.ramp, 1.0);
  EXPECT_EQ(strip.options.rows, 100);
  const std::string text =
      replaced(test::lattice_strip_case(), "duration", "time_step = 1e-4\nduration");
  EXPECT_EQ(built(text).options.time_step, 1e-4);
  EXPECT_EQ(built(text).options.steps(), 20000);
}

TEST(ExplicitCase, FindsThePeriodThatExternalDampingRefersTo) {
  const std::string damped = replaced(test::lattice_strip_case(), "internal_damping",
                                      "external_damping = 0.3\ninternal_damping");
  const int before = factors_made();
  const ExplicitCase found = built(damped);
  EXPECT_EQ(found.fundamental_period, fundamental_period(found.model));
  EXPECT_EQ(found.model.mass_damping, mass_damping_rate(0.3, found.fundamental_period));
  // Held at both ends against lateral motions; clamped, they vibrate slower than along it, 2 L / c.
  EXPECT_GT(found.fundamental_period, 2.0 * 1.8 / 10.0);
  const ExplicitCase given =
      built(replaced(damped, "internal_damping", "fundamental_period = 0.5\ninternal_damping"));
  EXPECT_EQ(given.fundamental_period, 0.5);
  EXPECT_EQ(given.model.mass_damping, mass_damping_rate(0.3, 0.5));
  EXPECT_EQ(built(test::lattice_strip_case()).fundamental_period, 0.0) << "not requested";
  EXPECT_EQ(factors_made(), before) << "a few iterations do";
}

TEST(ExplicitCase, BuildsBodiesInSpace) {
  const ExplicitCase bar = built(test::lattice_bar_case());
  EXPECT_EQ(bar.model.lattice.dim, 3);
  EXPECT_EQ(bar.model.lattice.own_bonds(), 9);
  EXPECT_EQ(bar.model.problem, Problem::three_dimensional);
  EXPECT_GT(bar.model.lattice.particles(), 100);
}

/// Other refusals are entries of tests/cli/malformed/body.
TEST(ExplicitCase, RefusesWhatOnlyTheBodyKnows) {
  const std::string strip = test::lattice_strip_case();
  EXPECT_THAT(lattice_message(replaced(strip, "x = [1.9, 2]", "x = [0.1, 2]")),
              HasSubstr("sets the displacement along x of the particle at (0.1, 0) to 0.04, where "
                        "another entry sets it to 0"));
  EXPECT_THAT(lattice_message(replaced(strip, "x = 0.04", "x = \"0*x\"")),
              HasSubstr("the case has no load"));
  EXPECT_THAT(lattice_message(replaced(strip, "x = 0.04", "x = \"1/(x - x)\"")),
              HasSubstr("displacements[1].x"));
}

}  // namespace
}  // namespace perilink
