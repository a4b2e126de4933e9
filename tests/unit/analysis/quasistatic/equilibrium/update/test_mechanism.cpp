#include "analysis/quasistatic/equilibrium/update/mechanism.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "solver/not_positive_definite.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// A body of boxes in the plane, unit spacing, bonds of two spacings, held at x = 0 and pulled
/// across at its right end.
AnalysisBody make_subdomains(std::vector<Box> solid, double right) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = 1.0;
  input.horizon = 2.0;
  input.material.assign(solid.size(), 0);
  input.solid = std::move(solid);
  AnalysisBody body = free_body(build_network(make_body(input), network_input(input)));
  const auto at = [&](Index i, double x) {
    return std::abs(body.network.particles.position(i)[0] - x) < 1e-9;
  };
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    if (at(i, right)) body.loads.forces[slot(body, i, 1)] = 1.0;
  }
  number(body, [&](Index i, int) { return at(i, 0.0); });
  return body;
}

/// Two squares that share a particle, with bonds between them only there.
AnalysisBody make_hinge(double side) {
  AnalysisBody body = make_subdomains(
      {{{0, 0, 0}, {side, side, 0}}, {{side, side, 0}, {2 * side, 2 * side, 0}}}, 2 * side);
  std::vector<std::uint8_t> keep;
  const Network& network = body.network;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto p = network.particles.position(network.bonds.first[e]);
    const auto q = network.particles.position(network.bonds.second[e]);
    const double most = std::max({p[0], p[1], q[0], q[1]});
    const double least = std::min({p[0], p[1], q[0], q[1]});
    keep.push_back(most < side + 0.5 || least > side - 0.5);
  }
  keep_elements(body.network, keep);
  return body;
}

void expect_refusal(const AnalysisBody& body, double side, const std::function<void()>& solve) {
  try {
    solve();
    FAIL() << "a mechanism was solved";
  } catch (const NotPositiveDefinite& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("can move freely, at ("), std::string::npos) << message;
    const auto unknown = std::ranges::find(body.unknowns.number, error.unknown());
    const Index particle =
        static_cast<Index>(unknown - body.unknowns.number.begin()) / body.unknowns.width;
    EXPECT_GE(body.network.particles.position(particle)[0], side);
  }
}

/// The second square turns about the particle, and round-off holds it the more the larger it is.
TEST(Mechanism, IsRefusedInsideABody) {
  for (const double side : {5.0, 10.0, 20.0, 60.0}) {
    const AnalysisBody body = make_hinge(side);
    expect_refusal(body, side, [&] { run_elastic_analysis(body); });
    for (const FactorRoute route : routes) {
      expect_refusal(body, side, [&] { Equilibrium(body, with_route(route)); });
    }
  }
}

/// Nor is a strip of one row of cells one, a thousand times as long as it is high.
TEST(Mechanism, SlenderBodiesAreNone) {
  const AnalysisBody strip = make_subdomains({{{0, 0, 0}, {1000, 1, 0}}}, 1000.0);
  EXPECT_NO_THROW(run_elastic_analysis(strip));
  EXPECT_NO_THROW(Equilibrium(strip, {}));
}

}  // namespace
}  // namespace perilink
