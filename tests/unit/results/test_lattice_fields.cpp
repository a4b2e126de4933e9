#include "results/lattice_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "analysis/dynamics/lattice/rows/row_kernels.hpp"
#include "app/plot/plot_body.hpp"
#include "model/from_case/lattice_case.hpp"
#include "results/field_file.hpp"
#include "support/lattice_models.hpp"
#include "support/program_cases.hpp"

namespace perilink {
namespace {

using namespace testing_support;

const std::vector<double>& values(const VtuGrid& grid, const std::string& name) {
  const VtuArray* array = grid.find_point_data(name);
  EXPECT_NE(array, nullptr) << name;
  static const std::vector<double> none;
  return array == nullptr ? none : array->values;
}

/// A uniform strain along x.
ExplicitState stretched(const ExplicitModel& model, double strain) {
  ExplicitState state(model);
  const LatticeRows& lattice = model.lattice;
  for (const Index slot : lattice.particle_slot) {
    state.displacement[slot] = strain * lattice.positions[slot];
    state.velocity[lattice.at(1, slot)] = 7.0;
  }
  for (Index r = 0; r < static_cast<Index>(lattice.rows.size()); ++r) {
    measure_bonds(model, state, r, 1e-6);
  }
  for (Index r = 0; r < static_cast<Index>(lattice.rows.size()); ++r) {
    sum_stretches(model, state, r);
  }
  return state;
}

TEST(ExplicitFields, HoldEveryParticleOnce) {
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 0.0), elastic_concrete());
  ExplicitRecord record;
  record.step = 42;
  record.time = 0.25;
  record.load_factor = 0.5;
  record.load = 3.0;
  const VtuGrid grid = make_lattice_grid(model, stretched(model, 1e-3), record);
  const std::size_t count = model.lattice.particle_slot.size();
  EXPECT_EQ(grid.points.size(), 3 * count);
  EXPECT_EQ(grid.types.size(), count);
  EXPECT_EQ(grid.offsets.back(), static_cast<Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Index slot = model.lattice.particle_slot[i];
    EXPECT_EQ(grid.points[3 * i], model.lattice.positions[slot]);
    EXPECT_EQ(values(grid, "displacement")[3 * i], 1e-3 * grid.points[3 * i]);
    EXPECT_EQ(values(grid, "velocity")[3 * i + 1], 7.0);
    EXPECT_EQ(values(grid, "velocity")[3 * i + 2], 0.0);
    EXPECT_EQ(values(grid, "volume")[i], model.volume[slot]);
  }
  EXPECT_EQ(grid.field("step", 0.0), 42.0);
  EXPECT_EQ(grid.field("time", 0.0), 0.25);
  EXPECT_EQ(grid.field("load_factor", 0.0), 0.5);
  EXPECT_EQ(grid.field("load", 0.0), 3.0);
  EXPECT_EQ(grid.field("spacing", 0.0), 0.01);
  EXPECT_EQ(grid.field("thickness", 0.0), model.thickness);
}

/// A run with a row at every step shows which particle cracked in which step.
TEST(ExplicitFields, NumberCracksInTheOrderOfTime) {
  struct Order final : ExplicitObserver {
    explicit Order(const ExplicitModel& of) : model(of) {}
    void on_row(const ExplicitRecord& record, const ExplicitState& state) override {
      for (Index i = 0; i < model.lattice.particles(); ++i) {
        if (state.damage[model.lattice.particle_slot[i]] == 0.0) continue;
        if (std::count(seen.begin(), seen.end(), i) == 0) seen.push_back(i);
      }
      grid = make_lattice_grid(model, state, record);
    }
    const ExplicitModel& model;
    std::vector<Index> seen;
    VtuGrid grid;
  };
  std::string text = test::lattice_strip_case();
  const std::string unbreakable = "fracture_energy = \"infinite\"";
  text.replace(text.find(unbreakable), unbreakable.size(),
               "tensile_strength = 1\nfracture_energy = 0.02");
  ExplicitCase built = build_explicit_case(parse_case(text, ""));
  const auto run = [&](int rows) {
    built.options.rows = rows;
    Order order(built.model);
    ExplicitState state(built.model);
    run_explicit_analysis(built.model, state, built.options, order);
    return std::pair(order.seen, order.grid.find_cell_data("broken_at")->values);
  };
  const std::vector<Index> seen = run(1000000).first;
  const std::vector<double> broken_at = run(1).second;
  ASSERT_GT(seen.size(), 10U);
  EXPECT_FALSE(std::is_sorted(seen.begin(), seen.end())) << "else this shows nothing";
  std::vector<double> expected(broken_at.size(), 0.0);
  for (std::size_t k = 0; k < seen.size(); ++k) expected[seen[k]] = static_cast<double>(k + 1);
  EXPECT_EQ(broken_at, expected);
}

