#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "compare.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "problems/block.hpp"
#include "support/softening_strips.hpp"

namespace perilink::verification {
namespace {

class ExactEvents : public testing::TestWithParam<std::string> {};

/// The study's claim at its smallest size, 5 000 unknowns, or at some 3 000: every event until
/// collapse.
TEST_P(ExactEvents, BreakTheBondsThatAFreshFactorBreaks) {
  const int columns = GetParam() == "none" ? 22 : columns_5k;
  const Agreement a =
      compare_routes(make_block(columns, GetParam()), FactorRoute::refactorize, 1000, 1000);

  EXPECT_EQ(a.termination, "collapsed");
  EXPECT_GT(a.compared, 500);
  EXPECT_EQ(a.mismatches, 0);
  EXPECT_LT(a.load_factor_difference, 1e-9);
  EXPECT_LT(a.energy_error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Surface, ExactEvents, testing::Values("calibrated", "none"),
                         [](const auto& test) { return test.param; });

struct Notched {
  const char* model;
  const char* curve;
};

std::ostream& operator<<(std::ostream& out, const Notched& body) {
  return out << body.model << "_" << body.curve;
}

class ExactSoftening : public testing::TestWithParam<Notched> {};

/// A strip of 60 by 30 with a notch at one side of its middle, whose bonds lose their stiffness in
/// eight steps or so: every event until the strip is in two.
TEST_P(ExactSoftening, TakesTheBondsThatAFreshFactorTakes) {
  test::SofteningStrip strip;
  strip.model = GetParam().model;
  strip.softening = std::string("softening_error = 0.1\nsoftening = \"") + GetParam().curve + "\"";
  strip.length = 60.0;
  strip.width = 30.0;
  strip.fracture_energy = 0.05;
  strip.more = "[[cracks]]\npoints = [[32.5, -1], [32.5, 11]]";
  const Model model = build_model(parse_case(test::softening_case(strip), "strip"));
  const Index all = model.network.num_elements();
  const Agreement a = compare_routes(model, FactorRoute::refactorize, all, all);

  EXPECT_EQ(a.termination, "collapsed");
  EXPECT_GT(a.compared, 500);
  EXPECT_EQ(a.mismatches, 0);
  EXPECT_LT(a.load_factor_difference, 1e-9);
  EXPECT_LT(a.energy_error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Curves, ExactSoftening,
                         testing::Values(Notched{"bond_based", "linear"},
                                         Notched{"bond_based", "exponential"},
                                         Notched{"micropolar", "bilinear"}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace perilink::verification
