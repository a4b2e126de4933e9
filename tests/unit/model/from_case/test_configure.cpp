#include "model/from_case/configure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;
using test::prism_case;
using test::strip_case;

/// Numbers of neighbours of the solid particles farther than the horizon from every side.
std::set<Index> interior_neighbours(const Model& model, const Box& box) {
  const Network& network = model.network;
  std::vector<Index> count(static_cast<std::size_t>(network.particles.size()), 0);
  for (Index b = 0; b < network.first_slip_spring; ++b) {
    ++count[network.bonds.first[b]];
    ++count[network.bonds.second[b]];
  }
  std::set<Index> found;
  const double margin = 1.001 * model.horizon;
  for (Index i = 0; i < network.particles.size(); ++i) {
    bool inside = true;
    for (int a = 0; a < network.dim(); ++a) {
      const double x = network.particles.position(i)[a];
      inside = inside && x >= box.lower[a] + margin && x <= box.upper[a] - margin;
    }
    if (inside) found.insert(count[i]);
  }
  return found;
}

Index particles_on_lowest_row(const Particles& particles) {
  Index count = 0;
  for (Index i = 0; i < particles.size(); ++i) {
    count += particles.kind[i] == ParticleKind::solid && particles.position(i)[1] < 1e-9;
  }
  return count;
}

TEST(Configure, ColumnsOfAConformingBodyStandOnBothSides) {
  CaseFile input = strip_case();
  input.body.spacing.reset();
  input.body.columns = 9;
  const Model model = build_model(input);
  EXPECT_DOUBLE_EQ(model.lattice.spacing, 40.0 / 8.0);
  EXPECT_EQ(particles_on_lowest_row(model.network.particles), 9);
  EXPECT_EQ(model.network.particles.size(), 9 * 17);
}

TEST(Configure, ColumnsOfAGhostBodyStandInCells) {
  CaseFile input = strip_case();
  input.body.surface = Surface::ghost;
  input.body.spacing.reset();
  input.body.columns = 8;
  const Model model = build_model(input);
  EXPECT_DOUBLE_EQ(model.lattice.spacing, 40.0 / 8.0);
  EXPECT_EQ(particles_on_lowest_row(model.network.particles), 8);
  EXPECT_DOUBLE_EQ(model.network.particles.position(0)[0], 2.5);
}

TEST(Configure, ColumnsOfAFaceCentredBodyAreTheParticlesOfARow) {
  CaseFile input = prism_case();
  input.body.pattern = Pattern::face_centred;
  input.body.spacing.reset();
  input.body.columns = 5;
  const Model model = build_model(input);
  // Four cube edges of 0.1 across the body.
  EXPECT_NEAR(model.lattice.spacing, 0.1 / std::numbers::sqrt2, 1e-12);
  Index row = 0;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const auto x = model.network.particles.position(i);
    row += std::abs(x[1]) < 1e-9 && std::abs(x[2]) < 1e-9;
  }
  EXPECT_EQ(row, 5);
}

TEST(Configure, HorizonIsALengthARatioOrALevel) {
  CaseFile input = strip_case();
  EXPECT_DOUBLE_EQ(build_model(input).horizon, 31.0);
  input.body.horizon.reset();
  input.body.horizon_ratio = 2.2;
  EXPECT_DOUBLE_EQ(build_model(input).horizon, 22.0);
  input.body.horizon_ratio.reset();
  input.body.horizon_level = 5;  // squared radius 8 (Gerstle, Sau & Silling 2005, Fig. 5)
  EXPECT_NEAR(build_model(input).horizon, 10.0 * std::sqrt(8.0), 1e-12);
}

TEST(Configure, HorizonAsALengthStaysOnAStretchedLattice) {
  CaseFile input = strip_case();
  input.body.spacing = 11.0;  // 40 / 4 and 80 / 7
  const Model model = build_model(input);
  EXPECT_DOUBLE_EQ(model.lattice.spacing, 10.0);
  EXPECT_GT(model.lattice.step[1], 10.0);
  EXPECT_DOUBLE_EQ(model.horizon, 31.0);
}

/// A stiffer one adapts the rows: its face, at three quarters of the height, has 36 of 48 below.
TEST(Configure, PadsOfEqualConstantsLeaveHexagonalLatticesAsTheyAre) {
  CaseFile input = strip_case();
  input.body.pattern = Pattern::hexagonal;
  input.body.surface = Surface::calibrated;
  input.body.spacing = 2.0;
  input.body.horizon = 6.0;
  const Vector3 alone = build_model(input).lattice.step;
  Region pad = input.regions.front();
  pad.name = "pad";
  pad.box.lower[1] = 60.0;
  input.regions.push_back(pad);
  input.materials.push_back(input.materials.front());
  input.materials.back().regions = {"pad"};
  EXPECT_EQ(build_model(input).lattice.step, alone);
  input.materials.back().youngs_modulus *= 2.0;
  EXPECT_DOUBLE_EQ(build_model(input).lattice.step[1], 80.0 / 48.0);
}

