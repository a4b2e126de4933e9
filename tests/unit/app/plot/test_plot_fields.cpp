#include "app/plot/plot_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

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

TEST(PlotFields, BarsAreColouredByTheirStress) {
  VtuGrid grid = test::make_cracked_field({}, true);
  std::vector<double> stress(grid.types.size(), 340.0);
  const std::vector<double>& element = grid.cell_data[0].values;
  const auto last = std::find(element.rbegin(), element.rend(), 2.0);  // the last segment
  stress[static_cast<std::size_t>(element.rend() - last) - 1] = -12.0;
  grid.cell_data.push_back({"axial_stress", 1, stress});
  PlotBody body = read_body(grid, "");
  EXPECT_EQ(body.bar_stress.size(), body.segments.size());
  EXPECT_EQ(body.bar_stress.back(), -12.0);
  const std::string svg = draw_fields(body, {4, 0.4, 12.3}, {"Plate", "kip", "in"}, 0.0).str();
  EXPECT_NE(svg.find("bar, stress to 340"), std::string::npos);
  EXPECT_NE(svg.find("bar, stress to −12"), std::string::npos);
  EXPECT_EQ(svg.find("reinforcing bar"), std::string::npos);
}

TEST(PlotFields, ElasticBodiesAreColouredByStress) {
  VtuGrid grid = test::make_cracked_field({.nx = 4, .ny = 1}, false);
  std::vector<double> stress(4 * 6, 0.0);
  for (int i = 0; i < 4; ++i) stress[6 * i] = 10.0 * i;
  grid.point_data.push_back({"stress", 6, stress});
  const std::string svg =
      draw_fields(read_body(grid, ""), {0, 1.0, 12.345}, {"Bar", "kip", "in"}, 1.0).str();
  EXPECT_NE(svg.find("von Mises stress (kip/in²)"), std::string::npos);
  EXPECT_NE(svg.find(">30<"), std::string::npos) << "the bar ends at the largest stress";
  EXPECT_EQ(svg.find("damage"), std::string::npos);
  EXPECT_EQ(svg.find("broken bonds"), std::string::npos);
  EXPECT_EQ(svg.find("#d8dade"), std::string::npos) << "the grey of undamaged particles";
  std::fill(stress.begin(), stress.end(), 0.0);
  grid.point_data.back().values = stress;
  EXPECT_EQ(draw_fields(read_body(grid, ""), {0, 1.0, 0.0}, {}, 1.0).str().find("nan"),
            std::string::npos);
}

TEST(PlotFields, ExplicitAnalysesTellTheTimeAndNoBonds) {
  const FieldsCaption caption{0, 0.5, 12.345, 0.25};
  const std::string svg = draw_fields(read_body(test::make_cracked_field({}, false), ""), caption,
                                      {"Bar", "kip", "in"}, 1.0)
                              .str();
  EXPECT_NE(svg.find("time 0.25 · load factor 0.5 · load 12.35 kip"), std::string::npos);
  EXPECT_EQ(svg.find("broken bonds"), std::string::npos);
  EXPECT_NE(svg.find(">broken bond<"), std::string::npos) << "of the hairlines";
}

TEST(PlotFields, DotsAreAsWideAsTheirParticles) {
  VtuGrid grid = test::make_cracked_field({.nx = 4, .ny = 4, .hexagonal = true}, false);
  std::vector<double> volumes(16, std::sqrt(0.75) * 4.0);
  volumes[5] *= 0.25;
  grid.point_data.push_back({"volume", 1, volumes});
  const std::string svg = draw_fields(read_body(grid, ""), {4, 1.0, 1.0}, {}, 1.0).str();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  std::set<double> widths;
  for (const pugi::xpath_node dots :
       document.select_nodes("//g[@stroke-linecap='round']/path[@stroke-width]")) {
    widths.insert(dots.node().attribute("stroke-width").as_double());
  }
  ASSERT_EQ(widths.size(), 2u);
  // Widths are rounded to a quarter of a pixel.
  EXPECT_NEAR(*widths.rbegin(), 2.0 * *widths.begin(), 0.5);
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

TEST(PlotFields, CrackFacesAreColouredByTheirOpening) {
  VtuGrid grid = test::make_cracked_field({}, false);
  std::vector<double> opening(grid.types.size(), 0.0);
  const std::vector<double>& element = grid.cell_data[0].values;
  const auto first = std::find(element.begin(), element.end(), 1.0) - element.begin();
  opening[static_cast<std::size_t>(first)] = 0.25;
  grid.cell_data.push_back({"crack_opening", 1, opening});
  const std::string svg = draw_fields(read_body(grid, ""), {}, {"", "kip", "in"}, 0.0).str();
  EXPECT_NE(svg.find("#128cff"), std::string::npos) << "the widest";
  EXPECT_NE(svg.find("#5a0a12"), std::string::npos) << "those that are closed";
  for (const char* name : {">crack face: closed<", ">open by 0.25 in (largest)<"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }
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
