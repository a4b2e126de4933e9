// Bodies of bonds with the law of concrete. For any loading every event is at its limit and
// dissipates the energy of its segment, and all routes give identical events.

#include <gtest/gtest.h>

#include <map>

#include "material/softening.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Tolerance of sums over several hundred events until the body separates.
constexpr double concrete_tolerance = 1e-8;
constexpr int rows = 250;

/// Least number of events for a branch of the law to count as tested.
constexpr int few = 5;

struct ConcreteCase {
  std::string name;
  LatticeCase lattice;
  int columns;
  double drive;  ///< displacement of the right face
  bool keeps_shear;
};

std::ostream& operator<<(std::ostream& out, const ConcreteCase& each) { return out << each.name; }

BondLaw concrete(bool keeps_shear) {
  const SofteningShape shape{Softening::concrete};
  const SofteningCurve tension(shape, softening_energy(shape, 2.0));
  const SofteningCurve compression(shape, softening_energy(shape, 3.0));
  return saw_tooth_of(tension, 0.15).crushing(segments_of(compression, 0.15), 7.0, keeps_shear);
}

class ConcretePath : public testing::TestWithParam<ConcreteCase> {
 protected:
  ConcretePath() {
    const ConcreteCase& each = GetParam();
    body_ = make_block({each.lattice, true, false, each.columns, 0.1, true});
    body_.network.laws.front() = concrete(each.keeps_shear);
    for (double& u : body_.unknowns.prescribed) u *= each.drive;
    body_.reference.value *= each.drive;
    segment_.assign(static_cast<std::size_t>(body_.network.num_elements()), 0);
    awake_.assign(static_cast<std::size_t>(body_.network.particles.size()), 0);
  }

  double extension(Index e, std::span<const double> u) const {
    const Network& network = body_.network;
    double sum = 0.0;
    for (int a = 0; a < network.dim(); ++a) {
      sum += network.bonds.direction(e)[a] * (u[network.bonds.second[e] * network.width() + a] -
                                              u[network.bonds.first[e] * network.width() + a]);
    }
    return sum;
  }
  /// Returns the stretch over the limit of the next event, by the rules of the law.
  double ratio(Index e, double stretch) const {
    const Network& network = body_.network;
    const BondLaw& law = network.law(e);
    const int segment = segment_[e];
    if (!network.has_limit(e) || law.segment(segment).secant == 0.0) return 0.0;
    const double x = stretch / network.critical_stretch[e];
    if (x > 0.0) return segment >= 0 ? x / law.segment(segment).limit : 0.0;
    const bool awake = awake_[network.bonds.first[e]] || awake_[network.bonds.second[e]];
    if (segment > 0 || !awake) return 0.0;
    return -x / (segment == 0 ? law.first_in_compression() : law.segment(segment)).limit;
  }
  /// Returns the energy released by the element's next event in this motion.
  double pass(Index e, const StepState& state, double load_factor) {
    const Network& network = body_.network;
    const double all = element_energy(network, state.displacement, e) * load_factor * load_factor;
    const double stretched = extension(e, state.displacement) * load_factor;
    const double axial = 0.5 * network.stiffness[e] * stretched * stretched;
    const BondLaw& law = network.law(e);
    const double before = law.segment(segment_[e]).secant;
    segment_[e] = BondLaw::after(segment_[e], stretched < 0.0);
    if (segment_[e] == 1) awake_[network.bonds.first[e]] = awake_[network.bonds.second[e]] = 1;
    const double after = law.segment(segment_[e]).secant;
    ++events_[after == 0.0][stretched < 0.0];
    if (!law.keeps_shear()) return (before - after) * all;
    return (before - after) * axial + (after == 0.0 ? all - axial : 0.0);
  }

  AnalysisBody body_;
  std::vector<int> segment_;
  std::vector<std::uint8_t> awake_;
  std::map<bool, std::map<bool, int>> events_;  ///< by whether they broke and were in compression
};

TEST_P(ConcretePath, EventsAreWhereTheLawHasThemAndTakeTheEnergyOfTheirTeeth) {
  double released = 0.0, largest_work = 0.0;
  Recorder recorder(
      [&](const StepRecord& row, StateSource& source) {
        const StepState state = source.state();
        EXPECT_NEAR(row.released_energy, released, concrete_tolerance * released) << row.step;
        for (Index e = 0; e < body_.network.num_elements(); ++e) {
          const double stretch =
              row.load_factor * extension(e, state.displacement) / body_.network.bonds.lengths[e];
          const double found = ratio(e, stretch);
          EXPECT_LT(found, 1.0 + 1e-9) << "element " << e << ", row " << row.step;
          if (e == row.element) {
            EXPECT_NEAR(found, 1.0, 1e-9) << row.step;
          }
          const double secant = body_.network.law(e).segment(segment_[e]).secant;
          const bool whole = secant > 0.0 && body_.network.law(e).keeps_shear();
          EXPECT_EQ(state.secants.axial(e), secant);
          EXPECT_EQ(state.secants[e], whole ? 1.0 : secant);
        }
        const Eigen::VectorXd expected = dense_displacement(body_, state.secants);
        EXPECT_LT(difference(state.displacement, expected), concrete_tolerance) << row.step;
        const double stored = row.load_factor * row.load_factor *
                              stored_energy(state.network, state.secants, state.displacement);
        largest_work = std::max(largest_work, row.external_work);
        EXPECT_NEAR(row.external_work, stored + row.dissipated_energy,
                    concrete_tolerance * largest_work);
        if (row.element != no_index) released += pass(row.element, state, row.load_factor);
      },
      rows);
  const DamageResult result = run(body_, {}, recorder);
  EXPECT_GT(recorder.rows.size(), 100U);
  EXPECT_GT(result.last.yield_events, 50);
  EXPECT_GT(events_[false][false], few) << "segments in tension";
  if (GetParam().drive < 0.0) {
    EXPECT_GT(events_[false][true], few) << "segments in compression";
  }
}

TEST_P(ConcretePath, IsTheSameByAllRoutes) {
  std::map<FactorRoute, std::vector<StepRecord>> paths;
  for (const FactorRoute route : {FactorRoute::refactorize, FactorRoute::in_place}) {
    DamageOptions options;
    options.engine.route = route;
    Recorder recorder({}, rows);
    run(body_, options, recorder);
    paths[route] = recorder.rows;
  }
  const auto& fresh = paths[FactorRoute::refactorize];
  const auto& updated = paths[FactorRoute::in_place];
  ASSERT_EQ(fresh.size(), updated.size());
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    ASSERT_EQ(fresh[k].element, updated[k].element) << k;
    EXPECT_NEAR(fresh[k].load_factor, updated[k].load_factor,
                concrete_tolerance * fresh[k].load_factor);
  }
}

std::vector<ConcreteCase> concrete_cases() {
  const LatticeCase plane{"hexagonal", Pattern::hexagonal, Surface::none};
  const LatticeCase square{"rectangular", Pattern::rectangular, Surface::none};
  const LatticeCase cubic{"cubic", Pattern::cubic, Surface::none};
  return {{"pulled", plane, 7, 1.0, true},
          {"pulled_shear", plane, 7, 1.0, false},
          {"compressed", plane, 7, -1.0, true},
          {"compressed_shear", plane, 7, -1.0, false},
          {"square_compressed", square, 7, -1.0, true},
          {"space_pulled", cubic, 3, 1.0, true},
          {"space_compressed", cubic, 3, -1.0, true}};
}

INSTANTIATE_TEST_SUITE_P(Bodies, ConcretePath, testing::ValuesIn(concrete_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace perilink
