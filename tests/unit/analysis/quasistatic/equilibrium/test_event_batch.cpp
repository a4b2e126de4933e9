#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"
#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "io/case/case_words.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

std::span<const double> as_span(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

constexpr double stage_load_factor = 0.7;
/// Round-off of a dense solution, of some changes of the factor and of conjugate gradients.
constexpr double batch_closeness = 1e-9;

struct BatchBody {
  BlockCase block;
  FactorRoute route = FactorRoute::in_place;
  bool in_stages = false;  ///< a growing load with constant loads
  LinearSolver solver = LinearSolver::direct;
};

std::string name_of(const BatchBody& body) {
  return to_string(body.block) + "_" + std::string(word_of(body.route)) +
         (body.in_stages ? "_in_stages" : "") +
         (body.solver == LinearSolver::iterative ? "_boxes" : "");
}

std::ostream& operator<<(std::ostream& out, const BatchBody& body) { return out << name_of(body); }

/// A body whose equilibrium follows batches of random elements, compared with dense solutions.
class FollowedBody {
 public:
  explicit FollowedBody(const BatchBody& kind)
      : growing(make_block(kind.block)), constant(growing), in_stages_(kind.in_stages) {
    EquilibriumOptions options{.route = kind.route, .solver = kind.solver};
    options.subdomains.tolerance = 1e-12;
    options.event_tolerance = 0.02;
    equilibrium.emplace(growing, options);
    if (!in_stages_) return;
    for (std::size_t k = 0; k < constant.loads.forces.size(); ++k) {
      const bool held = growing.unknowns.number[k] == no_index;
      constant.loads.forces[k] = held ? 0.0 : std::sin(1.0 + static_cast<double>(k));
      constant.unknowns.prescribed[k] *= -0.3;
    }
    ConstantLoads field;
    field.unknowns = constant.unknowns;
    field.loads = constant.loads;
    equilibrium->begin_stage(growing.unknowns, growing.loads, field);
    equilibrium->move_to(stage_load_factor);
  }

  /// Elements that may fail, are not broken and do not carry on closed cracks; some break, others
  /// go on with less than they have.
  std::vector<Weakening> random_batch(std::size_t count, unsigned seed) const {
    const Secants secants = equilibrium->secants();
    std::vector<Weakening> all, batch;
    for (Index e = 0; e < growing.network.num_elements(); ++e) {
      const bool closed = secants.axial(e) > secants[e];
      if (!growing.network.has_limit(e) || secants[e] < 0.1 || closed) continue;
      all.push_back({e, e % 3 == 0 ? 0.0 : e % 3 == 1 ? 0.6 * secants[e] : 0.05});
    }
    std::mt19937 random(seed);
    std::ranges::sample(all, std::back_inserter(batch), static_cast<std::ptrdiff_t>(count), random);
    return batch;
  }

  Eigen::MatrixXd stiffness() const {
    return dense_stiffness(growing.network, equilibrium->secants());
  }
  Eigen::VectorXd grown() const { return dense_displacement(growing, equilibrium->secants()); }
  Eigen::VectorXd rested() const { return dense_displacement(constant, equilibrium->secants()); }

  /// Fields, sides and the residual, by the elements as they are.
  void expect_equilibrium() {
    EXPECT_LT(difference(equilibrium->displacement(), grown()), batch_closeness);
    if (in_stages_) {
      EXPECT_LT(difference(equilibrium->solution().permanent()->field().displacement, rested()),
                batch_closeness);
    }
    const Eigen::VectorXd now = in_stages_ ? Eigen::VectorXd(0.7 * grown() + rested()) : grown();
    for (Index e = 0; e < growing.network.num_elements(); ++e) {
      const Secants secants = equilibrium->secants();
      if (secants[e] == 1.0 || !growing.network.law(e).closes()) continue;
      const double extension = extension_of(growing.network, as_span(now), e);
      if (std::abs(extension) < batch_closeness * now.cwiseAbs().maxCoeff()) continue;
      EXPECT_EQ(secants.axial(e) == secants[e], extension > 0.0) << "element " << e;
    }
    const Balance balance = equilibrium->check();
    EXPECT_LE(balance.residual, 1e-10);
  }

  /// Applies a batch and checks everything that it returns and changes.
  void expect_followed(const std::vector<Weakening>& batch) {
    const Eigen::MatrixXd before = stiffness();
    const Eigen::VectorXd u = grown();
    const Eigen::VectorXd c = in_stages_ ? rested() : Eigen::VectorXd::Zero(u.size());
    const double compliance = equilibrium->work().compliance();
    const Eigen::VectorXd now = in_stages_ ? Eigen::VectorXd(c + stage_load_factor * u) : u;
    double lost = 0.0, lost_now = 0.0, lost_then = 0.0, lost_by_permanent = 0.0;
    for (const auto& change : batch) {
      const double part = equilibrium->secants()[change.element] - change.secant;
      lost += energy_lost(equilibrium->solution(), change);
      lost_now += 2.0 * part * element_energy(growing.network, as_span(now), change.element);
      lost_then += 2.0 * part * element_energy(growing.network, as_span(u), change.element);
      lost_by_permanent += 2.0 * part * element_energy(growing.network, as_span(c), change.element);
    }

    const auto outcome = equilibrium->weaken_together(batch);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_FALSE(outcome->mechanism);
    EXPECT_GT(outcome->pivot, 0.0);
    EXPECT_LE(outcome->pivot, 1.0);

    const LoadWork work = equilibrium->work();
    const double size = work.forces + work.supports;
    EXPECT_NEAR(outcome->compliance_growth, work.compliance() - compliance, batch_closeness * size);
    const Eigen::MatrixXd gone = before - stiffness();
    const Eigen::VectorXd u_now = grown();
    EXPECT_NEAR(outcome->compliance_growth, u.dot(gone * u_now), batch_closeness * size);
    if (in_stages_) {
      const Eigen::VectorXd c_now = rested();
      const double all = std::abs(c.dot(before * c)) + size;
      EXPECT_NEAR(outcome->permanent_growth.linear, u.dot(gone * c_now) + c.dot(gone * u_now),
                  batch_closeness * all);
      EXPECT_NEAR(outcome->permanent_growth.constant, c.dot(gone * c_now), batch_closeness * all);
      EXPECT_NEAR(outcome->released_by_permanent.constant, 0.5 * lost_by_permanent,
                  batch_closeness * all);
      if (!growing.network.has_closing()) {
        EXPECT_NEAR(outcome->released_by_permanent.linear, u.dot(gone * c), batch_closeness * all);
      }
    }
    EXPECT_NEAR(outcome->released, 0.5 * lost_then, batch_closeness * size);
    EXPECT_NEAR(lost, lost_now, batch_closeness * (size + std::abs(lost_now)));
    expect_equilibrium();
  }

  AnalysisBody growing, constant;
  std::optional<Equilibrium> equilibrium;

 private:
  bool in_stages_;
};

class TogetherFailing : public testing::TestWithParam<BatchBody> {};

TEST_P(TogetherFailing, LeaveTheEquilibriumOfWhatIsLeft) {
  FollowedBody body(GetParam());
  body.expect_equilibrium();
  unsigned seed = 0;
  for (const std::size_t count : {1U, 2U, 17U, 5U, 40U, 3U}) {
    SCOPED_TRACE(count);
    const auto batch = body.random_batch(count, ++seed);
    ASSERT_EQ(batch.size(), count);
    body.expect_followed(batch);
  }
}

/// Single events go on from what batches have left, and batches from what they leave.
TEST_P(TogetherFailing, TakeTurnsWithSingleEvents) {
  FollowedBody body(GetParam());
  for (unsigned seed = 20; seed < 24; ++seed) {
    body.expect_followed(body.random_batch(seed == 22 ? 30 : 6, seed));
    const auto [element, secant] = body.random_batch(1, seed + 50).front();
    const double before = body.equilibrium->work().compliance();
    const EventOutcome outcome = body.equilibrium->weaken(element, secant);
    ASSERT_FALSE(outcome.mechanism);
    const LoadWork work = body.equilibrium->work();
    EXPECT_NEAR(outcome.compliance_growth, work.compliance() - before,
                batch_closeness * (work.forces + work.supports));
    body.expect_equilibrium();
  }
}

std::vector<BatchBody> batch_bodies() {
  std::vector<BatchBody> result;
  for (const bool driven : {false, true}) {
    const BlockCase plane{hexagonal, driven, false, 8, 0.1, false, true};
    BlockCase frames = plane, closing = plane, bar = plane;
    frames.micropolar = closing.closing = bar.bar = true;
    for (const FactorRoute route : routes) {
      for (const bool in_stages : {false, true}) result.push_back({plane, route, in_stages});
      result.push_back({frames, route, driven});
    }
    result.push_back({frames, FactorRoute::in_place, !driven});
    for (const bool in_stages : {false, true}) {
      result.push_back({closing, FactorRoute::in_place, in_stages});
    }
    result.push_back({bar});
    for (const bool in_stages : {false, true}) {
      result.push_back({{cubic, driven, false, 5, 0.1, false, true}, {}, in_stages});
    }
    result.push_back({{cubic, driven, false, 4, 0.1, true, true}, {}, driven});
    BatchBody subdomains{{cubic, driven, false, 6, 0.1, false, true}};
    subdomains.solver = LinearSolver::iterative;
    result.push_back(subdomains);
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Blocks, TogetherFailing, testing::ValuesIn(batch_bodies()),
                         [](const auto& test) { return name_of(test.param); });

// The method of a batch shows in the number of factors, and in whether the next single event needs
// a new factor.

enum class Took { change, renewal, gradients };

Took way_of(FollowedBody& body, const std::vector<Weakening>& batch) {
  const int before = body.equilibrium->update().statistics().factorizations;
  body.expect_followed(batch);
  if (body.equilibrium->update().statistics().factorizations > before) return Took::renewal;
  const auto [element, secant] = body.random_batch(1, 99).front();
  EXPECT_FALSE(body.equilibrium->weaken(element, secant).mechanism);
  return body.equilibrium->update().statistics().factorizations > before ? Took::gradients
                                                                         : Took::change;
}

/// In space a factor costs much more than a solve.
TEST(Batches, AFactorInSpaceIsLeftBehind) {
  for (const bool closing : {false, true}) {
    for (const bool in_stages : {false, true}) {
      FollowedBody body({{cubic, in_stages, false, 7, 0.1, false, true, closing}, {}, in_stages});
      EXPECT_EQ(way_of(body, body.random_batch(2, 1)), Took::change);
      EXPECT_EQ(way_of(body, body.random_batch(200, 2)), Took::gradients);
      EXPECT_EQ(way_of(body, body.random_batch(2, 3)), Took::change);
    }
  }
}

/// It preconditions until its absence has cost as much as a new one.
TEST(Batches, AFactorLeftBehindIsMadeAnewWhereThatPays) {
  for (const bool in_stages : {false, true}) {
    FollowedBody body({{cubic, false, false, 7, 0.1, false, true}, {}, in_stages});
    const int first = body.equilibrium->update().statistics().factorizations;
    body.expect_followed(body.random_batch(200, 1));
    EXPECT_EQ(body.equilibrium->update().statistics().factorizations, first);
    int batches = 0;
    while (body.equilibrium->update().statistics().factorizations == first && batches < 20) {
      body.expect_followed(body.random_batch(2, 10 + static_cast<unsigned>(batches)));
      ++batches;
    }
    EXPECT_GT(batches, 1);
    EXPECT_LT(batches, 20);
    EXPECT_EQ(body.equilibrium->update().statistics().factorizations, first + 1);
    EXPECT_EQ(way_of(body, body.random_batch(2, 40)), Took::change);
  }
}

/// All bonds across the middle.
class Separating : public testing::TestWithParam<BatchBody> {};

TEST_P(Separating, BatchesAreRefusedAndLeaveAllAsItWas) {
  const BatchBody& kind = GetParam();
  FollowedBody body(kind);
  body.expect_followed(body.random_batch(6, 5));
  const Particles& particles = body.growing.network.particles;
  double end = 0.0;
  for (Index i = 0; i < particles.size(); ++i) end = std::max(end, particles.position(i)[0]);
  const auto right = [&](Index i) { return particles.position(i)[0] > 0.5 * end; };
  std::vector<Weakening> crossing;
  const Secants secants = body.equilibrium->secants();
  for (Index e = 0; e < body.growing.network.num_elements(); ++e) {
    const Bonds& bonds = body.growing.network.bonds;
    if (right(bonds.first[e]) == right(bonds.second[e]) || secants[e] == 0.0) continue;
    ASSERT_TRUE(body.growing.network.has_limit(e));
    if (secants.axial(e) == secants[e]) crossing.push_back({e, 0.0});
  }
  ASSERT_GT(crossing.size(), 20U);
  const std::vector<double> before(body.equilibrium->displacement().begin(),
                                   body.equilibrium->displacement().end());
  const LoadWork work = body.equilibrium->work();
  std::vector<double> kept, sides;
  for (Index e = 0; e < body.growing.network.num_elements(); ++e) {
    kept.push_back(secants[e]);
    sides.push_back(secants.axial(e));
  }
  EXPECT_FALSE(body.equilibrium->weaken_together(crossing).has_value());
  for (Index e = 0; e < body.growing.network.num_elements(); ++e) {
    EXPECT_EQ(body.equilibrium->secants()[e], kept[e]);
    EXPECT_EQ(body.equilibrium->secants().axial(e), sides[e]);
  }
  EXPECT_LT(difference(body.equilibrium->displacement(),
                       Eigen::Map<const Eigen::VectorXd>(before.data(), before.size())),
            batch_closeness);
  EXPECT_NEAR(body.equilibrium->work().compliance(), work.compliance(),
              batch_closeness * (work.forces + work.supports));
  body.expect_equilibrium();
  crossing.resize(crossing.size() / 3);  // the others hold the body
  if (!kind.block.closing) body.expect_followed(crossing);
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, Separating,
    testing::Values(BatchBody{{hexagonal, false, false, 8, 0.1, false, true}},
                    BatchBody{{hexagonal, true, false, 8, 0.1, true, true}},
                    BatchBody{{hexagonal, true, false, 8, 0.1, true, true}, {}, true},
                    BatchBody{{hexagonal, false, false, 8, 0.1, false, true, true}, {}, true},
                    BatchBody{{cubic, false, false, 7, 0.1, false, true}},
                    BatchBody{{cubic, true, false, 7, 0.1, false, true}, {}, true}),
    [](const auto& test) { return name_of(test.param); });

TEST(Batches, ElementsWithoutALimitStandAlone) {
  FollowedBody body(BatchBody{{hexagonal, false, false, 8, 0.1, false, true}});
  auto batch = body.random_batch(4, 1);
  Index unbreakable = 0;
  while (body.growing.network.has_limit(unbreakable)) ++unbreakable;
  batch.push_back({unbreakable, 0.0});
  EXPECT_FALSE(body.equilibrium->weaken_together(batch).has_value());
  for (const auto& change : batch) {
    EXPECT_EQ(body.equilibrium->secants()[change.element], 1.0);
  }
  body.expect_equilibrium();
}

}  // namespace
}  // namespace perilink
