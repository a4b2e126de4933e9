// Fields at the peak equal those that a run with fields at its row writes there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/files.hpp"
#include "support/replaced.hpp"
#include "support/softening_strips.hpp"
#include "support/strip_case.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

/// A notched plate with unbreakable ends, pulled by a force or a displacement. Under the force,
/// rows leave displacements of the ends out of date.
std::string notched_plate(const std::string& more) {
  return R"(regions = [
  {name = "plate", x = [0, 60], y = [0, 80]},
  {name = "bottom", x = [0, 60], y = [0, 20]},
  {name = "top", x = [0, 60], y = [60, 80]},
]
[body]
problem = "plane_stress"
spacing = 5.0
horizon_ratio = 3
[[materials]]
region = "plate"
youngs_modulus = 30000.0
fracture_energy = 0.1
[[materials]]
regions = ["bottom", "top"]
youngs_modulus = 30000.0
fracture_energy = "infinite"
[[cracks]]
points = [[-1, 41], [17, 41]]
[[supports]]
region = "bottom"
fix = ["x", "y"]
)" + more;
}

std::string softening_notched_plate(const std::string& more) {
  return replaced(notched_plate(more), "fracture_energy = 0.1",
                  "fracture_energy = 0.02\ntensile_strength = 3.0\nsoftening = \"linear\"");
}

struct PeakCase {
  const char* name;
  std::string text;
  double tolerance = 0.0;  ///< of a completed solution, over the largest value
};

void PrintTo(const PeakCase& peak, std::ostream* stream) { *stream << peak.name; }

const char* const moved_top = "[[displacements]]\nregion = \"top\"\ny = 1.0\n";
const char* const loaded_top = "[[loads]]\nregion = \"top\"\nforce = [0, 100.0]\n";

class PeakFields : public testing::TestWithParam<PeakCase> {};

TEST_P(PeakFields, AreThoseOfTheRowOfThePeak) {
  CaseFile input = parse_case(GetParam().text, "");
  const test::WholeRun run(input);
  const std::vector<double> loads = run.history("load"), moves = run.history("displacement");
  const double load = run.summary.json["peak_load"], move = run.summary.json["peak_displacement"];
  std::size_t row = 0;
  while (row < loads.size() && (loads[row] != load || moves[row] != move)) ++row;
  ASSERT_LT(row, loads.size());
  ASSERT_GT(row, 0u) << "the peak is no row of its own";
  ASSERT_LT(row + 1, loads.size());
  input.output.fields_at_peak = false;
  input.output.fields_every_rows = static_cast<int>(row) + 1;
  const test::WholeRun every(input);
  EXPECT_EQ(every.history("load"), loads) << "looking at the peak changes nothing";

  const std::string name = fmt::format("fields_{:06}.vtu", row + 1);
  const std::vector<PvdEntry> series = run.series();
  ASSERT_EQ(std::ranges::count(series, name, &PvdEntry::file), 1);
  EXPECT_TRUE(std::ranges::is_sorted(series, {}, &PvdEntry::time));
  const VtuGrid found = read_vtu((run.work / name).string());
  const VtuGrid expected = read_vtu((every.work / name).string());
  EXPECT_EQ(found.field("load", 0.0), load);
  EXPECT_EQ(found.connectivity, expected.connectivity);
  ASSERT_EQ(found.point_data.size(), expected.point_data.size());
  for (std::size_t k = 0; k < found.point_data.size(); ++k) {
    const VtuArray &one = found.point_data[k], &other = expected.point_data[k];
    if (one.name.ends_with("direction") && GetParam().tolerance > 0.0) continue;
    double largest = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      largest = std::max(largest, std::abs(other.values[i]));
      difference = std::max(difference, std::abs(one.values[i] - other.values[i]));
    }
    EXPECT_LE(difference, GetParam().tolerance * largest) << one.name;
  }
  for (const char* table : {"reactions", "bars"}) {
    const std::string file = fmt::format("{}_{:06}.csv", table, row + 1);
    EXPECT_EQ(std::filesystem::exists(run.work / file), std::filesystem::exists(every.work / file));
  }
}

// A solve with another factor leaves its round-off times the condition of the body.
constexpr double solve_round_off = 1e-8;

