#include "app/plot_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string>

#include "support/cracked_field.hpp"

namespace perilink {
namespace {

using test::CrackedPlate;

std::string draw(const CrackedPlate& plate, bool ghosts_and_bar, double scale = 0.0) {
  const PlotBody body = read_body(test::make_cracked_field(plate, ghosts_and_bar), "");
  return draw_fields(body, {4, 0.4127, 12.345}, {"Plate", "kip", "in"}, scale).str();
}

TEST(PlotFields, ShowsCracksBarsAndGhosts) {
  const std::string svg = draw({}, true);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  for (const char* text : {"4 broken bonds", "load 12.35 kip", "crack face", "reinforcing bar",
                           "ghost", "displacements × 5000"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(PlotFields, TakesTheScaleThatIsGiven) {
  EXPECT_NE(draw({}, false, 30.0).find("displacements × 30<"), std::string::npos);
}

TEST(PlotFields, DrawsEachFaceOnBothSidesOfTheCrack) {
  // Four broken bonds between neighbours: eight faces, a move and a line each.
  const std::string svg = draw({}, false);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  const pugi::xml_node faces =
      document.child("svg").child("g").find_child_by_attribute("path", "stroke", "#5a0a12");
  const std::string data = faces.attribute("d").as_string();
  EXPECT_EQ(std::count(data.begin(), data.end(), 'l'), 8);
}

TEST(PlotFields, LargeBodiesStayBelowFiveMegabytes) {
  EXPECT_LT(draw({.nx = 450, .ny = 300, .hexagonal = true, .spacing = 0.1}, false).size(),
            5'000'000u);
  EXPECT_LT(draw({.nx = 450, .ny = 300, .spacing = 0.1}, false).size(), 5'000'000u);
}

TEST(PlotFields, ThreeDimensionsLeaveHiddenParticlesOut) {
  const std::string svg = draw({.nx = 12, .ny = 10, .nz = 10}, false);
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = svg.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  const std::size_t balls = count("h0\"");
  EXPECT_GT(balls, 2 * 300u);  // two dots a ball; the three visible sides have about 300 particles
  EXPECT_LT(balls, 2 * 1000u);
}

}  // namespace
}  // namespace perilink
