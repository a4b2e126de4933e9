#include "results/field_file.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// Unit square of four particles with its four sides as bonds, a slip spring and one bar element.
Network make_square() {
  Network network;
  network.particles.dim = 2;
  network.particles.positions = {0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.5, 0.9, 0.5};
  network.particles.volumes = {1, 1, 1, 1, 1, 1};
  network.particles.material = {0, 0, 1, 0, no_index, no_index};
  network.particles.kind.assign(4, ParticleKind::solid);
  network.particles.kind.insert(network.particles.kind.end(), 2, ParticleKind::rebar);
  const std::vector<std::pair<Index, Index>> ends = {{0, 1}, {0, 2}, {1, 3},
                                                     {2, 3}, {3, 4}, {4, 5}};
  for (const auto& [i, j] : ends) network.bonds.append(network.particles, i, j);
  network.stiffness.assign(6, 2.0);
  network.critical_stretch.assign(6, 1.0);
  network.first_slip_spring = 4;
  network.first_bar_element = 5;
  network.laws.push_back(BondLaw::plateau());
  network.law_of = {0, 0, 0, 0, 0, 1};
  return network;
}

class FieldFile : public ::testing::Test {
 protected:
  FieldFile() {
    secants_[3] = secants_[4] = 0.0;  // broken
    grid_ = make_field_grid(network_, secants_, motion_, {5, 2, 0.5, 7.0, 1.0, 0.25, 2.0},
                            std::vector<Index>{3, 4}, neighbourhoods_);
  }

  Network network_ = make_square();
  Csr neighbourhoods_ = bonds_of_particles(network_.bonds, 6);
  std::vector<double> secants_ = std::vector<double>(6, 1.0);
  std::vector<double> motion_ = {0, 0, 0.1, 0, 0, 0, 0.1, 0, 0.05, 0, 0.09, 0};
  VtuGrid grid_;
};

TEST_F(FieldFile, CellsAreParticlesThenBrokenBondsThenBars) {
  ASSERT_EQ(grid_.types.size(), 6u + 2u + 1u);
  EXPECT_EQ(grid_.types[5], VtuCell::vertex);
  EXPECT_EQ(grid_.types[6], VtuCell::line);
  EXPECT_EQ(grid_.find_cell_data("element")->values,
            (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 1, 2}));
  EXPECT_EQ(grid_.find_cell_data("broken_at")->values,
            (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 2, 0}));
  const std::vector<Index> lines(grid_.connectivity.begin() + 6, grid_.connectivity.end());
  EXPECT_EQ(lines, (std::vector<Index>{2, 3, 3, 4, 4, 5}));
  EXPECT_EQ(grid_.offsets.back(), 12);
}

TEST_F(FieldFile, StressesHaveTheirPrincipalValuesAndDirections) {
  std::vector<double> stresses(6 * 6, 0.0);
  stresses[6 + 1] = 4.0;    // the second particle: yy
  stresses[12 + 3] = -3.0;  // the third one: xy
  add_stresses(grid_, stresses, 2);
  EXPECT_EQ(grid_.find_point_data("stress")->values, stresses);
  const std::vector<double>& values = grid_.find_point_data("principal_stress")->values;
  EXPECT_EQ((std::vector<double>{values[3], values[4], values[5]}),
            (std::vector<double>{4.0, 0.0, 0.0}));
  EXPECT_NEAR(values[6], 3.0, 1e-15);
  EXPECT_NEAR(values[7], -3.0, 1e-15);
  const std::vector<double>& first = grid_.find_point_data("first_principal_direction")->values;
  const std::vector<double>& last = grid_.find_point_data("last_principal_direction")->values;
  EXPECT_NEAR(std::abs(first[4]), 1.0, 1e-15);
  EXPECT_NEAR(std::abs(last[3]), 1.0, 1e-15);
  EXPECT_NEAR(first[6] * first[7], -0.5, 1e-15) << "negative shear pulls along the other diagonal";
  EXPECT_NEAR(last[6] * last[7], 0.5, 1e-15);
}

