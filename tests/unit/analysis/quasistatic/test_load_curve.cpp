#include "analysis/quasistatic/load_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace perilink {
namespace {

/// Rows of single events in a body whose stiffness falls at each while the load factor jumps about.
/// \param driven  displacements of 0.3 at load factor 1 are prescribed, else a load of 3
std::vector<StepRecord> make_path(int rows, bool driven) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<StepRecord> records;
  double compliance = 0.5;
  for (int k = 0; k < rows; ++k) {
    StepRecord record;
    record.step = k + 1;
    record.broken_bonds = k;
    record.load_factor = 2.0 * std::exp(-2.0 * k / rows) * (0.5 + unit(random));
    record.load = record.load_factor * (driven ? 0.3 / compliance : 3.0);
    record.displacement = record.load_factor * (driven ? 0.3 : 3.0 * compliance);
    record.strain_energy = 0.5 * record.load * record.displacement;
    compliance *= 1.0 + 0.01 * unit(random);
    records.push_back(record);
  }
  return records;
}

/// Energy that the events of a window dissipate: triangles between the origin and two rows.
double dissipated(const std::vector<StepRecord>& records, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    sum += 0.5 * (records[k].load * records[k + 1].displacement -
                  records[k + 1].load * records[k].displacement);
  }
  return sum;
}

TEST(EventPath, AreTheRowsUnderForcesOrDrivenDisplacements) {
  for (const bool driven : {false, true}) {
    const std::vector<StepRecord> records = make_path(50, driven);
    const std::vector<CurvePoint> path = event_path(records);
    ASSERT_EQ(path.size(), records.size());
    EXPECT_EQ(path[7].load, records[7].load);
    EXPECT_EQ(path[7].displacement, records[7].displacement);
  }
}

/// The path after separation is not used for stiffnesses.
TEST(EventPath, EndsBeforeARowThatResistsNothing) {
  std::vector<StepRecord> records = make_path(50, true);
  records[49].load = -1.5e-12;
  records[49].strain_energy = 0.0;
  EXPECT_EQ(event_path(records).size(), 49u);
}

TEST(EventPath, IsEmptyWhereRowsAreNoSingleEvents) {
  std::vector<StepRecord> steps = make_path(50, true);
  for (std::size_t k = 25; k < 50; ++k) steps[k].broken_bonds += 3;  // four in one load step
  EXPECT_TRUE(event_path(steps).empty());
  std::vector<StepRecord> waits = make_path(50, true);
  for (StepRecord& record : waits) record.broken_bonds = 0;
  EXPECT_TRUE(event_path(waits).empty());
  EXPECT_TRUE(event_path({}).empty());
}

/// Forces work in addition to reactions of prescribed displacements; load times displacement lacks
/// their work.
TEST(EventPath, IsEmptyWhereTheAxesMissWork) {
  std::vector<StepRecord> records = make_path(50, true);
  for (StepRecord& record : records) record.strain_energy *= 1.01;
  EXPECT_TRUE(event_path(records).empty());
}

TEST(Envelope, DissipatesWhatTheEventsDissipateInEveryWindow) {
  for (const bool driven : {false, true}) {
    const std::vector<StepRecord> records = make_path(1001, driven);
    const std::vector<CurvePoint> path = event_path(records);
    const std::vector<CurvePoint> curve = smooth_envelope(path, 37);  // 27 windows of 37 or 38
    ASSERT_EQ(curve.size(), 27u);
    for (std::size_t w = 0; w < 27; ++w) {
      const std::size_t begin = w * 1000 / 27, end = (w + 1) * 1000 / 27;
      const CurvePoint &p = path[begin], &q = path[end];
      const double energy = dissipated(records, begin, end);
      const double softer = q.displacement / q.load - p.displacement / p.load;
      const double weaker = p.load / p.displacement - q.load / q.displacement;
      // Differences of compliances lose two of sixteen digits.
      EXPECT_NEAR(0.5 * std::pow(curve[w].load, 2) * softer, energy, 1e-11 * energy);
      EXPECT_NEAR(0.5 * std::pow(curve[w].displacement, 2) * weaker, energy, 1e-11 * energy);
    }
  }
}

