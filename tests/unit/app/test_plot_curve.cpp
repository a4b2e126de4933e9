#include "app/plot_curve.hpp"

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
    record.load_factor = 2.0 * std::exp(-2.0 * k / events) * (0.5 + unit(random));
    record.load = reference_load * record.load_factor;
    record.displacement = compliance * record.load_factor;
    compliance += 0.01 * unit(random);
    records.push_back(record);
  }
  return records;
}

double compliance_of(const StepRecord& record) { return record.displacement / record.load_factor; }

TEST(Envelope, DissipatesWhatTheEventsDissipate) {
  const std::vector<StepRecord> records = make_path(1001);
  const std::size_t window = 37;  // does not divide the number of events
  const std::vector<CurvePoint> curve = smooth_envelope(records, window);
  double of_events = 0.0;
  for (std::size_t k = 0; k + 1 < records.size(); ++k) {
    of_events += 0.5 * std::pow(records[k].load_factor, 2) *
                 (compliance_of(records[k + 1]) - compliance_of(records[k]));
  }
  double of_envelope = 0.0;
  for (std::size_t w = 0; w < curve.size(); ++w) {
    const std::size_t end = std::min((w + 1) * window, records.size() - 1);
    const double factor = curve[w].load / reference_load;
    of_envelope +=
        0.5 * factor * factor * (compliance_of(records[end]) - compliance_of(records[w * window]));
  }
  EXPECT_NEAR(of_envelope, of_events, 1e-12 * of_events);  // equal in exact arithmetic
}

TEST(Envelope, PointsLieOnTheMiddleComplianceOfTheirWindow) {
  const std::vector<StepRecord> records = make_path(21);
  const std::vector<CurvePoint> curve = smooth_envelope(records, 10);
  ASSERT_EQ(curve.size(), 2u);
  const double middle = 0.5 * (compliance_of(records[10]) + compliance_of(records[20]));
  EXPECT_NEAR(curve[1].displacement / (curve[1].load / reference_load), middle, 1e-12);
}

TEST(Envelope, OfAConstantLoadIsThatLoad) {
  std::vector<StepRecord> records = make_path(101);
  for (StepRecord& record : records) {
    record.displacement /= -record.load_factor;
    record.load_factor = -1.0;  // compression
    record.load = -reference_load;
  }
  for (const CurvePoint& point : smooth_envelope(records, 10)) {
    EXPECT_NEAR(point.load, -reference_load, 1e-12);
    EXPECT_LT(point.displacement, 0.0);
  }
}

TEST(Envelope, TakesMeansWhereTheComplianceDoesNotGrow) {
  std::vector<StepRecord> records(3);
  records[1].load = 2.0;  // load factors are zero
  const std::vector<CurvePoint> curve = smooth_envelope(records, 10);
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(curve[0].load, 1.0);
  EXPECT_TRUE(smooth_envelope({}, 10).empty());
}

TEST(LoadDisplacement, MarksThePeak) {
  std::vector<StepRecord> records = make_path(50);
  records[20].load = -99.5;
  EXPECT_EQ(peak_row(records), 20u);
  const std::string svg = draw_load_displacement(records, {"Beam", "kip", "in"}).str();
  EXPECT_NE(svg.find("peak −99.5 kip"), std::string::npos);
  EXPECT_NE(svg.find("load (kip)"), std::string::npos);
  EXPECT_EQ(svg.find("envelope"), std::string::npos);
}

TEST(LoadDisplacement, ManyEventsGetAnEnvelopeAndASmallFile) {
  const std::string svg = draw_load_displacement(make_path(100000), {}).str();
  EXPECT_NE(svg.find("envelope"), std::string::npos);
  EXPECT_LT(svg.size(), 2'000'000u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

/// Triangular path of 400 rows from nothing over a peak at `middle` to nothing.
std::vector<StepRecord> tent(double middle) {
  std::vector<StepRecord> records(400);
  for (int k = 0; k < 400; ++k) {
    const double x = (k + 1) / 400.0;
    records[k].displacement = x;
    records[k].load = x < middle ? x / middle : (1.0 - x) / (1.0 - middle);
    records[k].load_factor = records[k].load;
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
    const pugi::xml_node peak = text("peak"), legend = text("envelope");
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

/// Rows in time vibrate; no envelope of events has a meaning for them.
TEST(LoadDisplacement, HistoriesInTimeHaveNoEnvelope) {
  const std::vector<StepRecord> records = make_path(1000);
  EXPECT_NE(draw_load_displacement(records, {}).str().find("envelope"), std::string::npos);
  const std::string svg = draw_load_displacement(records, {}, HistoryPath::time).str();
  EXPECT_EQ(svg.find("envelope"), std::string::npos);
  EXPECT_NE(svg.find("peak"), std::string::npos);
}

}  // namespace
}  // namespace perilink