/// The rows of a hexagonal body do not fit its height, so that the lattice is stretched or
/// compressed; three spacings enclose shells of 6, 6, 6, 12 and 6 neighbours all the same.
class HexagonalColumns : public testing::TestWithParam<int> {};

TEST_P(HexagonalColumns, ARatioOfThreeHas36Neighbours) {
  CaseFile input = strip_case();
  const Box box{{0, 0, 0}, {100, 300, 0}};
  for (Region& region : input.regions) {
    region.box = box;
    if (region.name == "lower end") region.box.upper[1] = 20.0;
  }
  input.body.pattern = Pattern::hexagonal;
  input.body.spacing.reset();
  input.body.horizon.reset();
  input.body.columns = GetParam();
  input.body.horizon_ratio = 3.0;
  EXPECT_EQ(interior_neighbours(build_model(input), box), std::set<Index>{36});
  // Neighbourhood of a level of the paper: level 5 encloses 36 neighbours.
  input.body.horizon_ratio.reset();
  input.body.horizon_level = 5;
  EXPECT_EQ(interior_neighbours(build_model(input), box), std::set<Index>{36});
}

INSTANTIATE_TEST_SUITE_P(Columns, HexagonalColumns, testing::Values(20, 30, 50, 100));

TEST(Configure, RatiosKeepTheirNeighboursOnEveryStretchedPattern) {
  CaseFile plane = strip_case();
  plane.body.surface = Surface::none;
  plane.regions[0].box.upper[1] = 80.5;  // rows stretched by 0.6 %
  plane.regions[2].box.upper[1] = 80.5;
  plane.body.horizon.reset();
  plane.body.horizon_ratio = 2.0;
  plane.body.spacing = 5.0;
  // i^2 + j^2 <= 4: 12 points besides the origin.
  EXPECT_EQ(interior_neighbours(build_model(plane), plane.regions[0].box), std::set<Index>{12});

  CaseFile space = prism_case();
  space.body.surface = Surface::none;
  space.body.horizon_ratio = 2.0;
  for (Region& region : space.regions) {
    if (region.name != "lower end") region.box.upper[1] = 0.804;
  }
  space.body.spacing = 0.04;
  // i^2 + j^2 + k^2 <= 4: 6 + 12 + 8 + 6.
  EXPECT_EQ(interior_neighbours(build_model(space), space.regions[0].box), std::set<Index>{32});
  space.body.pattern = Pattern::face_centred;
  // Shells at 1, sqrt 2, sqrt 3 and 2 nearest distances: 12 + 6 + 24 + 12.
  EXPECT_EQ(interior_neighbours(build_model(space), space.regions[0].box), std::set<Index>{54});
}

TEST(Configure, TheLaterMaterialCountsWhereRegionsOverlap) {
  CaseFile input = strip_case();
  MaterialSection patch = input.materials[0];
  patch.name = "patch";
  patch.regions = {"middle", "upper end"};
  input.regions[3].box = {{0.0, 35.0, 0.0}, {40.0, 45.0, 0.0}};
  patch.youngs_modulus = 6000.0;
  input.materials.push_back(patch);
  const Model model = build_model(input);
  const Particles& particles = model.network.particles;
  for (Index i = 0; i < particles.size(); ++i) {
    const double y = particles.position(i)[1];
    EXPECT_EQ(particles.material[i], y == 40.0 || y >= 60.0 ? 1 : 0) << "y = " << y;
  }
  // In the other order the strip covers the patch.
  std::swap(input.materials[0], input.materials[1]);
  expect_refused(input, "materials[1]", "no particle is made of \"patch\"");
}

CaseFile barred_case() {
  CaseFile input = strip_case();
  RebarSection bar;
  bar.points = {{22.0, 5.0, 0.0}, {22.0, 75.0, 0.0}};
  bar.bond.type = RebarBond::concrete;
  bar.youngs_modulus = 29000.0;
  bar.area = 3.0;
  bar.yield_strength = 58.0;
  input.rebar.push_back(bar);
  return input;
}

TEST(Configure, BarsYieldAndTiesBreakUnlessTheCaseSaysOtherwise) {
  CaseFile input = barred_case();
  const Model model = build_model(input);
  const Network& network = model.network;
  ASSERT_EQ(network.num_elements() - network.first_bar_element, 7);
  EXPECT_DOUBLE_EQ(network.critical_stretch[network.first_bar_element], 58.0 / 29000.0);
  EXPECT_GT(network.first_bar_element, network.first_slip_spring);
  EXPECT_TRUE(std::isfinite(network.critical_stretch[network.first_slip_spring]));

  input.rebar[0].yields = false;
  input.rebar[0].bond.slip_springs_break = false;
  const Network perfect = build_model(input).network;
  EXPECT_TRUE(std::isinf(perfect.critical_stretch[perfect.first_bar_element]));
  for (Index tie = perfect.first_slip_spring; tie < perfect.first_bar_element; ++tie) {
    EXPECT_TRUE(std::isinf(perfect.critical_stretch[tie]));
  }
}

