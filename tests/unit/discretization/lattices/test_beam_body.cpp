#include "discretization/lattices/beam_body.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace perilink {
namespace {

Box part(double from, double to, double lower, double upper) {
  return {{from, lower, 0.0}, {to, upper, 0.0}};
}

/// Boxes of materials 0, 1, ..., the wanted spacing 1 and a width of 2.
LatticeInput beam_input(std::vector<Box> boxes) {
  LatticeInput input;
  input.spacing = 1.0;
  input.thickness = 2.0;
  for (std::size_t b = 0; b < boxes.size(); ++b) input.material.push_back(static_cast<Index>(b));
  input.solid = std::move(boxes);
  return input;
}

TEST(BeamBody, StandsEvenlyAlongTheMiddlesOfItsSpans) {
  const Body body = make_beam_body(beam_input({part(0, 3.4, -1, 3), part(3.4, 4, 0, 2)}));
  ASSERT_EQ(body.particles.size(), 6);
  const double x[] = {0, 0.85, 1.7, 2.55, 3.4, 4};
  for (Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(body.particles.position(i)[0], x[i], 1e-15);
    EXPECT_EQ(body.particles.position(i)[1], 1.0);
  }
  ASSERT_EQ(body.spans.size(), 2u);
  EXPECT_EQ(body.spans[0].last, 4);
  EXPECT_EQ(body.spans[1].first, 4);
  EXPECT_EQ(body.spans[1].material, 1);
  EXPECT_EQ(body.spans[0].height, 4.0);
  EXPECT_EQ(body.spans[1].height, 2.0);
  const auto& volumes = body.particles.volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), 2 * (3.4 * 4 + 0.6 * 2), 1e-13);
  EXPECT_NEAR(volumes[4], 2 * (0.425 * 4 + 0.3 * 2), 1e-14);  // half a step of either span
}

TEST(BeamBody, LaterBoxesCountAndDivideTheBeam) {
  const Body body = make_beam_body(beam_input({part(0, 9, -1, 1), part(3, 6, -1, 1)}));
  ASSERT_EQ(body.spans.size(), 3u);
  EXPECT_EQ(body.spans[0].material, 0);
  EXPECT_EQ(body.spans[1].material, 1);
  EXPECT_EQ(body.spans[2].material, 0);
}

TEST(BeamBody, HasFacesAtItsEndsAndBetweenSpans) {
  const Body body = make_beam_body(beam_input({part(0, 2, -1, 1), part(2, 4, -1, 1)}));
  ASSERT_EQ(body.facets.size(), 3);
  EXPECT_EQ(body.facets.area_vector(0)[0], -4.0);
  EXPECT_FALSE(body.facets.on_surface(1));
  EXPECT_EQ(body.facets.corners.row(1)[0], 2);
  EXPECT_TRUE(body.facets.on_surface(2));
}

TEST(BeamBody, RefusesGapsFlatRegionsAndSeveralAxes) {
  EXPECT_THROW(make_beam_body(beam_input({part(0, 2, -1, 1), part(3, 4, -1, 1)})),
               std::invalid_argument);
  EXPECT_THROW(make_beam_body(beam_input({part(0, 2, 0, 0)})), std::invalid_argument);
  EXPECT_THROW(make_beam_body(beam_input({part(0, 2, -1, 1), part(2, 4, -1, 2)})),
               std::invalid_argument);
  EXPECT_THROW(make_beam_body(beam_input({part(1, 1, -1, 1)})), std::invalid_argument);
  EXPECT_THROW(make_beam_body(beam_input({part(0, 9, -1, 1), part(3, 6, -0.5, 0.5)})),
               std::invalid_argument)
      << "layers";
}

}  // namespace
}  // namespace perilink
