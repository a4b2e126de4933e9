// Embedded particles, constrained by unknowns of other particles: invariants for any hosts.

#include <gtest/gtest.h>

#include <stdexcept>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "analysis/quasistatic/event_run.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using Share = Unknowns::Share;

/// Particle constrained by `hosts` with equal weights.
struct Embedded {
  Index particle;
  std::vector<Index> hosts;
};

/// Numbers the unknowns again with these particles embedded.
void carry(AnalysisBody& body, const std::vector<Embedded>& all) {
  const Unknowns before = body.unknowns;
  const int width = body.network.width();
  const auto is_embedded = [&](Index i) {
    return std::any_of(all.begin(), all.end(), [&](const Embedded& c) { return c.particle == i; });
  };
  number(body, [&](Index i, int axis) { return before.at(i, axis) == no_index || is_embedded(i); });
  for (const Embedded& embedded : all) {
    for (int axis = 0; axis < width; ++axis) {
      std::vector<Share> shares;
      for (const Index host : embedded.hosts) {
        shares.push_back(
            {body.unknowns.at(host, axis), 1.0 / static_cast<double>(embedded.hosts.size())});
      }
      body.unknowns.carry(slot(body, embedded.particle, axis), shares);
    }
  }
}

/// Returns the particle nearest to a point.
Index nearest(const Network& network, double x, double y) {
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto at = network.particles.position(i);
    const double distance = std::hypot(at[0] - x, at[1] - y);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

struct EmbeddedCase {
  bool driven, micropolar, toothed;
};

AnalysisBody block_of(const EmbeddedCase& param) {
  BlockCase block;
  block.lattice = {"plane", Pattern::rectangular, Surface::none};
  block.columns = 8;
  block.driven = param.driven;
  block.micropolar = param.micropolar;
  block.toothed = param.toothed;
  return make_block(block);
}

/// Block with a rigid pair and a particle that moves as the mean of its left and right neighbours.
/// The pair of bonds without moments keeps its direction.
class EmbeddedParticles : public testing::TestWithParam<EmbeddedCase> {
 protected:
  EmbeddedParticles() : body_(block_of(GetParam())) {
    const auto& bounds = body_.network.particles;
    Vector3 end{};
    for (Index i = 0; i < bounds.size(); ++i) {
      for (int a = 0; a < 2; ++a) end[a] = std::max(end[a], bounds.position(i)[a]);
    }
    const Index at = nearest(body_.network, 0.6 * end[0], 0.3 * end[1]);
    const double x = bounds.position(at)[0], y = bounds.position(at)[1];
    const double step = bounds.position(1)[0] - bounds.position(0)[0];
    pair_ = {nearest(body_.network, 0.4 * end[0], 0.7 * end[1]), {}};
    const auto first = bounds.position(pair_.particle);
    pair_.hosts = {nearest(body_.network, first[0], first[1] - step)};
    mean_ = {at, {nearest(body_.network, x - step, y), nearest(body_.network, x + step, y)}};
    carry(body_, {pair_, mean_});
  }

  /// Returns the dense matrix T of the constraints as defined.
  Eigen::MatrixXd dense_map() const {
    const Unknowns& unknowns = body_.unknowns;
    Eigen::MatrixXd map =
        Eigen::MatrixXd::Zero(static_cast<Index>(unknowns.number.size()), unknowns.count);
    for (Index i = 0; i < body_.network.particles.size(); ++i) {
      for (int a = 0; a < body_.network.width(); ++a) {
        const auto row = static_cast<Index>(slot(body_, i, a));
        const bool free = i != pair_.particle && i != mean_.particle;
        if (free && unknowns.at(i, a) != no_index) map(row, unknowns.at(i, a)) = 1.0;
      }
    }
    for (const Embedded& embedded : {pair_, mean_}) {
      for (int a = 0; a < body_.network.width(); ++a) {
        for (const Index host : embedded.hosts) {
          map(static_cast<Index>(slot(body_, embedded.particle, a)), body_.unknowns.at(host, a)) +=
              1.0 / static_cast<double>(embedded.hosts.size());
        }
      }
    }
    return map;
  }

  Eigen::VectorXd dense_answer(Secants secants) const {
    const Eigen::MatrixXd matrix = dense_stiffness(body_.network, secants), map = dense_map();
    const auto vector = [&](const std::vector<double>& values) {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), matrix.rows());
    };
    const Eigen::VectorXd prescribed = vector(body_.unknowns.prescribed);
    const Eigen::VectorXd load =
        map.transpose() * (vector(body_.loads.forces) - matrix * prescribed);
    return prescribed + map * (map.transpose() * matrix * map).ldlt().solve(load);
  }

  AnalysisBody body_;
  Embedded pair_, mean_;
};