INSTANTIATE_TEST_SUITE_P(
    All, PeakFields,
    testing::Values(
        PeakCase{"brittle", notched_plate(moved_top)},
        PeakCase{"force", notched_plate(loaded_top), solve_round_off},
        PeakCase{"softening", softening_notched_plate(moved_top)},
        PeakCase{"softening under a force", softening_notched_plate(loaded_top), solve_round_off},
        PeakCase{"steps", softening_notched_plate(
                              std::string(moved_top) +
                              "[analysis]\ncontrol = \"steps\"\nload_factors = [0.001, 0.002, "
                              "0.004, 0.006, 0.008, 0.01, 0.012, 0.02, 0.04]\n")},
        PeakCase{"hosts under a force",
                 notched_plate(std::string(loaded_top) + "[elements]\nspacings = 2\n"),
                 solve_round_off},
        PeakCase{"stages", softening_notched_plate(moved_top + std::string(R"(
[[stages]]
name = "pull"
broken_bonds = 3
[[stages]]
name = "unload"
loads = "pull"
to = 0
[[stages]]
name = "again"
loads = "pull"
broken_bonds = 30
)"))}),
    [](const auto& at) {
      std::string name = at.param.name;
      std::ranges::replace(name, ' ', '_');
      return name;
    });

TEST(PeakFieldsOfARun, AreLeftOutOnDemand) {
  const test::WholeRun run(notched_plate(moved_top) + "[output]\nfields_at_peak = false\n");
  EXPECT_EQ(run.series().size(), 2u);
}

/// Intact bonds along the crack join its faces, whose displacements differ by its opening.
TEST(StressFields, StayWithinTheStrengthBesideAnOpenCrack) {
  const test::WholeRun run(R"(regions = [
  {name = "strip", x = [0, 100], y = [0, 200]},
  {name = "lower", x = [0, 100], y = [0, 0]},
  {name = "upper", x = [0, 100], y = [200, 200]},
]
[body]
spacing = 5.0
horizon = 15.0
[[materials]]
region = "strip"
youngs_modulus = 30e3
tensile_strength = 3.0
fracture_energy = 0.1
[[cracks]]
points = [[0, 100], [50, 100]]
[[supports]]
region = "lower"
fix = ["x", "y"]
[[displacements]]
region = "upper"
y = 1.0
[stop]
load_fraction = 0.1
)");
  const VtuGrid grid = run.fields(run.series().size() - 1);
  const std::vector<double>& stress = grid.find_point_data("principal_stress")->values;
  EXPECT_GT(*std::ranges::max_element(grid.find_point_data("crack_opening")->values), 0.08);
  EXPECT_LT(*std::ranges::max_element(stress), 3.0);
  EXPECT_GT(*std::ranges::min_element(stress), -3.0);

  // The summary has the compression of the damaged body at the peak.
  const double peak = run.summary.json["peak_load"];
  std::size_t file = 0;
  while (file < run.series().size() && run.fields(file).field("load", 0.0) != peak) ++file;
  ASSERT_LT(file, run.series().size());
  const VtuGrid at_peak = run.fields(file);
  const std::vector<double>& damage = at_peak.find_point_data("damage")->values;
  double largest = 0.0;
  for (std::size_t i = 0; i < damage.size(); ++i) {
    if (damage[i] > 0.5) continue;
    largest = std::max(largest, -at_peak.find_point_data("principal_stress")->values[3 * i + 2]);
    largest = std::max(largest, -at_peak.find_point_data("principal_stress")->values[3 * i + 1]);
  }
  EXPECT_NEAR(run.summary.json["largest_compression"].get<double>(), largest, 1e-12 * largest);
}

TEST(NotesOfARun, TellWhetherTheLoadWasStillGrowing) {
  CaseFile input = parse_case(softening_notched_plate(moved_top), "");
  const auto growing = testing::Contains(testing::HasSubstr("still growing at the end"));
  const test::WholeRun whole(input);
  EXPECT_THAT(whole.summary.notes, testing::Not(growing));
  input.stop.displacement = 0.6 * whole.summary.json["peak_displacement"].get<double>();
  EXPECT_THAT(test::WholeRun(input).summary.notes, growing);
}

/// A strip that a crack crosses: its width is the prescribed displacement without the elastic
/// elongation U - F L / (E A).
TEST(CrackTable, WidthsAreTheImposedDisplacementWithoutTheElasticPart) {
  test::SofteningStrip strip;
  for (const auto& [end, tolerance] : {std::pair{0.05, 0.02}, std::pair{0.1, 0.002}}) {
    strip.more = fmt::format("[stop]\ndisplacement = {}\n[output]\nbody_cells = true\n", end);
    const test::WholeRun run(test::softening_case(strip));
    const double load = run.history("load").back(), moved = run.history("displacement").back();
    const double width = moved - load * strip.length / (strip.youngs_modulus * strip.width);
    const auto& cracks = run.summary.json["cracks"];
    ASSERT_EQ(cracks.size(), 1u);
    for (const char* key : {"largest_opening", "face_opening"}) {
      EXPECT_NEAR(cracks[0][key].get<double>(), width, tolerance * width) << key;
    }
    EXPECT_NEAR(cracks[0]["length"].get<double>(), strip.width, 1.0);
    EXPECT_NEAR(cracks[0]["middle"][0].get<double>(), 0.5 * strip.length, strip.spacing);
    EXPECT_NEAR(std::abs(cracks[0]["normal"][0].get<double>()), 1.0, 1e-3);

    const std::string last = run.series().back().file;
    const std::string table = read_regular_file(
        (run.work / ("cracks_" + last.substr(7, last.size() - 11) + ".csv")).string());
    EXPECT_EQ(std::ranges::count(table, '\n'), 2);
    EXPECT_THAT(
        table, testing::HasSubstr(fmt::format(",{},", cracks[0]["largest_opening"].get<double>())));
    EXPECT_FALSE(std::filesystem::exists(run.work / "cracks_000001.csv")) << "no crack yet";
    const auto cells = [&](std::size_t file) {
      const VtuGrid grid = run.fields(file);
      return std::ranges::count(grid.types, VtuCell::quadrilateral);
    };
    EXPECT_EQ(cells(0), 20 * 10);
    if (end == 0.1) {
      const auto left = cells(run.series().size() - 1);  // the crack takes one or two of each row
      EXPECT_LE(left, 19 * 10);
      EXPECT_GE(left, 18 * 10);
    }
  }
}

}  // namespace
}  // namespace perilink
