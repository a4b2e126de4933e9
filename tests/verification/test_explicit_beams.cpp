// The study of the same name as a test, on short beams.

#include <gtest/gtest.h>

#include "comparison.hpp"

namespace perilink::verification {
namespace {

constexpr Sizes short_beam{24, 4, 3};

/// The explicit mode reaches the implicit equilibrium, to its tolerance.
TEST(ExplicitBeams, ComeToRestWhereTheImplicitModeIs) {
  for (const char* joined : {"none", "calibrated", "fibres"}) {
    const Specimen specimen = make_specimen(Structure::cantilever, short_beam, joined);
    const Solution implicit = solve(specimen);
    const Solution small = relax(specimen, Strain::small, 1e-7, 1);
    ASSERT_EQ(small.termination, Termination::completed);
    EXPECT_LT(largest_difference(small, implicit), 4e-7) << joined;
    // The beam turns by less than a thousandth.
    const Solution green = relax(specimen, Strain::green, 1e-7, 1);
    ASSERT_EQ(green.termination, Termination::completed);
    EXPECT_NEAR(green.deflection / implicit.deflection, 1.0, 1e-3) << joined;
  }
}

/// Calibrated bonds bend as beams do; equal fibres do not, whatever their normalised shape.
TEST(ExplicitBeams, CalibratedBondsHaveTheDeflectionOfTheBeam) {
  const double reference = timoshenko(Structure::cantilever, short_beam, short_beam.x());
  const Specimen calibrated = make_specimen(Structure::cantilever, short_beam, "calibrated");
  // 1.1 % in the study, of ten cells in height.
  EXPECT_NEAR(solve(calibrated).deflection / reference, 1.0, 0.1);
  const Specimen fibres = make_specimen(Structure::cantilever, short_beam, "fibres");
  const Solution soft = solve(fibres);
  EXPECT_GT(soft.deflection / reference, 1.5);
  EXPECT_LT(normalized_shape_error(fibres, soft), 0.1);
}

}  // namespace
}  // namespace perilink::verification