/// Round-off (1e-16) times a condition number of several 1e5.
constexpr double embedded_round_off = 1e-10;

TEST_P(EmbeddedParticles, EventsAreThoseOfTheConstrainedBody) {
  for (const FactorRoute route :
       {FactorRoute::in_place, FactorRoute::cholmod_updown, FactorRoute::refactorize}) {
    EquilibriumOptions options;
    options.route = route;
    const auto engine = make_event_engine(body_, options);
    std::vector<int> segments(static_cast<std::size_t>(body_.network.num_elements()), 0);
    for (int k = 0; k < 25; ++k) {
      const Eigen::VectorXd expected = dense_answer(engine->secants());
      const std::vector<double> displacement(expected.begin(), expected.end());
      EXPECT_LT(difference(engine->displacement(), expected), embedded_round_off) << k;
      Index first = no_index;
      double largest = 0.0;
      for (Index e = 0; e < body_.network.num_elements(); ++e) {
        const double limit =
            body_.network.critical_stretch[e] * body_.network.law(e).segment(segments[e]).limit;
        const double ratio = stretch(body_.network, displacement, e) / limit;
        if (engine->secants()[e] == 0.0 || !(ratio > largest)) continue;
        largest = ratio;
        first = e;
      }
      const Event event = engine->next_event();
      ASSERT_EQ(event.element, first) << k;
      EXPECT_NEAR(event.load_factor * largest, 1.0, embedded_round_off);
      ASSERT_FALSE(engine->apply(event).mechanism);
      ++segments[first];
    }
    EXPECT_LT(engine->check_equilibrium().residual, embedded_round_off);
  }
}

TEST_P(EmbeddedParticles, WorkIsStoredOrDissipated) {
  double largest = 0.0;
  Recorder recorder(
      [&](const StepRecord& row, StateSource& source) {
        const StepState state = source.state();
        const double stored = row.load_factor * row.load_factor *
                              stored_energy(state.network, state.secants, state.displacement);
        largest = std::max(largest, row.external_work);
        EXPECT_NEAR(row.external_work, stored + row.dissipated_energy,
                    10.0 * embedded_round_off * largest)
            << "row " << row.step;
      },
      150);
  const DamageResult result = run(body_, {}, recorder);
  EXPECT_GT(recorder.rows.size(), 60U);
  EXPECT_LT(result.energy_error, 10.0 * embedded_round_off);
}

/// From the twentieth row both particles are free. Displacements and events then equal those of a
/// free body with the same secants. The constraint energy is neither lost nor counted as
/// dissipation.
TEST_P(EmbeddedParticles, MayBecomeFreeDuringARun) {
  const AnalysisBody free = block_of(GetParam());
  double largest = 0.0, freed = 0.0;
  Recorder recorder(
      [&](const StepRecord& row, StateSource& source) {
        const StepState state = source.state();
        const double stored = row.load_factor * row.load_factor *
                              stored_energy(state.network, state.secants, state.displacement);
        largest = std::max(largest, row.external_work);
        const double missing = row.external_work - stored - row.dissipated_energy;
        if (row.step <= 20) {
          EXPECT_NEAR(missing, 0.0, 10.0 * embedded_round_off * largest) << "row " << row.step;
          return;
        }
        EXPECT_LT(difference(state.displacement, dense_displacement(free, state.secants)),
                  embedded_round_off)
            << "row " << row.step;
        if (row.step == 21) freed = missing;
        EXPECT_NEAR(missing, freed, 10.0 * embedded_round_off * largest) << "row " << row.step;
      },
      60);
  const DamageOptions options;
  EventRun path(body_, options);
  while (const StepRecord* row = recorder.stop_requested() ? nullptr : path.next()) {
    recorder.on_step(*row, path);
    if (row->step == 20) path.adopt(free.unknowns);
  }
  const DamageResult result = path.result();
  ASSERT_EQ(recorder.rows.size(), 60U);
  EXPECT_GT(freed, 1e-6 * largest);
  EXPECT_NEAR(result.last.constraint_energy, freed, 10.0 * embedded_round_off * largest);
  EXPECT_LT(result.energy_error, 10.0 * embedded_round_off);
}

