#include "app/compare/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Rows on lines from the origin over (1, load) to (2, 0), and a body of four particles.
RunResult result_of(const std::string& name, double load) {
  RunResult result;
  result.directory = "results/" + name;
  result.name = name;
  result.labels = {"Bar, " + name, "kN", "m"};
  result.units = "kN, m";
  result.status = "completed";
  for (const auto& [u, p] : {std::pair(0.25, 0.25 * load), std::pair(1.0, load), {2.0, 0.0}}) {
    StepRecord record;
    record.displacement = u;
    record.load = p;
    result.records.push_back(record);
  }
  result.last_row = {{"step", 3.0}, {"dissipated_energy", load}, {"broken_bonds", 5.0}};
  result.summary = {{"steps", 3.0}, {"particles", 4.0}, {"seconds.analysis", 0.5}};
  result.body = CrackPattern{
      2, {0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 3.0, 0.0}, {1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 0.0, 0.0}};
  result.horizon = 1.5;
  return result;
}

const ComparedQuantity& quantity(const Comparison& comparison, const std::string& name) {
  const auto found = std::find_if(comparison.quantities.begin(), comparison.quantities.end(),
                                  [&](const ComparedQuantity& q) { return q.name == name; });
  if (found == comparison.quantities.end()) throw std::out_of_range(name);
  return *found;
}

TEST(Comparison, PutsBothSideBySide) {
  const Comparison found = compare_results(result_of("one", 4.0), result_of("two", 5.0));
  EXPECT_EQ(quantity(found, "peak_load").a, 4.0);
  EXPECT_EQ(quantity(found, "peak_load").b, 5.0);
  EXPECT_EQ(quantity(found, "peak_load").unit, "kN");
  EXPECT_EQ(quantity(found, "peak_load").difference_percent(), 25.0);
  // The only row before the peak with at most a third of its load has the slope of the line.
  EXPECT_EQ(quantity(found, "initial_stiffness").b, 5.0);
  EXPECT_EQ(quantity(found, "initial_stiffness").unit, "kN/m");
  EXPECT_NEAR(quantity(found, "load_distance").between, 25.0, 1e-12);
  EXPECT_NEAR(quantity(found, "work_in_common_range").a, 4.0, 1e-14) << "a triangle";
  EXPECT_EQ(quantity(found, "dissipated_energy").unit, "kN m");
  EXPECT_EQ(quantity(found, "cracked_volume").a, 2.0);
  EXPECT_EQ(quantity(found, "crack_overlap").between, 100.0);
  EXPECT_EQ(quantity(found, "broken_bonds").a, 5.0) << "of the history: the summary lacks it";
  EXPECT_EQ(quantity(found, "rows").b, 3.0);
  EXPECT_EQ(quantity(found, "seconds.analysis").unit, "s");
  EXPECT_EQ(quantity(found, "steps").a, 3.0);
  EXPECT_TRUE(found.notes.empty());
}

TEST(Comparison, TakesQuantitiesThatOnlyOneHas) {
  RunResult a = result_of("static", 4.0), b = result_of("dynamic", 4.0);
  b.last_row.emplace_back("kinetic_energy", 0.125);
  b.summary.emplace_back("time_step", 1e-7);
  b.body.reset();
  a.summary.emplace_back("initial_stiffness", 3.5);
  const Comparison found = compare_results(a, b);
  EXPECT_TRUE(std::isnan(quantity(found, "kinetic_energy").a));
  EXPECT_EQ(quantity(found, "kinetic_energy").b, 0.125);
  EXPECT_EQ(quantity(found, "time_step").b, 1e-7);
  EXPECT_EQ(quantity(found, "initial_stiffness").a, 3.5);
  EXPECT_TRUE(std::isnan(quantity(found, "crack_overlap").between));
  const std::string report = comparison_report(a, b, found);
  EXPECT_THAT(report, testing::ContainsRegex("kinetic energy \\(kN m\\) +- +0.125 +-\n"));
  EXPECT_THAT(report, testing::ContainsRegex("crack overlap +- +- +-\n"));
  EXPECT_THAT(comparison_csv(a, b, found), HasSubstr("\nkinetic_energy,kN m,,0.125,,\n"));
}

