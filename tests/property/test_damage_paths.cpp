// Invariants of every path of a damage analysis, for any body and load.

#include <gtest/gtest.h>

#include "material/softening.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Relative tolerance of energies, which are sums over at most 150 events. Each event adds
/// round-off (1e-16) times the condition number, up to several 1e5 near separation, limited by the
/// residual (1e-10).
constexpr double tolerance = 1e-9;

/// A bar across a crack yields forever. This number of rows covers the whole fracture of brittle
/// bonds.
constexpr int rows_of_brittle = 150;
int most_rows(const BlockCase& block) { return rows_of_brittle * (block.toothed ? 3 : 1); }

/// Row with energies computed from the elements.
struct Look {
  StepRecord row;
  double stored = 0.0;  ///< sum of k e^2 / 2 over the elements
  std::vector<double> secants;
};

class DamagePath : public testing::TestWithParam<BlockCase> {
 protected:
  void go(const DamageOptions& options) {
    Recorder recorder(
        [this](const StepRecord& row, StateSource& source) {
          const StepState state = source.state();
          const double factor = row.load_factor * row.load_factor;
          looks_.push_back(
              {row,
               factor * stored_energy(state.network, state.secants, state.displacement),
               {state.secants.begin(), state.secants.end()}});
        },
        most_rows(GetParam()));
    result_ = run(body_, options, recorder);
    ASSERT_GT(looks_.size(), 3u);
  }

  void expect_work_is_stored_or_dissipated() const {
    double largest = 0.0;
    for (const Look& look : looks_) {
      const StepRecord& row = look.row;
      largest = std::max(largest, row.external_work);
      EXPECT_NEAR(row.external_work, look.stored + row.dissipated_energy, tolerance * largest)
          << "row " << row.step;
      EXPECT_NEAR(row.strain_energy, look.stored, tolerance * largest) << "row " << row.step;
    }
    EXPECT_LT(result_.energy_error, tolerance);
  }

  void expect_damage_only_grows() const {
    for (std::size_t k = 1; k < looks_.size(); ++k) {
      const Look &before = looks_[k - 1], &after = looks_[k];
      EXPECT_GE(after.row.dissipated_energy, before.row.dissipated_energy);
      EXPECT_GE(after.row.released_energy, before.row.released_energy);
      for (std::size_t e = 0; e < after.secants.size(); ++e) {
        EXPECT_LE(after.secants[e], before.secants[e]) << "element " << e;
      }
    }
  }

  /// Expects that displacement over load does not fall; for prescribed displacements, that load
  /// over displacement does not rise.
  void expect_the_body_only_softens() const {
    for (std::size_t k = 1; k < looks_.size(); ++k) {
      const StepRecord &before = looks_[k - 1].row, &after = looks_[k].row;
      if (before.load == 0.0 || before.load_factor == 0.0) continue;
      EXPECT_LE(after.load * before.displacement,
                before.load * after.displacement * (1.0 + tolerance))
          << "row " << after.step;
    }
  }

  AnalysisBody body_ = make_block(GetParam());
  std::vector<Look> looks_;
  DamageResult result_;
};

TEST_P(DamagePath, EventByEvent) {
  go({});
  EXPECT_GT(result_.last.broken_bonds, 30) << "a path worth the name";
  if (GetParam().bar || GetParam().toothed) {
    EXPECT_GT(result_.last.yield_events, 30);
  }
  expect_work_is_stored_or_dissipated();
  expect_damage_only_grows();
  expect_the_body_only_softens();
  // An element that fails at lambda_k releases lambda_k^2 k e^2 / 2. The path dissipates lambda_k
  // lambda_(k+1) k e^2 / (2 pivot). Removing stiffness never makes a body stiffer, so pivot <= 1.
  // The sums can be in either order: where the load drops steeply, part of the released energy
  // returns to the load.
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    const StepRecord &before = looks_[k - 1].row, &after = looks_[k].row;
    const double released = after.released_energy - before.released_energy;
    const double dissipated = after.dissipated_energy - before.dissipated_energy;
    EXPECT_GE(dissipated * before.load_factor + tolerance * after.external_work * after.load_factor,
              released * after.load_factor)
        << "row " << after.step;
  }
}