/// Batches of four held nine tenths of what they dissipate at the load of their row.
TEST(Envelope, DissipatesWhatBatchesDissipate) {
  std::vector<StepRecord> rows = make_path(41, false);
  double lost = 0.0, held = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].events = 4;
    rows[k].broken_bonds = static_cast<Index>(4 * k);
    rows[k].dissipated_energy = lost;
    rows[k].released_energy = held;
    if (k + 1 == rows.size()) break;
    const double line = dissipated(rows, k, k + 1);
    const double at_row = line * rows[k].load / rows[k + 1].load;
    held += 0.9 * at_row;
    lost += 0.25 * line + 0.75 * std::clamp(line, 0.9 * at_row, at_row);
  }
  for (const auto& path : {event_path(rows), stage_path(rows)}) {
    const std::vector<CurvePoint> curve = smooth_envelope(path, 40);
    ASSERT_EQ(curve.size(), 1u);
    const double softer =
        path.back().displacement / path.back().load - path.front().displacement / path.front().load;
    EXPECT_NEAR(0.5 * std::pow(curve[0].load, 2) * softer, lost, 1e-10 * lost);
  }
}

/// Under prescribed displacements and under forces the curve ends at the last row reached.
TEST(Envelope, LiesNowhereBeyondTheRowsOfItsWindow) {
  for (const bool driven : {false, true}) {
    const std::vector<CurvePoint> path = event_path(make_path(1001, driven));
    const std::vector<CurvePoint> curve = smooth_envelope(path, 10);
    ASSERT_EQ(curve.size(), 100u);
    for (std::size_t w = 0; w < curve.size(); ++w) {
      CurvePoint highest;
      for (std::size_t k = 10 * w; k <= 10 * w + 10; ++k) {
        highest.load = std::max(highest.load, path[k].load);
        highest.displacement = std::max(highest.displacement, path[k].displacement);
      }
      EXPECT_LE(curve[w].load, highest.load);
      EXPECT_LE(curve[w].displacement, highest.displacement);
      EXPECT_GT(curve[w].load, 0.0);
    }
  }
}

/// Displacement over load factor is equal in all rows of a displacement-controlled body up to its
/// last digit.
TEST(Envelope, MakesNoPointOfRoundOff) {
  std::vector<CurvePoint> path;
  for (int k = 0; k < 400; ++k) {
    const double factor = 0.1 + 0.9 * std::abs(std::sin(1.7 * k));
    path.push_back({factor * 0.3, factor * 0.3 * 70.0});
  }
  EXPECT_TRUE(smooth_envelope(path, 10).empty());
  EXPECT_TRUE(smooth_envelope({}, 10).empty());
  EXPECT_TRUE(smooth_envelope(std::vector<CurvePoint>{{1.0, 2.0}}, 10).empty());
}

TEST(Envelope, OfAConstantLoadIsThatLoad) {
  std::vector<CurvePoint> path;
  for (int k = 0; k <= 100; ++k) path.push_back({-1.0 - k, -3.0});  // compression
  const std::vector<CurvePoint> curve = smooth_envelope(path, 10);
  ASSERT_EQ(curve.size(), 10u);
  for (const CurvePoint& point : curve) {
    EXPECT_NEAR(point.load, -3.0, 1e-14);
    EXPECT_LT(point.displacement, 0.0);
  }
  EXPECT_NEAR(smoothed_peak(path).value(), -3.0, 1e-14);
}

/// Loads of a body that gets ever softer: 100 events at each.
std::vector<CurvePoint> path_at(const std::vector<double>& loads) {
  std::vector<CurvePoint> path;
  double compliance = 1.0;
  for (const double load : loads) {
    for (int k = 0; k < 100; ++k) path.push_back({load * (compliance += 0.01), load});
  }
  return path;
}