TEST(Comparison, ComparesGaugesAtThePeakAndAtTheEnd) {
  RunResult a = result_of("one", 4.0), b = result_of("two", 5.0);
  a.gauges = {{"tip", 2.0}, {"other", 1.0}};
  a.gauges_at_peak = {{"tip", 1.0}, {"other", 0.5}};
  b.gauges = {{"tip", 3.0}};
  b.gauges_at_peak = {{"tip", 1.5}};
  const Comparison found = compare_results(a, b);
  EXPECT_EQ(quantity(found, "gauge.tip.at_peak_load").difference_percent(), 50.0);
  EXPECT_EQ(quantity(found, "gauge.tip.at_end").b, 3.0);
  EXPECT_EQ(quantity(found, "gauge.other.at_end").a, 1.0);
  EXPECT_TRUE(std::isnan(quantity(found, "gauge.other.at_end").b));
  a.records.resize(1);
  b.records.resize(1);
  const Comparison elastic = compare_results(a, b);
  EXPECT_EQ(quantity(elastic, "gauge.tip.at_end").a, 2.0);
  EXPECT_THROW(quantity(elastic, "gauge.tip.at_peak_load"), std::out_of_range);
}

TEST(Comparison, DifferentUnitsAreNoted) {
  RunResult a = result_of("one", 4.0), b = result_of("two", 4.0);
  b.units = "N, mm";
  const Comparison found = compare_results(a, b);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_THAT(found.notes[0], HasSubstr("\"kN, m\" and \"N, mm\""));
  EXPECT_EQ(quantity(found, "peak_load").unit, "");
}

TEST(Comparison, BodiesOfDifferentDimensionHaveNoCracksInCommon) {
  RunResult a = result_of("plane", 4.0), b = result_of("solid", 4.0);
  b.body = CrackPattern{3, {0.0, 0.0, 0.0}, {1.0}, {1.0}};
  const Comparison found = compare_results(a, b);
  EXPECT_TRUE(std::isnan(quantity(found, "cracked_volume").a));
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_THAT(found.notes[0], HasSubstr("cracks are not compared"));
}

TEST(Comparison, TheReportNamesResultsAndNotes) {
  RunResult a = result_of("one", 4.0), b = result_of("two", 3.0);
  b.notes = {"interrupted (a signal came)"};
  const Comparison found = compare_results(a, b);
  const std::string report = comparison_report(a, b, found);
  EXPECT_THAT(report, HasSubstr("A  results/one: Bar, one (completed)\n"));
  EXPECT_THAT(report, HasSubstr("note: B: interrupted (a signal came)\n"));
  EXPECT_THAT(report, testing::ContainsRegex("peak load \\(kN\\) +4 +3 +-25.00 %\n"));
  EXPECT_THAT(report, testing::ContainsRegex("seconds analysis \\(s\\) +0.5 +0.5 +0 %\n"));
  EXPECT_THAT(report, testing::ContainsRegex("load distance +25.00 %\n"));
  EXPECT_THAT(report, Not(HasSubstr("nan")));
}

TEST(Comparison, TheTableQuotesTexts) {
  const RunResult a = result_of("one", 4.0), b = result_of("two", 3.0);
  const std::string table = comparison_csv(a, b, compare_results(a, b));
  EXPECT_TRUE(
      table.starts_with("quantity,unit,a,b,difference_percent,between\n"
                        "directory,,results/one,results/two,,\n"
                        "title,,\"Bar, one\",\"Bar, two\",,\n"
                        "status,,completed,completed,,\n"
                        "peak_load,kN,4,3,-25,\n"))
      << table;
}

TEST(Comparison, DifferencesAreRelativeToTheFirst) {
  EXPECT_EQ((ComparedQuantity{"", "", -4.0, -5.0}).difference_percent(), -25.0);
  EXPECT_EQ((ComparedQuantity{"", "", 0.0, 0.0}).difference_percent(), 0.0);
  EXPECT_TRUE(std::isnan((ComparedQuantity{"", "", 0.0, 1.0}).difference_percent()));
  EXPECT_TRUE(std::isnan((ComparedQuantity{"", "", -1e-12, 1.0}).difference_percent()));
  EXPECT_NEAR((ComparedQuantity{"", "", 1e-6, 1.0}).difference_percent(), 99999900.0, 1e-6);
  EXPECT_TRUE(std::isnan((ComparedQuantity{"", ""}).difference_percent()));
}

}  // namespace
}  // namespace perilink