TEST_P(DamagePath, InLoadSteps) {
  Recorder events({}, most_rows(GetParam()));
  run(body_, {}, events);
  double peak = 0.0;
  for (const StepRecord& row : events.rows) peak = std::max(peak, row.load_factor);
  const double first = events.rows[0].load_factor;
  DamageOptions options;
  for (int k = 0; k <= 20; ++k) {
    options.load_factors.push_back(0.9 * first + 0.05 * k * (1.02 * peak - 0.9 * first));
  }
  options.load_factors.push_back(0.5 * peak);  // unload
  go(options);
  expect_work_is_stored_or_dissipated();
  expect_damage_only_grows();
  expect_the_body_only_softens();
  // All events of a step have its load factor. With pivot <= 1 the path dissipates at least the
  // energy that the elements released.
  for (const Look& look : looks_) {
    EXPECT_GE(look.row.dissipated_energy * (1.0 + tolerance), look.row.released_energy);
  }
}

std::vector<BlockCase> cases() {
  std::vector<BlockCase> result;
  for (const LatticeCase& lattice :
       {LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
        LatticeCase{"rectangular_ghost", Pattern::rectangular, Surface::ghost},
        LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
        LatticeCase{"hexagonal_ghost", Pattern::hexagonal, Surface::ghost}}) {
    for (const bool driven : {false, true}) {
      for (const bool bar : {false, true}) result.push_back({lattice, driven, bar, 8});
    }
  }
  for (const bool driven : {false, true}) {
    result.push_back({{"cubic", Pattern::cubic, Surface::none}, driven, false, 4});
    result.push_back({{"cubic", Pattern::cubic, Surface::none}, driven, false, 3, 0.1, true});
    for (const bool bar : {false, true}) {
      result.push_back(
          {{"hexagonal", Pattern::hexagonal, Surface::none}, driven, bar, 8, 0.1, true});
    }
    result.push_back(
        {{"rectangular_ghost", Pattern::rectangular, Surface::ghost}, driven, true, 8, 0.1, true});
    for (const bool micropolar : {false, true}) {
      result.push_back({{"hexagonal", Pattern::hexagonal, Surface::none},
                        driven,
                        !micropolar,
                        8,
                        0.1,
                        micropolar,
                        true});
      result.push_back(
          {{"cubic", Pattern::cubic, Surface::none}, driven, false, 3, 0.1, micropolar, true});
    }
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Bodies, DamagePath, testing::ValuesIn(cases()),
                         [](const auto& test) { return to_string(test.param); });

/// The bodies with segments above, with segments of softening curves.
class SofteningPath : public DamagePath {
 protected:
  void expect_path(const SofteningShape& shape) {
    body_.network.laws.front() = saw_tooth_of(SofteningCurve(shape, 6.0), 0.15);
    looks_.clear();
    go({});
    EXPECT_GT(result_.last.yield_events, 100);
    expect_work_is_stored_or_dissipated();
    expect_damage_only_grows();
    expect_the_body_only_softens();
  }
};

TEST_P(SofteningPath, EventByEvent) {
  for (const Softening kind : {Softening::linear, Softening::bilinear, Softening::exponential}) {
    expect_path({kind});
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, SofteningPath, testing::ValuesIn([] {
                           std::vector<BlockCase> toothed;
                           for (const BlockCase& block : cases()) {
                             if (block.toothed) toothed.push_back(block);
                           }
                           return toothed;
                         }()),
                         [](const auto& test) { return to_string(test.param); });

}  // namespace
}  // namespace perilink
