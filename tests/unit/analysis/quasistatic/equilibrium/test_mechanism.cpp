#include "analysis/quasistatic/equilibrium/mechanism.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
AnalysisBody make_boxes(std::vector<Box> solid, double right) {
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

/// Two squares that share a particle at (5, 5), and bonds beyond it only where they end there.
AnalysisBody make_hinge() {
  return make_boxes({{{0, 0, 0}, {5, 5, 0}}, {{5, 5, 0}, {10, 10, 0}}}, 10.0);
}

/// The second square turns about the particle: round-off must not hold it.
TEST(Mechanism, IsRefusedInsideABody) {
  AnalysisBody body = make_hinge();
  // Bonds across the gap beside the particle are taken away.
  std::vector<std::uint8_t> keep;
  const Network& network = body.network;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto p = network.particles.position(network.bonds.first[e]);
    const auto q = network.particles.position(network.bonds.second[e]);
    const double most = std::max({p[0], p[1], q[0], q[1]});
    const double least = std::min({p[0], p[1], q[0], q[1]});
    keep.push_back(most < 5.5 || least > 4.5);
  }
  keep_elements(body.network, keep);
  for (const bool damage : {false, true}) {
    try {
      if (damage) {
        Equilibrium equilibrium(body, {});
      } else {
        run_elastic_analysis(body);
      }
      FAIL() << "a mechanism was solved";
    } catch (const NotPositiveDefinite& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("can move freely, at ("), std::string::npos) << message;
      const auto unknown = std::ranges::find(body.unknowns.number, error.unknown());
      const Index particle =
          static_cast<Index>(unknown - body.unknowns.number.begin()) / body.unknowns.width;
      EXPECT_GT(body.network.particles.position(particle)[0], 5.0);
    }
  }
}

/// A strip of one row of cells: its softest pivot is far above that of a mechanism.
TEST(Mechanism, SlenderBodiesAreNone) {
  const AnalysisBody strip = make_boxes({{{0, 0, 0}, {1000, 1, 0}}}, 1000.0);
  const ElasticResult result = run_elastic_analysis(strip);
  EXPECT_GT(result.factor.softest.ratio, 1e-11);
  EXPECT_LT(result.factor.softest.ratio, 1e-3);
}

}  // namespace
}  // namespace perilink
