#include "app/plot/plot_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>
#include <random>
#include <string>

namespace perilink {
namespace {

constexpr double reference_load = 3.0;

/// Saw-tooth path: the compliance grows at every event while the load factor jumps about.
std::vector<StepRecord> make_path(int events) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<StepRecord> records;
  double compliance = 0.5;
  for (int k = 0; k < events; ++k) {
    StepRecord record;
    record.step = k;
    record.broken_bonds = k;
    record.load_factor = 2.0 * std::exp(-2.0 * k / events) * (0.5 + unit(random));
    record.load = reference_load * record.load_factor;
    record.displacement = compliance * record.load_factor;
    record.strain_energy = 0.5 * record.load * record.displacement;
    compliance += 0.01 * unit(random);
    records.push_back(record);
  }
  return records;
}

TEST(LoadDisplacement, LeavesOutTheTailOfAFailedBody) {
  const std::vector<CurvePoint> curve = {{1.0, 50.0}, {2.0, 100.0},  {1.5, 0.5}, {2.0, 2.0},
                                         {1.9, 0.9},  {9000.0, 0.8}, {1.0, 0.0}};
  EXPECT_EQ(rows_before_tail(curve), 5u) << "a row that does not move on is no tail";
  EXPECT_EQ(rows_before_tail(std::span(curve).first(2)), 2u);
  EXPECT_EQ(rows_before_tail({}), 0u);
  std::vector<StepRecord> records(curve.size());
  for (std::size_t k = 0; k < curve.size(); ++k) {
    records[k].displacement = curve[k].displacement;
    records[k].load = curve[k].load;
  }
  const PlotLabels labels{"Beam", "kip", "in"};
  const std::string cut = draw_load_displacement(records, labels).str();
  EXPECT_NE(cut.find("2 last rows not drawn"), std::string::npos);
  EXPECT_EQ(cut.find(">8000<"), std::string::npos);
  const std::string whole = draw_load_displacement(records, labels, {}, records.size()).str();
  EXPECT_EQ(whole.find("not drawn"), std::string::npos);
  EXPECT_NE(whole.find(">8000<"), std::string::npos);
}

TEST(LoadDisplacement, LeavesOutLoadsOfFragmentsFarBehindTheFailure) {
  const CurvePoint peak{1.0, 100.0};
  const std::vector<CurvePoint> curve = {
      {0.5, 60.0}, peak, {1.5, 20.0}, {2.0, 30.0}, {16.0, 101.0}};
  EXPECT_EQ(rows_before_drift(curve, peak), 3u);
  EXPECT_EQ(rows_before_drift(std::span(curve).first(4), peak), 4u) << "no load above the peak";
  std::vector<CurvePoint> near = curve;
  near.back().displacement = 15.0;
  EXPECT_EQ(rows_before_drift(near, peak), 5u);
  EXPECT_EQ(rows_before_drift(curve, {16.0, 101.0}), 5u) << "bars: the largest load";
  EXPECT_EQ(rows_before_drift({}, peak), 0u);
}

TEST(LoadDisplacement, DrawsColumnsFromTheirFirstRow) {
  ColumnCurve curve{"x", "y", {{1.0, 2.0}, {3.0, 4.0}}, false, "a note"};
  const auto path = [&] {
    const std::string svg = draw_columns(curve, "Beam").str();
    EXPECT_NE(svg.find(">a note<"), std::string::npos);
    return svg.substr(svg.find("<path", svg.find("#0b3c6f") - 400), 300);
  };
  const std::string from_first = path();
  curve.from_origin = true;
  EXPECT_NE(path(), from_first);
}

TEST(LoadDisplacement, MarksThePeak) {
  std::vector<StepRecord> records = make_path(50);
  records[20].load = -99.5;
  EXPECT_EQ(peak_row(records), 20u);
  const std::string svg = draw_load_displacement(records, {"Beam", "kip", "in"}).str();
  EXPECT_NE(svg.find("peak −99.5 kip"), std::string::npos);
  EXPECT_NE(svg.find("load (kip)"), std::string::npos);
  EXPECT_EQ(svg.find("smoothed curve"), std::string::npos);
}

TEST(LoadDisplacement, MarksTheFirstPeakWhereTheLoadClimbedAgain) {
  std::vector<StepRecord> records = make_path(6);
  const double loads[] = {10.0, 20.0, 3.0, 12.0, 40.0, 1.0};
  for (int k = 0; k < 6; ++k) {
    records[k].load = loads[k];
    records[k].displacement = 1.0 + k + 10.0 * (k > 2);
    records[k].strain_energy = 0.5 * loads[k] * records[k].displacement;
  }
  const auto svg = [&](const std::optional<CurvePoint>& first) {
    return draw_load_displacement(records, {"Beam", "kip", "in"}, first).str();
  };
  EXPECT_NE(svg(CurvePoint{2.0, 20.0}).find(">largest load 40 kip at 15 in"), std::string::npos);
  EXPECT_NE(svg(CurvePoint{2.0, 20.0}).find(">first peak 20 kip at 2 in"), std::string::npos);
  EXPECT_EQ(svg(CurvePoint{15.0, 40.0}).find("first peak"), std::string::npos) << "the same";
  EXPECT_EQ(svg({}).find("first peak"), std::string::npos) << "unknown";
}

TEST(LoadDisplacement, ManyEventsGetAnEnvelopeAndASmallFile) {
  const std::string svg = draw_load_displacement(make_path(100000), {}).str();
  EXPECT_NE(svg.find("smoothed curve"), std::string::npos);
  EXPECT_LT(svg.size(), 2'000'000u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

/// Triangular path of 400 rows from zero over a peak at `middle` to zero.
std::vector<StepRecord> tent(double middle) {
  std::vector<StepRecord> records(400);
  for (int k = 0; k < 400; ++k) {
    const double x = (k + 1) / 400.0;
    records[k].displacement = x;
    records[k].load = x < middle ? x / middle : (1.0 - x) / (1.0 - middle);
    records[k].load_factor = records[k].load;
    records[k].broken_bonds = k;
    records[k].strain_energy = 0.5 * records[k].load * x;
  }
  return records;
}

TEST(LoadDisplacement, TheLegendLeavesTheLabelOfThePeakFree) {
  for (const double middle : {0.1, 0.3, 0.48, 0.52, 0.7, 0.9}) {
    pugi::xml_document document;
    const std::string svg = draw_load_displacement(tent(middle), {"Tent", "kip", "in"}).str();
    ASSERT_TRUE(document.load_string(svg.c_str()));
    const auto text = [&](const char* part) {
      const std::string path = "//text[contains(., '" + std::string(part) + "')]";
      return document.select_node(path.c_str()).node();
    };
    const pugi::xml_node peak = text("peak"), legend = text("smoothed curve");
    ASSERT_TRUE(peak && legend);
    const double width = 0.56 * 14.0 * static_cast<double>(std::string(peak.child_value()).size());
    const bool leftward = std::string(peak.attribute("text-anchor").value()) == "end";
    const double left = peak.attribute("x").as_double() - (leftward ? width : 0.0);
    const double x = legend.attribute("x").as_double() - 50.0;  // the sample stands before the text
    const double y = legend.attribute("y").as_double() - 18.0;
    const double at = peak.attribute("y").as_double();
    const bool apart = left + width < x || left > x + 222.0 || at < y || at - 14.0 > y + 48.0;
    EXPECT_TRUE(apart) << "peak at " << middle;
  }
}

TEST(LoadDisplacement, EmptyHistoryIsAnEmptyFrame) {
  EXPECT_NE(draw_load_displacement({}, {"Nothing", "", ""}).str().find("displacement"),
            std::string::npos);
}

/// Rows in time or of load steps are no path of events, whose area an envelope could keep.
TEST(LoadDisplacement, OtherRowsThanEventsHaveNoEnvelope) {
  std::vector<StepRecord> records = make_path(1000);
  EXPECT_NE(draw_load_displacement(records, {}).str().find("smoothed curve"), std::string::npos);
  for (StepRecord& record : records) record.broken_bonds /= 2;
  const std::string svg = draw_load_displacement(records, {}).str();
  EXPECT_EQ(svg.find("smoothed curve"), std::string::npos);
  EXPECT_NE(svg.find("peak"), std::string::npos);
}

}  // namespace
}  // namespace perilink
