// Elastic bodies whose parts the ranks make by themselves, under mpiexec.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "io/fields/vtu.hpp"
#include "support/rank_runs.hpp"

namespace perilink::test {
namespace {

using testing::HasSubstr;

/// The values of a field of points, particle after particle as a body alone has them.
std::vector<double> sorted_values(const VtuGrid& grid, const VtuArray& array) {
  std::vector<std::pair<std::array<double, 3>, std::size_t>> places;
  for (std::size_t i = 0; i < grid.points.size() / 3; ++i) {
    const double* x = grid.points.data() + 3 * i;
    places.push_back({{x[2], x[1], x[0]}, i});
  }
  std::sort(places.begin(), places.end());
  std::vector<double> values;
  for (const auto& [at, i] : places) {
    const double* first = array.values.data() + i * static_cast<std::size_t>(array.components);
    values.insert(values.end(), first, first + array.components);
  }
  return values;
}

/// Searches end at 1e-10 in energy. Where principal values are nearly equal their directions may be
/// any, and they themselves are found to the root of round-off, 1.5e-8, in both bodies.
void expect_same_fields(const VtuGrid& expected, const VtuGrid& found) {
  ASSERT_EQ(found.point_data.size(), expected.point_data.size());
  for (const VtuArray& array : expected.point_data) {
    if (array.name.ends_with("_direction")) continue;
    const std::vector<double> a = sorted_values(expected, array),
                              b = sorted_values(found, *found.find_point_data(array.name));
    ASSERT_EQ(a.size(), b.size());
    double size = 0.0, difference = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      size = std::max(size, std::abs(a[k]));
      difference = std::max(difference, std::abs(a[k] - b[k]));
    }
    const double tolerance = array.name.starts_with("principal_") ? 3e-8 : 1e-9;
    EXPECT_LE(difference, tolerance * size) << array.name;
  }
}

/// Reactions agree as fields do: positions and forces to 1e-9 of the largest of their kind, moments
/// of the largest force at the longest arm.
void expect_same_reactions(const std::string& expected, const std::string& found) {
  const std::vector<double> a = numbers_of(expected), b = numbers_of(found);
  std::istringstream header(expected.substr(0, expected.find('\n')));
  ASSERT_EQ(found.substr(0, found.find('\n')), header.str());
  std::string kinds;  // "p" for place, "x" for x, y and z, "f" and "m" for force and moment
  for (std::string name; std::getline(header, name, ',');) {
    kinds += name.size() == 1 ? 'x' : name.front();
  }
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GE(a.size(), 3 * kinds.size()) << "a place, the loads, the sum";
  std::map<char, double> size;
  for (std::size_t k = 0; k < a.size(); ++k) {
    double& largest = size[kinds[k % kinds.size()]];
    largest = std::max(largest, std::abs(a[k]));
  }
  size['m'] = size['f'] * size['x'];
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(b[k], a[k], 1e-9 * size[kinds[k % kinds.size()]]) << header.str() << ' ' << k;
  }
}

class OwnParts : public RankFolder, public testing::WithParamInterface<RankCase> {};

TEST_P(OwnParts, HaveTheAnswerOfTheWholeBody) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  ASSERT_EQ(run_program(work(), {"run", "c.toml", "--out", "r1"}).exit_status, 0);
  const std::vector<double> expected = numbers_of(history("r1"));
  const VtuGrid fields = read_vtu((work() / "r1/fields_000001.vtu").string());
  for (const int count : {2, 4}) {
    const std::string out = "r" + std::to_string(count);
    const ProcessEnd end = run_ranks(count, "run c.toml --out " + out);
    ASSERT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(summary(out).at("notes").dump(), HasSubstr("makes its own part"));
    EXPECT_EQ(summary(out).at("bonds"), summary("r1").at("bonds"));
    EXPECT_EQ(summary(out).at("ranks"), count);
    const std::vector<double> found = numbers_of(history(out));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (std::abs(expected[k]) < 1e-8) continue;  // residuals
      EXPECT_NEAR(found[k], expected[k], 1e-9 * std::abs(expected[k])) << "number " << k;
    }
    expect_same_fields(fields, read_vtu((work() / out / "fields_000001.pvtu").string()));
    expect_same_reactions(read_text(work() / "r1/reactions_000001.csv"),
                          read_text(work() / out / "reactions_000001.csv"));
  }
}

TEST_F(RankFolder, PiecesAreDrawnAndGoWithTheirRun) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", bar_case(true, ""));
  ASSERT_EQ(run_ranks(3, "run c.toml --out r").exit_status, 0);
  EXPECT_TRUE(fs::exists(work() / "r/fields_000001_0002.vtu"));
  EXPECT_EQ(run_program(work(), {"plot", "r"}).exit_status, 0);
  EXPECT_TRUE(fs::exists(work() / "r/fields_1.svg"));
  const std::string whole = (work() / "r/fields_000001.pvtu").string(), text = read_text(whole);
  write_text(whole, replaced(text, R"(<Piece Source="fields_000001_0002.vtu" />)", ""));
  for (const auto& words : {std::vector<std::string>{"plot", "r"}, {"compare", "r", "r"}}) {
    const ProcessEnd end = run_program(work(), words);
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, HasSubstr("does not name its piece 'fields_000001_0002.vtu'"));
  }
  ASSERT_EQ(run_program(work(), {"run", "c.toml", "--out", "r", "--force"}).exit_status, 0);
  EXPECT_FALSE(fs::exists(work() / "r/fields_000001.pvtu"));
  EXPECT_FALSE(fs::exists(work() / "r/fields_000001_0002.vtu"));
}

const std::string micropolar = "model = \"micropolar\"\n";
const std::string springs_in_space = "\n[[springs]]\nregion = \"bar\"\ntotal = [2e3, 5e3, 1e3]\n";

/// From a face to the middle of the bar, slightly inclined.
const std::string notch_in_space =
    "\n[[cracks]]\ncorners = [[8.2, 0, -1], [8.2, 2.4, -1], [9.3, 2.4, 6], [9.3, 0, 6]]\n";
const std::string crack_in_plane = "\n[[cracks]]\npoints = [[-1, 2.5], [8, 2.5], [9.3, 3.6]]\n";

const std::string gauges =
    "\n[[gauges]]\nname = \"tip\"\nregion = \"right\"\naxis = \"y\"\n"
    "\n[[gauges]]\nname = \"longer\"\nbetween = [[0, 2, 2], [20, 2, 2]]\n"
    "\n[[gauges]]\nname = \"stress\"\nregion = \"right\"\nstress = \"xx\"\n";

INSTANTIATE_TEST_SUITE_P(
    Bodies, OwnParts,
    testing::Values(
        RankCase{"Loaded", bar_case(true, "") + springs_in_space + gauges},
        RankCase{"Driven", driven(bar_case(true, "")) + gauges},
        RankCase{"FaceCentred", replaced(bar_case(true, "pattern = \"face_centred\"\n"),
                                         "_ratio = 3", "_ratio = 2")},
        RankCase{"ByEnergy", bar_case(true, "surface = \"energy\"\n")},
        RankCase{"PlaneUncorrected", bar_case(false, "surface = \"none\"\n")},
        RankCase{"Notched", bar_case(true, "") + notch_in_space + gauges},
        RankCase{"CrackedPlane", driven(bar_case(false, "surface = \"none\"\n")) + crack_in_plane},
        RankCase{"Frames", bar_case(true, micropolar) + springs_in_space + gauges},
        RankCase{"CrackedFrames",
                 bar_case(false, micropolar + "surface = \"energy\"\n") + crack_in_plane}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace perilink::test
