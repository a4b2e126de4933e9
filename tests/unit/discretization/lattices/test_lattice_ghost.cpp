#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

LatticeInput specimen(Pattern pattern, int columns) {
  LatticeInput input;
  input.pattern = pattern;
  input.surface = Surface::ghost;
  input.spacing = 100.0 / columns;
  input.horizon = 3.0 * input.spacing;
  input.thickness = 10.0;
  input.solid = {{{0.0, -50.0, 0.0}, {100.0, 250.0, 0.0}}};
  input.material = {0};
  return input;
}

std::map<long, int> solid_per_row(const Body& body) {
  std::map<long, int> rows;
  for (Index i = 0; i < body.particles.size(); ++i) {
    if (body.particles.kind[i] == ParticleKind::ghost) continue;
    ++rows[std::lround(1e6 * body.particles.position(i)[1])];
  }
  return rows;
}

// Gerstle, Sau & Silling 2005, Table 1: n columns across 100 in.
TEST(GhostLattice, RectangularIsCellCentredInXAndStartsOnTheLowestRow) {
  const Body body = make_body(specimen(Pattern::rectangular, 8));
  const auto rows = solid_per_row(body);
  EXPECT_EQ(rows.size(), 25U);  // 300 / 12.5 + 1
  EXPECT_EQ(rows.begin()->first, -50'000'000);
  for (const auto& row : rows) EXPECT_EQ(row.second, 8);
  EXPECT_DOUBLE_EQ(body.particles.position(0)[0], 6.25);
  for (const double volume : body.particles.volumes) EXPECT_DOUBLE_EQ(volume, 12.5 * 12.5 * 10.0);
}

TEST(GhostLattice, HexagonalRowsAlternateBetweenNAndNPlusOne) {
  const Body body = make_body(specimen(Pattern::hexagonal, 8));
  const auto rows = solid_per_row(body);
  int before = 0;
  for (const auto& row : rows) {
    EXPECT_TRUE(row.second == 8 || row.second == 9);
    EXPECT_NE(row.second, before);
    before = row.second;
  }
  EXPECT_DOUBLE_EQ(body.lattice.step[1], 0.5 * std::numbers::sqrt3 * 12.5);
}

TEST(GhostLattice, GhostsFollowTheSolidAndLieWithinTheHorizon) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::hexagonal}) {
    const Body body = make_body(specimen(pattern, 6));
    const auto& kind = body.particles.kind;
    EXPECT_TRUE(std::is_sorted(kind.begin(), kind.end()));
    EXPECT_EQ(kind.back(), ParticleKind::ghost);
    const Csr neighbourhoods = bonds_of_particles(
        make_bonds(body.particles, 3.0 * body.lattice.spacing), body.particles.size());
    for (Index i = 0; i < body.particles.size(); ++i) {
      EXPECT_FALSE(neighbourhoods.row(i).empty());
      EXPECT_EQ(body.particles.material[i], kind[i] == ParticleKind::ghost ? no_index : 0);
    }
  }
}

TEST(GhostLattice, SolidParticlesOfASmallBodyHaveWholeFamilies) {
  LatticeInput input = specimen(Pattern::rectangular, 8);
  for (const Pattern pattern :
       {Pattern::rectangular, Pattern::hexagonal, Pattern::cubic, Pattern::face_centred}) {
    input.pattern = pattern;
    input.solid = {{{0.0, 0.0, 0.0}, {50.0, 50.0, 50.0}}};
    const Body body = make_body(input);
    const auto neighbourhood = interior_neighbourhood(body.lattice, input.horizon);
    const Csr neighbourhoods =
        bonds_of_particles(make_bonds(body.particles, input.horizon), body.particles.size());
    for (Index i = 0; i < body.particles.size(); ++i) {
      if (body.particles.kind[i] == ParticleKind::ghost) continue;
      EXPECT_EQ(neighbourhoods.row(i).size(), neighbourhood.offsets.size());
    }
  }
}

TEST(RemoveLooseGhosts, DropsWhatOneDirectionHolds) {
  const LatticeInput input = specimen(Pattern::rectangular, 8);
  Body body = make_body(input);
  Bonds bonds = make_bonds(body.particles, input.horizon);
  const Index before = body.particles.size();
  // Beside the left and right sides the third column of ghosts has one bond each, (3, 0).
  const Index dropped = remove_loose_ghosts(body.particles, bonds);
  EXPECT_GE(dropped, 2 * 25);
  EXPECT_EQ(body.particles.size(), before - dropped);
  EXPECT_EQ(body.particles.positions.size(), 2U * body.particles.volumes.size());
  EXPECT_EQ(remove_loose_ghosts(body.particles, bonds), 0);
  const Bonds again = make_bonds(body.particles, input.horizon);
  EXPECT_EQ(again.first, bonds.first);
  EXPECT_EQ(again.second, bonds.second);
}

}  // namespace
}  // namespace perilink
