#include "app/plot/plot_page.hpp"

#include <gtest/gtest.h>

#include "support/cracked_field.hpp"

namespace perilink {
namespace {

TEST(BodyPage, HoldsTheWholeBodyUndistorted) {
  for (const auto& [nx, ny] : {std::pair{25, 8}, std::pair{8, 25}, std::pair{2, 60}}) {
    const PlotBody body = read_body(test::make_cracked_field({.nx = nx, .ny = ny}, false), "");
    const BodyPage page = make_page(body, body.positions);
    for (const Vector3& point : body.positions) {
      const SvgPoint at = page.at(point);
      EXPECT_GE(at.x, page.left);
      EXPECT_LE(at.x, page.right);
      EXPECT_GE(at.y, page.top);
      EXPECT_LE(at.y, page.bottom);
    }
    const SvgPoint corner = page.at({0, 0, 0});
    const SvgPoint opposite = page.at({2, 2, 0});
    EXPECT_NEAR(opposite.x - corner.x, corner.y - opposite.y, 1e-9);
    EXPECT_LE(page.width, 1000.0);
    EXPECT_LE(page.height, 850.0);
  }
}

TEST(BodyPage, EmptyBodyIsAnEmptyPage) {
  const BodyPage page = make_page(PlotBody{}, {});
  EXPECT_GT(page.width, 0.0);
  EXPECT_LT(page.width, 2000.0);
}

TEST(BodyPage, FrameNamesAxesUnitsAndKey) {
  const PlotBody body = read_body(test::make_cracked_field({}, false), "");
  const BodyPage page = make_page(body, body.positions);
  Svg svg(page.width, page.height);
  draw_page(svg, page, 2, {"Plate", "kip", "in"}, "4 broken bonds", {},
            {{"crack face", "stroke=\"#000\""}, {"ghost", "stroke=\"#999\"", true}});
  for (const char* text : {"Plate", "4 broken bonds", ">x (in)<", ">y (in)<", ">10 in<", "damage<",
                           "crack face", "ghost"}) {
    EXPECT_NE(svg.str().find(text), std::string::npos) << text;
  }
}

TEST(BodyPage, FrameShowsTheAxesOfSpace) {
  const BodyPage page = make_page(PlotBody{}, {});
  Svg svg(page.width, page.height);
  draw_page(svg, page, 3, {}, "", {}, {});
  for (const char* axis : {">x<", ">y<", ">z<"}) {
    EXPECT_NE(svg.str().find(axis), std::string::npos) << axis;
  }
}

}  // namespace
}  // namespace perilink