TEST_F(FieldFile, OpeningsBelongToBrokenBondsAndTheirParticles) {
  CrackOpenings openings;
  openings.bonds = {0, 3};  // a softened bond, and the first of the broken ones
  openings.opening = {0.1, 0.3};
  add_openings(grid_, network_, openings, std::vector<Index>{3, 4});
  EXPECT_EQ(grid_.find_cell_data("crack_opening")->values,
            (std::vector<double>{0, 0, 0, 0, 0, 0, 0.3, 0, 0}));
  EXPECT_EQ(grid_.find_point_data("crack_opening")->values,
            (std::vector<double>{0.1, 0.1, 0.3, 0.3, 0, 0}));
}

TEST_F(FieldFile, DisplacementsAndEnergiesAreThoseOfTheMotion) {
  const std::vector<double>& u = grid_.find_point_data("displacement")->values;
  EXPECT_EQ(u.size(), 18u);
  EXPECT_DOUBLE_EQ(u[3], 0.1);
  EXPECT_EQ(u[5], 0.0);
  // Only bond 0-1 of stiffness 2 is stretched at particle 0, by 0.1: half of 2 * 0.1^2 / 2.
  EXPECT_NEAR(grid_.find_point_data("strain_energy_density")->values[0], 0.005, 1e-15);
  // Stretch 0.1 along x and zero across.
  const std::vector<double>& strain = grid_.find_point_data("principal_strain")->values;
  EXPECT_NEAR(strain[0], 0.1, 1e-14);
  EXPECT_NEAR(strain[1], 0.0, 1e-14);
  EXPECT_EQ(strain[2], 0.0);
}

TEST_F(FieldFile, ShowsTheRotationsOfMicropolarBodies) {
  EXPECT_EQ(grid_.find_point_data("rotation"), nullptr);
  network_.bending = {1, 1, 1, 1, 0, 0};
  std::vector<double> motion;
  for (int i = 0; i < 6; ++i) {
    motion.insert(motion.end(), {motion_[2 * i], motion_[2 * i + 1], 0.1 * i});
  }
  const VtuGrid grid = make_field_grid(network_, secants_, motion, {5, 2, 0.5, 7.0, 1.0},
                                       std::vector<Index>{3, 4}, neighbourhoods_);
  EXPECT_EQ(grid.find_point_data("displacement")->values,
            grid_.find_point_data("displacement")->values);
  EXPECT_EQ(grid.find_point_data("principal_strain")->values,
            grid_.find_point_data("principal_strain")->values);
  const VtuArray* rotation = grid.find_point_data("rotation");
  ASSERT_NE(rotation, nullptr);
  EXPECT_EQ(rotation->components, 1);
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(rotation->values[i], 0.1 * i);
}

TEST_F(FieldFile, SaysWhatTheParticlesAre) {
  EXPECT_EQ(grid_.find_point_data("volume")->values, network_.particles.volumes);
  EXPECT_EQ(grid_.points.size(), 18u);
  EXPECT_EQ(grid_.points[9], 1.0);
  EXPECT_EQ(grid_.points[11], 0.0);
  EXPECT_EQ(grid_.find_point_data("kind")->values, (std::vector<double>{0, 0, 0, 0, 2, 2}));
  EXPECT_EQ(grid_.find_point_data("region")->values, (std::vector<double>{0, 0, 1, 0, -1, -1}));
  EXPECT_EQ(grid_.find_point_data("damage")->values[0], 0.0);
  EXPECT_GT(grid_.find_point_data("damage")->values[2], 0.0);
  EXPECT_EQ(grid_.field("broken_bonds", -1), 2.0);
  EXPECT_EQ(grid_.field("load", -1), 7.0);
  EXPECT_EQ(grid_.field("dimension", -1), 2.0);
  EXPECT_EQ(grid_.field("spacing", -1), 1.0);
  EXPECT_EQ(grid_.field("time", -1), 0.25);
  EXPECT_EQ(grid_.field("thickness", -1), 2.0);
}

}  // namespace
}  // namespace perilink
