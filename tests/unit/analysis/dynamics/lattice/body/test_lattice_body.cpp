#include "analysis/dynamics/lattice/body/lattice_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

TEST(ExplicitModel, FrequencyBoundIsSafeAndNotWasteful) {
  for (const double degrees : {0.0, 15.0}) {
    for (const LatticeRules rules : {LatticeRules::mean_2017, LatticeRules::consistent}) {
      const ExplicitModel model =
          plane_model(rectangle(0.1, 0.1, 0.01, degrees), elastic_concrete(), rules);
      const double highest = highest_frequency_squared(model);
      const double bound = frequency_bound_squared(model);
      EXPECT_GE(bound, highest) << degrees;
      // With equal masses exact in an endless lattice; light edges cost the consistent rules more.
      EXPECT_LE(bound, (rules == LatticeRules::mean_2017 ? 1.02 : 1.35) * highest) << degrees;
    }
  }
}

TEST(ExplicitModel, FrequencyBoundHoldsWhereTheSumStiffens) {
  LatticeMaterial material = elastic_concrete(0.3);
  const ExplicitModel plane = plane_model(rectangle(0.1, 0.1, 0.01, 0.0), material,
                                          LatticeRules::mean_2017, Problem::plane_strain);
  EXPECT_GT(plane.moduli.sum, 0.0);
  EXPECT_GE(frequency_bound_squared(plane), highest_frequency_squared(plane));
}

// Bloch waves of an endless lattice: 6 a / (L m); equations of motion damped by C = 2 m xi omega
// per bond and 2 xi omega_1 m per particle.
TEST(ExplicitModel, CriticalStepOfEqualMassesIsThatOfTheEndlessLattice) {
  const ExplicitModel model =
      plane_model(rectangle(0.1, 0.1, 0.01, 0.0), paper_concrete(), LatticeRules::least_2018);
  const double mass = 2323.0 * 0.5 * std::numbers::sqrt3 * 1e-4 * 0.15;
  const double own = 2.0 * 25e9 * 0.01 * 0.15 / (std::numbers::sqrt3 * 1.2);
  const double elastic = 6.0 * own / (0.01 * mass);
  EXPECT_NEAR(frequency_bound_squared(model), elastic, 1e-12 * elastic);
  const double frequency = std::numbers::pi / 0.01 * std::sqrt(25e9 / (3.0 * 0.6 * 2323.0));
  const double damping = 6.0 * 2.0 * 0.2 * frequency + 2.0 * 0.2 * 2.0 * std::numbers::pi / 0.00035;
  const double step = critical_time_step(model);
  EXPECT_NEAR(elastic * step * step + 2.0 * damping * step, 4.0, 1e-12);
}

TEST(ExplicitModel, ConsistentMassesAreTributary) {
  // Half a cell on a straight edge along a row.
  const ExplicitModel model = plane_model(rectangle(0.1, 0.1, 0.01, 0.0), elastic_concrete());
  double top = 0.0;
  Index at = 0;
  for (const Index slot : model.lattice.particle_slot) {
    const double x = model.lattice.positions[slot];
    const double y = model.lattice.positions[model.lattice.at(1, slot)];
    if (std::abs(x) < 0.02 && y >= top) {
      top = y;
      at = slot;
    }
  }
  EXPECT_NEAR(model.volume[at], 0.5 * model.lattice.cell_volume, 1e-12 * model.volume[at]);
  EXPECT_NEAR(model.mass[at], 2323.0 * model.volume[at], 1e-12 * model.mass[at]);
}

TEST(ExplicitModel, BandIsOneRowAlongRowsAndWiderBetween) {
  const ExplicitModel model = plane_model(rectangle(0.1, 0.1, 0.01, 0.0), elastic_concrete());
  EXPECT_NEAR(band_width(model, {0.0, 1.0, 0.0}), 0.5 * std::numbers::sqrt3 * 0.01, 1e-15);
  EXPECT_NEAR(band_width(model, {1.0, 0.0, 0.0}), 0.01, 1e-15);
}

TEST(ExplicitModel, SortsPrescribedMotionsByRow) {
  ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 10.0), elastic_concrete());
  clamped_ends(model, 0.01, -2e-4);
  EXPECT_EQ(model.load_component, 1);
  for (std::size_t r = 0; r < model.lattice.rows.size(); ++r) {
    const LatticeRow& row = model.lattice.rows[r];
    for (const PrescribedMotion& motion : model.prescribed[r]) {
      EXPECT_GE(motion.slot, row.first);
      EXPECT_LT(motion.slot, row.first + row.size);
    }
  }
}

TEST(ExplicitModel, RefusesWhatItCannotModel) {
  const LatticeCut cut = rectangle(0.05, 0.05, 0.01, 0.0);
  LatticeMaterial material = elastic_concrete();
  EXPECT_THROW(plane_model(cut, material, LatticeRules::consistent, Problem::three_dimensional),
               std::invalid_argument);
  material.external_damping = 0.2;
  material.fundamental_period = 0.0;
  EXPECT_THROW(plane_model(cut, material), std::invalid_argument);
  material.external_damping = 0.0;
  material.breakable = true;
  material.softening.knee_opening = 5e-7;  // falls faster than a band of 1 cm unloads
  EXPECT_THROW(plane_model(cut, material), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