TEST(ResidualStrength, BeginsBehindALoadThatFellAndClimbedBeyondItsPeak) {
  const auto rows = [](const std::vector<double>& loads, bool bars = false) {
    return rows_before_residual(path_at(loads), bars);
  };
  EXPECT_NEAR(static_cast<double>(rows({3.0, 6.0, 5.7, 5.8, 12.0})), 250.0, 50.0);
  EXPECT_NEAR(static_cast<double>(rows({-6.0, -5.7, -12.0})), 150.0, 50.0) << "compression";
  EXPECT_EQ(rows({6.0, 5.7, 12.0}, true), 300u) << "bars carry it";
  EXPECT_EQ(rows({6.0, 5.7, 6.5}), 300u) << "climbed by less";
  EXPECT_EQ(rows({6.0, 5.9, 12.0}), 300u) << "fell by less";
  EXPECT_EQ(rows({6.0, 4.0, 3.0}), 300u);
  EXPECT_EQ(rows({}), 0u);
}

/// Single rows fall by a third and come again, as within the growth of one crack.
TEST(ResidualStrength, IsNoneOfTeeth) {
  std::vector<CurvePoint> path;
  for (int k = 0; k <= 400; ++k) {
    const double load = (3.0 + 0.01 * k) * (k % 5 == 0 ? 1.0 : 0.66);
    path.push_back({load * (1.0 + 0.01 * k), load});
  }
  EXPECT_EQ(rows_before_residual(path, false), path.size());
}

/// Avalanches take four fifths of the load, thirty rows long, at hardly more compliance.
TEST(ResidualStrength, IsNoneOfAvalanches) {
  std::vector<CurvePoint> path;
  for (int k = 0; k < 1200; ++k) {
    const int within = k % 100;  // the load climbs linearly again
    const double share = within < 70 ? 1.0 : 0.2 + 0.8 * (within - 70) / 30.0;
    const double load = -share * (2.0 + 0.005 * k);
    path.push_back({load * (1.0 + 1e-4 * k), load});
  }
  EXPECT_EQ(rows_before_residual(path, false), path.size());
  for (std::size_t k = 70; k < 96; ++k) path[k].displacement *= 1.5;  // and no more at its end
  EXPECT_EQ(rows_before_residual(path, false), path.size());
  for (std::size_t k = 96; k < 1200; ++k) path[k].displacement *= 1.5;
  EXPECT_EQ(rows_before_residual(path, false), 71u) << "half of the stiffness is lost in it";
}

/// Event path of one load as rows of a stage.
TEST(ResidualStrength, StagesHaveTheEnvelopeOfTheirEvents) {
  std::vector<StepRecord> rows = make_path(1001, true);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    rows[k].dissipated_energy = rows[k - 1].dissipated_energy + dissipated(rows, k - 1, k);
  }
  const double expected = smoothed_peak(event_path(rows)).value();
  EXPECT_NEAR(smoothed_peak(stage_path(rows)).value(), expected, 1e-9 * expected);
}

TEST(Envelope, PassesOverSingleTeeth) {
  std::vector<CurvePoint> path;
  for (int k = 0; k <= 200; ++k) {
    const double load = k % 10 == 5 ? 6.0 : 3.0;
    path.push_back({load * (1.0 + k), load});
  }
  // Two of ten events have one end on the segment: load^2 = (8 * 3 * 3 + 2 * 3 * 6) / 10.
  EXPECT_NEAR(smoothed_peak(path).value(), std::sqrt(10.8), 1e-12);
  EXPECT_FALSE(smoothed_peak(std::span(path).first(20))) << "one window is no curve";
}

/// On weak springs the events of the body hardly move their displacement. The envelope must not
/// consist only of a last window in which the springs fail, with a peak far below that of the rows.
TEST(Envelope, HasNoPeakWhereWindowsWithoutAPointBearMore) {
  std::vector<CurvePoint> path;
  for (int k = 0; k <= 100; ++k) path.push_back({8e9 * (1.0 + 1e-12 * k), 800.0});
  for (int k = 1; k <= 100; ++k) path.push_back({24.0 * (1e7 + 1e6 * k), 24.0});
  EXPECT_NEAR(smooth_envelope(path, 10).back().load, 24.0, 1e-9);
  EXPECT_FALSE(smoothed_peak(path));
}

