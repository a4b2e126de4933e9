#include "discretization/lattices/lattice_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace perilink {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

LatticeCut box(const Vector3& half, double spacing, double degrees) {
  LatticeCut cut;
  cut.spacing = spacing;
  cut.rotation = radians(degrees);
  cut.upper = half;
  cut.lower = {-half[0], -half[1], -half[2]};
  cut.inside = [](const Vector3&) { return true; };
  return cut;
}

/// Pairs of particles within reach of each other, by brute force.
std::set<std::pair<Index, Index>> pairs_within(const LatticeRows& lattice, double reach) {
  std::set<std::pair<Index, Index>> pairs;
  for (const Index a : lattice.particle_slot) {
    for (const Index b : lattice.particle_slot) {
      double square = 0.0;
      for (int c = 0; c < lattice.dim; ++c) {
        const double d = lattice.positions[lattice.at(c, b)] - lattice.positions[lattice.at(c, a)];
        square += d * d;
      }
      if (a < b && square < reach * reach) pairs.insert({a, b});
    }
  }
  return pairs;
}

/// Own bonds as pairs of slots; checks that vectors and incoming shifts agree with them.
std::set<std::pair<Index, Index>> own_pairs(const LatticeRows& lattice) {
  std::set<std::pair<Index, Index>> pairs;
  const int own = lattice.own_bonds();
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (int k = 0; k < own; ++k) {
      for (Index i = 0; i < lattice.rows[r].size; ++i) {
        const Index a = lattice.rows[r].first + i, b = a + lattice.shift_out[r * own + k];
        EXPECT_GE(b, 0);
        EXPECT_LT(b, lattice.slots);
        EXPECT_GE(a - lattice.shift_in[r * own + k], 0);
        EXPECT_LT(a - lattice.shift_in[r * own + k], lattice.slots);
        if (lattice.present[lattice.at(k, a)] == 0.0) continue;
        EXPECT_TRUE(pairs.insert({std::min(a, b), std::max(a, b)}).second);
        for (int c = 0; c < lattice.dim; ++c) {
          EXPECT_NEAR(lattice.positions[lattice.at(c, b)] - lattice.positions[lattice.at(c, a)],
                      lattice.bonds[k].length * lattice.bonds[k].direction[c],
                      1e-12 * lattice.spacing);
        }
      }
    }
  }
  return pairs;
}

/// Every bond of a row's slot must be found again from the partner through its incoming shift.
void expect_incoming_shifts(const LatticeRows& lattice) {
  const int own = lattice.own_bonds();
  std::vector<Index> row_of(lattice.slots, no_index);
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (Index i = 0; i < lattice.rows[r].size; ++i) {
      row_of[lattice.rows[r].first + i] = static_cast<Index>(r);
    }
  }
  for (const Index a : lattice.particle_slot) {
    for (int k = 0; k < own; ++k) {
      if (lattice.present[lattice.at(k, a)] == 0.0) continue;
      const Index b = a + lattice.shift_out[row_of[a] * own + k];
      EXPECT_EQ(b - lattice.shift_in[row_of[b] * own + k], a);
      EXPECT_EQ(lattice.row_out[row_of[a] * own + k], row_of[b]);
      EXPECT_GE(row_of[b], row_of[a]);  // what sweeps over rows rely on
      EXPECT_LE(row_of[b], row_of[a] + lattice.reach);
    }
  }
}

TEST(LatticeRows, OwnsEveryPairOfNeighboursOnce) {
  for (const double degrees : {0.0, 7.0, 15.0, 30.0}) {
    const LatticeRows plane = hexagonal_rows(box({4.2, 3.1, 0.0}, 1.0, degrees));
    EXPECT_EQ(own_pairs(plane), pairs_within(plane, 1.2)) << degrees;
    expect_incoming_shifts(plane);
    const LatticeRows space = face_centred_rows(box({2.2, 2.1, 1.9}, 1.0, degrees));
    EXPECT_EQ(own_pairs(space), pairs_within(space, 1.5)) << degrees;
    expect_incoming_shifts(space);
  }
}

TEST(LatticeRows, KnowsBodiesWithHoles) {
  LatticeCut cut = box({5.0, 5.0, 0.0}, 1.0, 11.0);
  cut.inside = [](const Vector3& x) { return std::hypot(x[0], x[1]) > 2.0; };
  const LatticeRows lattice = hexagonal_rows(cut);
  EXPECT_EQ(own_pairs(lattice), pairs_within(lattice, 1.2));
  expect_incoming_shifts(lattice);
}

TEST(LatticeRows, CountsSixAndEighteenBondsInside) {
  const LatticeRows plane = hexagonal_rows(box({3.0, 3.0, 0.0}, 1.0, 20.0));
  const LatticeRows space = face_centred_rows(box({3.0, 3.0, 3.0}, 1.0, 20.0));
  for (const auto* lattice : {&plane, &space}) {
    for (const Index slot : lattice->particle_slot) {
      double reach = 0.0;
      for (int c = 0; c < lattice->dim; ++c) {
        reach = std::max(reach, std::abs(lattice->positions[lattice->at(c, slot)]));
      }
      if (reach < 1.5) {
        EXPECT_EQ(lattice->bond_count[slot], lattice->dim == 2 ? 6 : 18);
      }
    }
  }
}

TEST(LatticeRows, FillsTheCellVolume) {
  // A box of 40 spacings: the count differs from volume over cell volume by a surface term.
  const LatticeRows plane = hexagonal_rows(box({20.0, 20.0, 0.0}, 1.0, 9.0));
  EXPECT_NEAR(plane.particles() * plane.cell_volume, 1600.0, 80.0);
  const LatticeRows space = face_centred_rows(box({6.0, 6.0, 6.0}, 1.0, 9.0));
  EXPECT_NEAR(space.particles() * space.cell_volume, 1728.0, 0.15 * 1728.0);
}

// Nikravesh & Gerstle 2018, section 3.1: 605, 595 and 569 particles. The paper does not say how
// its specimen of 0.15 m x 0.30 m is cut; a lattice point in the middle, a quarter of a spacing
// more at the sides and 1.58 more at the ends give its counts.
TEST(LatticeRows, CountsTheParticlesOfThePaper) {
  const double spacing = 0.01;
  const Vector3 half{0.075 + 0.26 * spacing, 0.15 + 1.58 * spacing, 0.0};
  EXPECT_EQ(hexagonal_rows(box(half, spacing, 0.0)).particles(), 605);
  EXPECT_EQ(hexagonal_rows(box(half, spacing, 15.0)).particles(), 595);
  EXPECT_EQ(hexagonal_rows(box(half, spacing, 30.0)).particles(), 569);
}

TEST(LatticeRows, MovesWithItsOrigin) {
  LatticeCut cut = box({3.0, 3.0, 0.0}, 1.0, 25.0);
  cut.origin = {0.3, 0.1, 0.0};
  const LatticeRows lattice = hexagonal_rows(cut);
  bool found = false;
  for (const Index slot : lattice.particle_slot) {
    found =
        found || (lattice.positions[slot] == 0.3 && lattice.positions[lattice.at(1, slot)] == 0.1);
  }
  EXPECT_TRUE(found);
}

TEST(LatticeRows, RefusesAnEmptyBody) {
  LatticeCut cut = box({1.0, 1.0, 0.0}, 1.0, 0.0);
  cut.inside = [](const Vector3&) { return false; };
  EXPECT_THROW(hexagonal_rows(cut), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