TEST_P(EmbeddedParticles, MoveAsTheirCarriersDo) {
  const ElasticResult result = run_elastic_analysis(body_);
  EXPECT_LT(difference(result.displacement, dense_answer(intact(body_.network))),
            embedded_round_off);
  for (int a = 0; a < body_.network.width(); ++a) {
    EXPECT_EQ(result.displacement[slot(body_, pair_.particle, a)],
              result.displacement[slot(body_, pair_.hosts[0], a)]);
  }
  EXPECT_LT(result.residual, embedded_round_off);
}

INSTANTIATE_TEST_SUITE_P(Bodies, EmbeddedParticles,
                         testing::Values(EmbeddedCase{false, false, false},
                                         EmbeddedCase{true, false, true},
                                         EmbeddedCase{false, true, true},
                                         EmbeddedCase{true, true, false}));

/// Constraints that reproduce uniform strain keep it exact. A linear displacement is prescribed on
/// a block except its middle, where one particle is the mean of its neighbours.
TEST(EmbeddedParticle, PassesThePatchTest) {
  AnalysisBody body =
      make_block({{"plane", Pattern::rectangular, Surface::none}, false, false, 10});
  const Network& network = body.network;
  const std::vector<double> field =
      linear_field(network.particles, {{{1.0, 0.3, 0}, {-0.2, 0.5, 0}, {}}});
  Vector3 end{};
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (int a = 0; a < 2; ++a) end[a] = std::max(end[a], network.particles.position(i)[a]);
  }
  const double step = network.particles.position(1)[0] - network.particles.position(0)[0];
  const Index middle = nearest(network, 0.5 * end[0], 0.5 * end[1]);
  const auto at = network.particles.position(middle);
  const auto inside = [&](Index i) {
    const auto x = network.particles.position(i);
    return std::abs(x[0] - at[0]) < 1.5 * step && std::abs(x[1] - at[1]) < 1.5 * step;
  };
  std::fill(body.loads.forces.begin(), body.loads.forces.end(), 0.0);
  body.unknowns.prescribed.assign(field.size(), 0.0);
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (int a = 0; a < 2 && !inside(i); ++a) {
      body.unknowns.prescribed[slot(body, i, a)] = field[slot(body, i, a)];
    }
  }
  number(body, [&](Index i, int) { return !inside(i); });
  carry(body,
        {{middle, {nearest(network, at[0] - step, at[1]), nearest(network, at[0] + step, at[1])}}});
  ASSERT_EQ(body.unknowns.count, 16);
  const ElasticResult result = run_elastic_analysis({network, body.unknowns, body.loads, {}});
  for (std::size_t k = 0; k < field.size(); ++k) {
    EXPECT_NEAR(result.displacement[k], field[k], 1e-12);  // round-off of values of about ten
  }
}

/// Restriction is the transpose of expansion.
TEST(EmbeddedParticle, ForcesGoWhereTheMotionComesFrom) {
  Unknowns unknowns = number_unknowns(2, {0, 0, 0, 1, 1, 1}, std::vector<double>(6, 0.0));
  unknowns.carry(4, std::vector<Share>{{0, 0.25}, {2, 0.75}});
  ASSERT_EQ(unknowns.count, 3);
  EXPECT_TRUE(unknowns.carries());
  EXPECT_TRUE(unknowns.is_embedded(4));
  EXPECT_FALSE(unknowns.is_embedded(3));
  EXPECT_EQ(unknowns.expand(std::vector<double>{1, 2, 3}),
            (std::vector<double>{1, 2, 3, 0, 2.5, 0}));
  EXPECT_EQ(unknowns.restrict(std::vector<double>{1, 2, 3, 7, 8, 9}),
            (std::vector<double>{3, 2, 9}));
  EXPECT_EQ(unknowns.slots(), (std::vector<std::size_t>{0, 1, 2}));
}

/// Explicit runs refuse embedded particles, because their own bonds would move them.
TEST(EmbeddedParticle, IsRefusedWhereEveryParticleMovesByItself) {
  Unknowns unknowns = number_unknowns(2, {0, 0, 1, 1}, std::vector<double>(4, 0.0));
  EXPECT_NO_THROW(expect_nothing_embedded(unknowns));
  unknowns.carry(2, std::vector<Share>{{0, 1.0}});
  EXPECT_THROW(expect_nothing_embedded(unknowns), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