TEST(Configure, BarsStayInTheBodyUnlessTheyAreWantedAcrossGaps) {
  CaseFile input = barred_case();
  input.rebar[0].bond.type = RebarBond::perfect;
  EXPECT_NO_THROW(build_model(input));
  input.rebar[0].points[0][1] = -9.0;
  expect_refused(input, "rebar[1]", "leaves the body at (22, -9)");
  input.rebar[0].across_gaps = true;
  expect_refused(input, "rebar[1]", "set bends = true");
  input.rebar[0].bends = true;
  EXPECT_NO_THROW(build_model(input));
}

TEST(Configure, TooManyParticlesAreRefusedBeforeAnyIsMade) {
  CaseFile input = strip_case();
  input.body.spacing = 1e-3;
  expect_refused(input, "body.spacing", "particles");
  input.body.spacing.reset();
  input.body.columns = 100000;
  expect_refused(input, "body.columns", "particles");
}

TEST(Configure, HorizonsBelowTheSpacingAreRefused) {
  CaseFile input = strip_case();
  input.body.horizon.reset();
  input.body.horizon_level = 0;
  expect_refused(input, "body.horizon_level", "no particle would have a neighbour");
  input.body.horizon_level.reset();
  input.body.horizon_ratio = 0.5;
  expect_refused(input, "body.horizon_ratio", "smaller than the spacing");
}

TEST(Configure, OutlinesThatMissTheLatticeAreRefused) {
  CaseFile input = strip_case();
  input.materials[0].regions = {"strip", "middle"};  // their sides lie off the lattice
  expect_refused(input, "body.spacing", "misses the lattice");
  input.body.spacing.reset();
  input.body.columns = 7;
  expect_refused(input, "body.columns", "misses the lattice");
}

TEST(Configure, BodiesThatCannotBreakAreRefusedInADamageAnalysis) {
  CaseFile input = strip_case();
  input.materials[0].fracture_energy = INFINITY;
  expect_refused(input, "materials[1].fracture_energy", "needs a material that can break");
  input.analysis.type = AnalysisType::elastic;
  EXPECT_NO_THROW(build_model(input));
  CaseFile barred = barred_case();  // its bar can yield
  barred.materials[0].fracture_energy = INFINITY;
  EXPECT_NO_THROW(build_model(barred));
}

TEST(Configure, WhatCalibrationDoesNotChangeIsRefusedBeforeIt) {
  int searches = 0;
  const auto refuses = [&](const CaseFile& input, const char* key, const char* text) {
    expect_refused(input, key, text);
    EXPECT_THROW(build_model(input, {[&](int, double) { ++searches; }}), InputError);
    EXPECT_EQ(searches, 0) << key;
  };
  CaseFile few = prism_case();
  few.body.pattern = Pattern::face_centred;
  few.body.horizon_ratio = 1.0;  // twelve neighbours: no calibration can make them isotropic
  refuses(few, "body.horizon_ratio", "use two to four spacings");
  CaseFile free = prism_case();
  free.supports.clear();
  refuses(free, "analysis", "6 of the 6 rigid-body modes of the body are free");
  CaseFile unbreakable = prism_case();
  unbreakable.materials[0].fracture_energy = std::numeric_limits<double>::infinity();
  refuses(unbreakable, "materials[1].fracture_energy", "needs a material that can break");
  CaseFile measured = prism_case();
  GaugeSection far;
  far.name = "far";
  far.at = Vector3{9.0, 9.0, 9.0};
  far.axis = 0;
  measured.gauges.push_back(far);
  refuses(measured, "gauges[1].at", "nearest particle");
  build_model(prism_case(), {[&](int, double) { ++searches; }});
  EXPECT_GT(searches, 0);
}

/// Results that do not depend on the calibration are equal in a draft and in the model.
TEST(DraftModel, HasTheSizesOfTheModel) {
  const Model draft = draft_model(test::strip_case());
  const Model model = build_model(test::strip_case());
  EXPECT_EQ(draft.network.bonds.size(), model.network.bonds.size());
  EXPECT_EQ(draft.unknowns.count, model.unknowns.count);
  EXPECT_EQ(draft.network.critical_stretch, model.network.critical_stretch);
  ASSERT_TRUE(draft.network.report.calibration.has_value());
  EXPECT_EQ(draft.network.report.calibration->free_bonds,
            model.network.report.calibration->free_bonds);
  EXPECT_GE(draft.network.report.calibration->bytes, 100.0 * draft.network.num_elements());
  EXPECT_EQ(draft.network.report.calibration->iterations, 0);
  EXPECT_NE(draft.network.stiffness, model.network.stiffness);
}

}  // namespace
}  // namespace perilink
