#include <gtest/gtest.h>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of a dense solution and of some changes of the factor.
constexpr double load_tolerance = 1e-9;

struct BodyKind {
  BlockCase block;
  FactorRoute route;
};

class PermanentLoads : public testing::TestWithParam<BodyKind> {
 protected:
  PermanentLoads() : growing_(make_block(GetParam().block)), constant_(growing_) {
    for (std::size_t slot = 0; slot < constant_.loads.forces.size(); ++slot) {
      const bool held = growing_.unknowns.number[slot] == no_index;
      constant_.loads.forces[slot] = held ? 0.0 : std::sin(1.0 + static_cast<double>(slot));
      constant_.unknowns.prescribed[slot] *= -0.3;
    }
    EquilibriumOptions options;
    options.route = GetParam().route;
    equilibrium_.emplace(growing_, options);
    ConstantLoads field;
    field.unknowns = constant_.unknowns;
    field.loads = constant_.loads;
    equilibrium_->begin_stage(growing_.unknowns, growing_.loads, field);
    equilibrium_->move_to(0.7);
  }

  /// f'u, and R'd of the motion d.
  static double product(const Eigen::VectorXd& forces, const std::vector<double>& motion) {
    return forces.dot(Eigen::Map<const Eigen::VectorXd>(motion.data(), forces.size()));
  }

  void expect_both_fields() {
    const auto secants = equilibrium_->secants();
    const Eigen::VectorXd constant = dense_displacement(constant_, secants);
    const Eigen::VectorXd growing = dense_displacement(growing_, secants);
    EXPECT_LT(difference(equilibrium_->solution().permanent()->field().displacement, constant),
              load_tolerance);
    EXPECT_LT(difference(equilibrium_->where_elements_fail(), growing), load_tolerance);
    const Eigen::VectorXd forces = dense_stiffness(growing_.network, secants) * constant;
    const ConstantWork work = equilibrium_->work().constant;
    const double size = std::abs(work.forces) + std::abs(work.supports);
    const std::vector<double> moved(growing.data(), growing.data() + growing.size());
    const std::vector<double> rested(constant.data(), constant.data() + constant.size());
    const auto as_vector = [](const std::vector<double>& values) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size())));
    };
    EXPECT_NEAR(work.forces, product(as_vector(constant_.loads.forces), rested),
                load_tolerance * size);
    EXPECT_NEAR(work.forces_on_motion, product(as_vector(constant_.loads.forces), moved),
                load_tolerance * size * 10.0);
    EXPECT_NEAR(work.supports, product(forces, constant_.unknowns.prescribed),
                load_tolerance * size);
    EXPECT_NEAR(work.growing_supports, product(forces, growing_.unknowns.prescribed),
                load_tolerance * size * 10.0);
    if (!GetParam().block.driven) {
      EXPECT_NEAR(work.growing_forces, product(as_vector(growing_.loads.forces), rested),
                  load_tolerance * size * 10.0);
    }
    const Balance balance = equilibrium_->check();
    EXPECT_LT(balance.residual, 1e-10);
    EXPECT_NEAR(balance.stored_by_permanent.constant, 0.5 * forces.dot(constant),
                load_tolerance * size);
    EXPECT_NEAR(balance.stored_by_permanent.linear, forces.dot(growing),
                load_tolerance * size * 10.0);
  }

  AnalysisBody growing_, constant_;
  std::optional<Equilibrium> equilibrium_;
};

TEST_P(PermanentLoads, FollowTheSameEvents) {
  expect_both_fields();
  int events = 0;
  for (Index e = 3; e < growing_.network.num_elements() && events < 12; e += 17) {
    if (!growing_.network.has_limit(e)) continue;
    const ConstantWork before = equilibrium_->work().constant;
    const double secant = events % 3 == 0 ? 0.4 : 0.0;
    const EventOutcome outcome = equilibrium_->weaken(e, secant);
    ASSERT_FALSE(outcome.mechanism);
    ++events;
    // The compliance f_c'u_c - R_c'd_c grows by the value in the outcome.
    const ConstantWork after = equilibrium_->work().constant;
    const double grown = (after.forces - after.supports) - (before.forces - before.supports);
    EXPECT_NEAR(outcome.permanent_growth.constant, grown, load_tolerance * std::abs(after.forces));
  }
  EXPECT_EQ(events, 12);
  expect_both_fields();
}

std::vector<BodyKind> kinds() {
  std::vector<BodyKind> result;
  for (const bool driven : {false, true}) {
    for (const FactorRoute route :
         {FactorRoute::in_place, FactorRoute::cholmod_updown, FactorRoute::refactorize}) {
      result.push_back({{hexagonal, driven, false, 7}, route});
      result.push_back({{hexagonal, driven, false, 7, 0.1, true}, route});
    }
    result.push_back({{cubic, driven, false, 4}, FactorRoute::in_place});
    result.push_back({{cubic, driven, false, 4, 0.1, true}, FactorRoute::in_place});
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Blocks, PermanentLoads, testing::ValuesIn(kinds()), [](const auto& kind) {
  return to_string(kind.param.block) + "_" + std::to_string(static_cast<int>(kind.param.route));
});

}  // namespace
}  // namespace perilink