/// Hooke's law inside the body, where the constants of the lattice are exact to first order.
void expect_hooke(const ExplicitModel& model, Problem problem, int neighbours) {
  const double strain = 1e-7;
  const VtuGrid grid = make_lattice_grid(model, stretched(model, strain), {});
  const HookeConstants hooke = hooke_constants(problem, 25e9, 0.2);
  const double xx = (hooke.lambda + 2.0 * hooke.mu) * strain, yy = hooke.lambda * strain;
  const double zz = problem == Problem::three_dimensional ? yy
                    : problem == Problem::plane_strain    ? 0.2 * (xx + yy)
                                                          : 0.0;
  const std::array<double, 6> expected = {xx, yy, zz};
  int inside = 0;
  for (std::size_t i = 0; i < model.lattice.particle_slot.size(); ++i) {
    if (model.lattice.bond_count[model.lattice.particle_slot[i]] < neighbours) continue;
    ++inside;
    const double* stress = values(grid, "stress").data() + 6 * i;
    // Stretches differ from strains by the square of the strain.
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], expected[c], 1e-6 * xx) << c;
  }
  EXPECT_GT(inside, 20);
}

TEST(ExplicitFields, StressesOfElasticBodiesFollowHooke) {
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    expect_hooke(plane_model(rectangle(0.05, 0.05, 0.01, 0.0), elastic_concrete(),
                             LatticeRules::consistent, problem),
                 problem, 6);
  }
  LatticeCut cut;
  cut.spacing = 0.1;
  cut.rotation = 0.3;
  cut.upper = {0.5, 0.5, 0.5};
  cut.inside = [](const Vector3&) { return true; };
  expect_hooke(make_explicit_model(Problem::three_dimensional, LatticeRules::consistent,
                                   face_centred_rows(cut), elastic_concrete(), 1.0),
               Problem::three_dimensional, 18);
}

TEST(ExplicitFields, BreakableBodiesHaveDamageInPlaceOfStress) {
  LatticeMaterial material = paper_concrete();
  material.breakable = true;
  const ExplicitModel model = plane_model(rectangle(0.03, 0.03, 0.01, 0.0), material);
  ExplicitState state = stretched(model, 0.0);
  state.damage[model.lattice.particle_slot[3]] = 0.75;
  const VtuGrid grid = make_lattice_grid(model, state, {});
  EXPECT_EQ(grid.find_point_data("stress"), nullptr);
  EXPECT_EQ(values(grid, "damage")[3], 0.75);
  EXPECT_EQ(values(grid, "damage")[4], 0.0);
}

TEST(ExplicitFields, ArePicturesOfABody) {
  const ExplicitModel model = plane_model(rectangle(0.03, 0.03, 0.01, 0.0), elastic_concrete());
  const PlotBody body = read_body(make_lattice_grid(model, stretched(model, 1e-3), {}), "");
  EXPECT_EQ(body.dim, 2);
  EXPECT_EQ(body.size(), model.lattice.particles());
  EXPECT_EQ(body.stress.size(), body.positions.size());
  EXPECT_TRUE(body.broken_bonds.empty());
}

}  // namespace
}  // namespace perilink