/// The rest of a body carries more, in equally many further events.
TEST(ResidualStrength, BeginsWhereTheBodyGaveWay) {
  std::vector<CurvePoint> path;
  for (int k = 0; k <= 4; ++k) path.push_back({1.0 + k, 3.0});
  for (int k = 0; k <= 4; ++k) path.push_back({1000.0 + 10.0 * k, k == 0 ? 1.0 : 8.0});
  EXPECT_EQ(rows_before_residual(path, true), 5u) << "too few events for an envelope";
  path.resize(6);
  EXPECT_EQ(rows_before_residual(path, true), 6u) << "it stays weak";
}

PeakWatch watch(const std::vector<CurvePoint>& rows, int successive = 1) {
  PeakWatch peaks(successive);
  for (const CurvePoint& row : rows) peaks.add(row);
  return peaks;
}

TEST(PeakWatch, FindsTheLargestLoadWithItsSign) {
  const PeakWatch peaks = watch({{1.0, -2.0}, {2.0, -5.0}, {3.0, -4.0}});
  EXPECT_EQ(peaks.highest().load, -5.0);
  EXPECT_EQ(peaks.highest().displacement, 2.0);
  EXPECT_EQ(peaks.first().load, -5.0);
  EXPECT_FALSE(peaks.gave_way());
  EXPECT_FALSE(peaks.climbed_again());
}

TEST(PeakWatch, TellsTheFirstPeakFromOneAfterTheBodyGaveWay) {
  const PeakWatch peaks = watch({{1.0, 4.0}, {1.5, 5.0}, {2.0, 2.4}, {9.0, 7.0}, {10.0, 1.0}});
  EXPECT_TRUE(peaks.gave_way());
  EXPECT_TRUE(peaks.climbed_again());
  EXPECT_EQ(peaks.first().load, 5.0);
  EXPECT_EQ(peaks.first().displacement, 1.5);
  EXPECT_EQ(peaks.highest().load, 7.0);
}

TEST(PeakWatch, ABodyThatGivesWayAndStaysWeakHasOnePeak) {
  const PeakWatch peaks = watch({{1.0, 5.0}, {2.0, 2.0}, {9.0, 4.9}});
  EXPECT_TRUE(peaks.gave_way());
  EXPECT_FALSE(peaks.climbed_again());
  EXPECT_EQ(peaks.first().load, 5.0);
  EXPECT_EQ(peaks.highest().load, 5.0);
}

/// A test with growing displacement does not follow segments that snap back and return.
TEST(PeakWatch, PassesOverTeethThatSnapBack) {
  const PeakWatch peaks =
      watch({{1.0, 5.0}, {0.3, 1.4}, {0.2, 0.9}, {1.2, 5.2}, {0.4, 1.6}, {1.4, 5.4}});
  EXPECT_FALSE(peaks.gave_way());
  EXPECT_EQ(peaks.highest().load, 5.4);
}

/// The path snaps back and reaches the displacement of its peak again with a fifth of the load, and
/// more than the peak in the same row.
TEST(PeakWatch, SeesAFallThatSnapBackHides) {
  const PeakWatch peaks = watch({{1.0, 5.0}, {0.5, 0.5}, {6.0, 6.0}});
  EXPECT_TRUE(peaks.climbed_again());
  EXPECT_EQ(peaks.first().load, 5.0);
}

TEST(PeakWatch, LoadsThatVibrateHaveToStayBelow) {
  std::vector<CurvePoint> rows = {{1.0, 5.0}};
  for (int k = 0; k < 9; ++k) rows.push_back({2.0 + k, 1.0});
  rows.push_back({12.0, 4.0});
  rows.push_back({13.0, 6.0});
  EXPECT_FALSE(watch(rows, 10).gave_way());
  rows.insert(rows.begin() + 10, {11.0, 1.0});
  EXPECT_TRUE(watch(rows, 10).climbed_again());
}

TEST(PeakWatch, ABodyWithoutDamageHasNotGivenWay) {
  PeakWatch peaks;
  peaks.add({1.0, 5.0}, true);
  peaks.add({2.0, 1.0}, true);
  peaks.add({3.0, 6.0}, true);
  EXPECT_FALSE(peaks.gave_way());
}

}  // namespace
}  // namespace perilink
