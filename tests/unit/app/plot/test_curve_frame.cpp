#include "app/plot/curve_frame.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace perilink {
namespace {

TEST(CurveFrame, HoldsAllPointsAndTheOrigin) {
  const std::vector<CurvePoint> points = {{-3.0, 40.0}, {5.0, 20.0}};
  const CurveFrame frame = make_curve_frame(points, 92.0);
  for (const CurvePoint point : {CurvePoint{}, points[0], points[1]}) {
    const SvgPoint at = frame.at(point);
    EXPECT_GE(at.x, 92.0);
    EXPECT_LE(at.x, curve_figure_width);
    EXPECT_GE(at.y, 92.0);
    EXPECT_LE(at.y, curve_figure_height);
  }
  EXPECT_LT(frame.at(points[0]).y, frame.at(points[1]).y) << "loads point upwards";
}

TEST(CurveFrame, PointsOfOnePixelAreOne) {
  std::vector<CurvePoint> points;
  for (int k = 1; k <= 100000; ++k) points.push_back({1e-5 * k, 1e-5 * k});
  const CurveFrame frame = make_curve_frame(points, 62.0);
  const std::string path = curve_path(frame, points).data();
  // A step takes about ten letters, and the line is under 900 px long.
  EXPECT_LT(path.size(), 10.0 * 900.0 / 0.3);
  EXPECT_GT(path.size(), 100u);
}

}  // namespace
}  // namespace perilink
