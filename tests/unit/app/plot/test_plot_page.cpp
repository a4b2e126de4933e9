#include "app/plot/plot_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>

#include "support/cracked_field.hpp"

namespace perilink {
namespace {

TEST(BodyPage, HoldsTheWholeBodyUndistorted) {
  for (const auto& [nx, ny] : {std::pair{25, 8}, std::pair{8, 25}, std::pair{2, 60}}) {
    const PlotBody body = read_body(test::make_cracked_field({.nx = nx, .ny = ny}, false), "");
    const BodyPage page = make_page(view_of(body, body.positions));
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
  const BodyPage page = make_page(view_of(PlotBody{}, {}));
  EXPECT_GT(page.width, 0.0);
  EXPECT_LT(page.width, 2000.0);
}

TEST(BodyPage, FrameNamesAxesUnitsAndKey) {
  const PlotBody body = read_body(test::make_cracked_field({}, false), "");
  const BodyPage page = make_page(view_of(body, body.positions));
  Svg svg(page.width, page.height);
  draw_page(svg, page, 2, {"Plate", "kip", "in"}, "4 broken bonds", {},
            {{"crack face", "stroke=\"#000\""}, {"ghost", "stroke=\"#999\"", true}});
  for (const char* text : {"Plate", "4 broken bonds", ">x (in)<", ">y (in)<", ">10 in<", "damage<",
                           "crack face", "ghost"}) {
    EXPECT_NE(svg.str().find(text), std::string::npos) << text;
  }
}

TEST(BodyPage, ShowsSupportsAndLoads) {
  PlotBody body = read_body(test::make_cracked_field({}, false), "");
  const std::vector<std::uint8_t> visible(body.positions.size(), 1);
  const auto drawn = [&] {
    const BodyPage page = make_page(view_of(body, body.positions));
    Svg svg(page.width, page.height);
    std::vector<std::string> names;
    for (const KeyEntry& entry : draw_conditions(svg, page, body, body.positions, visible)) {
      names.push_back(entry.name);
    }
    return std::pair(names, svg.str());
  };
  EXPECT_TRUE(drawn().first.empty());
  const double narrow = make_page(view_of(body, body.positions)).pixels;
  body.held.assign(body.positions.size(), 0);
  body.held[0] = 2;
  body.forces.assign(body.positions.size(), Vector3{0.0, -1.0, 0.0});
  body.moves.assign(body.positions.size(), Vector3{});
  body.moves[3] = {1.0, 0.0, 0.0};
  const auto [names, svg] = drawn();
  EXPECT_EQ(names, (std::vector<std::string>{"held", "load", "prescribed displacement"}));
  EXPECT_LT(make_page(view_of(body, body.positions)).pixels, narrow) << "arrows have room";
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  std::vector<std::string> paths;
  for (const pugi::xml_node path : document.child("svg").children("path")) {
    paths.emplace_back(path.attribute("d").as_string());
  }
  ASSERT_EQ(paths.size(), 3u);
  EXPECT_NE(paths[0].find("l0-"), std::string::npos) << "a line along y: " << paths[0];
  const auto lines = std::ranges::count(paths[1], 'l');
  EXPECT_EQ(lines % 3, 0) << "three lines an arrow";
  EXPECT_GT(lines, 3 * 10);
  EXPECT_LE(lines, 3 * 60);
  EXPECT_EQ(std::ranges::count(paths[2], 'l'), 3);
}

TEST(BodyPage, FrameShowsTheAxesOfSpace) {
  const BodyPage page = make_page(view_of(PlotBody{}, {}));
  Svg svg(page.width, page.height);
  draw_page(svg, page, 3, {}, "", {}, {});
  for (const char* axis : {">x<", ">y<", ">z<"}) {
    EXPECT_NE(svg.str().find(axis), std::string::npos) << axis;
  }
}

}  // namespace
}  // namespace perilink
