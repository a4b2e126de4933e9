// Reactions of bodies with host elements, compared with statics.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "app/run/quasistatic.hpp"
#include "model/from_case/configure.hpp"
#include "model/reactions.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

/// Round-off of sums of bond forces, which are about 1e3 times the loads in a slender body.
constexpr double balanced = 1e-10;

std::string region(const std::string& name, double x0, double x1, double y0, double y1) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, x0, x1, y0,
                     y1);
}

std::string support(const std::string& place, const std::string& fix) {
  return fmt::format("[[supports]]\nregion = \"{}\"\nfix = [{}]\n", place, fix);
}

/// Body of `columns` by `rows` spacings with its lower left corner at (x, y); beams lie along y =
/// 0.
struct Strip {
  explicit Strip(std::mt19937& random) : engine(random) {
    beam = whole(0, 3) == 0;
    columns = whole(16, 40);
    rows = beam ? 0 : whole(3, 10);
    spacing = real(0.3, 5.0);
    x = real(-20.0, 20.0);
    y = beam ? 0.0 : real(-20.0, 20.0);
    order = whole(1, 2);
    element = whole(2, 8);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double column(int k) const { return x + k * spacing; }
  double row(int k) const { return y + k * spacing; }
  double right() const { return column(columns); }
  double top() const { return row(rows); }
  double size() const { return (columns + rows) * spacing; }

  std::string head(const std::string& extra = "") const {
    const double half = beam ? 1.5 * spacing : 0.0;
    std::string text = fmt::format("[body]\nspacing = {}\nthickness = 2.0\nhorizon_ratio = 3\n{}",
                                   spacing, beam ? "problem = \"beam\"\n" : "");
    text += region("all", x, right(), y - half, top() + half);
    text += region("left", x, x, y - half, top() + half);
    text += region("right", right(), right(), y - half, top() + half);
    text += "[[materials]]\nregion = \"all\"\nyoungs_modulus = 3000\n";
    if (!beam) text += "fracture_energy = 0.1\n";
    return text + extra + fmt::format("[elements]\nspacings = {}\norder = {}\n", element, order);
  }

  std::mt19937& engine;
  bool beam;
  int columns, rows, order, element;
  double spacing, x, y;
};

struct Reactions {
  explicit Reactions(const std::string& text) {
    const CaseFile input = parse_case(text, "strip.toml");
    const Model model = build_model(input);
    const ElasticAnswer answer = solve_elastic(model, {});
    embedded =
        model.embedded && std::count(model.embedded->whole.begin(), model.embedded->whole.end(), 1);
    ModelState state{{}, answer.solution.displacement};
    state.internal = answer.solution.forces;
    const std::vector<SupportRegion> places = support_regions(input, model);
    const std::vector<double> forces = holding_forces(model, state);
    for (const SupportRegion& place : places) {
      at.push_back(reaction_on(model, place.particles, forces));
      size = std::max(size, at.back().force_size);
    }
    sum = reaction_table(places, model, state).sum;
  }
  /// Returns the largest sum of forces, or of moments about the body's middle over its size,
  /// relative to the forces.
  double imbalance(const Strip& strip) const {
    const double moment = std::abs(sum.moment[2]) / strip.size();
    return std::max({std::abs(sum.force[0]), std::abs(sum.force[1]), moment}) / size;
  }
  std::vector<Reaction> at;
  Reaction sum;
  double size = 0.0;
  bool embedded = false;
};

/// Returns the error of the reactions of two supports, by the law of the lever.
double error_of_simple_beam(Strip& strip) {
  const int first = strip.whole(0, 4), second = strip.whole(strip.columns - 4, strip.columns);
  const double a = strip.column(first), b = strip.column(second);
  const double px = strip.real(-1.0, 1.0), py = strip.real(-2.0, -1.0);
  const double at_x = strip.column(strip.whole(0, strip.columns)), at_y = strip.top();
  std::string text =
      region("pin", a, a, strip.y, strip.y) + region("roller", b, b, strip.y, strip.y);
  text += support("pin", "\"x\", \"y\"") + support("roller", "\"y\"");
  text += fmt::format("[[point_loads]]\nat = [{}, {}]\nforce = [{}, {}]\n", at_x, at_y, px, py);
  const Reactions found(strip.head(text) + "[analysis]\ntype = \"elastic\"\n");
  EXPECT_TRUE(found.embedded);
  const double roller = -((at_x - a) * py - (at_y - strip.y) * px) / (b - a);
  return std::max({std::abs(found.at[0].force[0] + px), std::abs(found.at[1].force[1] - roller),
                   std::abs(found.at[0].force[1] + py + roller), found.imbalance(strip)});
}

/// Returns the error of a clamp's reaction: the whole load and its moment about the middle of the
/// clamp.
double error_of_clamp(Strip& strip) {
  const double px = strip.real(-1.0, 1.0), py = strip.real(-2.0, -1.0);
  std::string text = support("left", strip.beam ? "\"x\", \"y\", \"rotation\"" : "\"x\", \"y\"");
  text += fmt::format("[[loads]]\nregion = \"right\"\nforce = [{}, {}]\n", px, py);
  const Reactions found(strip.head(text) + "[analysis]\ntype = \"elastic\"\n");
  EXPECT_TRUE(found.embedded);
  const double arm = strip.right() - strip.x;
  return std::max({std::abs(found.at[0].force[0] + px), std::abs(found.at[0].force[1] + py),
                   std::abs(found.at[0].moment[2] + arm * py) / strip.size(),
                   found.imbalance(strip)});
}

/// Returns the difference between the forces at the displaced end and at the clamp.
double error_of_driven_end(Strip& strip) {
  std::string text = support("left", strip.beam ? "\"x\", \"y\", \"rotation\"" : "\"x\", \"y\"");
  text += fmt::format("[[displacements]]\nregion = \"right\"\ny = {}\n", 0.01 * strip.size());
  const Reactions found(strip.head(text) + "[analysis]\ntype = \"elastic\"\n");
  EXPECT_TRUE(found.embedded);
  return std::max(std::abs(found.at[0].force[1] + found.at[1].force[1]) / found.size,
                  found.imbalance(strip));
}

/// Returns the error of the reactions of a pin and of springs at the other end.
double error_of_springs(Strip& strip) {
  const double py = strip.real(-2.0, -1.0), at_x = strip.column(strip.whole(0, strip.columns));
  std::string text = region("pin", strip.x, strip.x, strip.y, strip.y);
  text += support("pin", "\"x\", \"y\"");
  text += "[[springs]]\nregion = \"right\"\ntotal = [0, 50]\n";
  text += fmt::format("[[point_loads]]\nat = [{}, {}]\nforce = [0, {}]\n", at_x, strip.top(), py);
  const Reactions found(strip.head(text) + "[analysis]\ntype = \"elastic\"\n");
  EXPECT_TRUE(found.embedded);
  const double springs = -py * (at_x - strip.x) / (strip.right() - strip.x);
  return std::max(std::abs(found.at[1].force[1] - springs), found.imbalance(strip));
}

TEST(Reactions, OfAHundredBodiesOfElementsFollowStatics) {
  std::mt19937 random(54);
  double largest = 0.0;
  for (int k = 0; k < 100; ++k) {
    Strip strip(random);
    const double error = k % 4 == 0   ? error_of_simple_beam(strip)
                         : k % 4 == 1 ? error_of_clamp(strip)
                         : k % 4 == 2 ? error_of_driven_end(strip)
                                      : error_of_springs(strip);
    EXPECT_LT(error, balanced) << "body " << k << ": " << strip.columns << " by " << strip.rows
                               << ", elements of " << strip.element << ", order " << strip.order;
    largest = std::max(largest, error);
  }
  RecordProperty("largest_deviation", fmt::format("{:.2g}", largest));
}

/// Last file of reactions of a run, and its warnings.
struct RunReactions {
  explicit RunReactions(const std::string& text) : run(text) {
    const std::string file = run.series().back().file;
    const std::string step = file.substr(file.find('_'), 7);
    std::ifstream in(run.work / ("reactions" + step + ".csv"));
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::array<double, 5> row{};
      const std::string numbers = line.substr(line.find(',') + 1);
      EXPECT_EQ(std::sscanf(numbers.c_str(), "%lf,%lf,%lf,%lf,%lf", &row[0], &row[1], &row[2],
                            &row[3], &row[4]),
                5);
      rows.push_back(row);
    }
  }
  test::WholeRun run;
  std::vector<std::array<double, 5>> rows;  ///< x, y, force_x, force_y, moment
};

/// Case of a beam of 400 by 100 with elements of eight spacings of 5.
std::string tall_beam(const std::string& supports, const std::string& loads) {
  return "[body]\nspacing = 5\nhorizon_ratio = 3\nthickness = 10\n" + region("b", 0, 400, 0, 100) +
         region("left", 0, 0, 0, 100) + region("lp", 20, 20, 0, 0) + region("rp", 380, 380, 0, 0) +
         region("right", 400, 400, 0, 100) +
         "[[materials]]\nregion = \"b\"\nyoungs_modulus = 30000\nfracture_energy = 0.1\n" +
         supports + "[elements]\nspacings = 8\n" + loads;
}

TEST(Reactions, OfABeamOnTwoSupportsAreHalfTheLoadEach) {
  const RunReactions found(tall_beam(
      support("lp", "\"x\", \"y\"") + support("rp", "\"y\""),
      "[[point_loads]]\nat = [200, 100]\nforce = [0, -1000]\n[analysis]\ntype = \"elastic\"\n"));
  EXPECT_NEAR(found.rows[0][3], 500.0, 500.0 * balanced);
  EXPECT_NEAR(found.rows[1][3], 500.0, 500.0 * balanced);
  EXPECT_TRUE(found.run.summary.warnings.empty()) << found.run.summary.text;
}

TEST(Reactions, OfAWallAreTheLoadAndItsMoment) {
  for (const char* order : {"order = 1\n", "order = 2\n"}) {
    const RunReactions found(tall_beam(support("left", "\"x\", \"y\""),
                                       std::string(order) +
                                           "[[loads]]\nregion = \"right\"\nforce = [0, -1000]\n"
                                           "[analysis]\ntype = \"elastic\"\n"));
    EXPECT_NEAR(found.rows[0][3], 1000.0, 1000.0 * balanced);
    EXPECT_NEAR(found.rows[0][4], 400000.0, 400000.0 * balanced);
    EXPECT_TRUE(found.run.summary.warnings.empty()) << found.run.summary.text;
  }
}

/// Elements are released before bonds break, so rows at the end have fewer elements than the model.
TEST(Reactions, OfABodyThatBreaksAreItsLoad) {
  for (const char* loads : {"[[loads]]\nregion = \"right\"\nforce = [0, -1000]\n",
                            "[[displacements]]\nregion = \"right\"\ny = -1\n"}) {
    const RunReactions found(tall_beam(support("left", "\"x\", \"y\""),
                                       loads + std::string("[stop]\nbroken_bonds = 3\n")));
    const CsvTable history = found.run.history();
    const double load = history.rows.back()[static_cast<std::size_t>(history.column("load"))];
    const double elements =
        history.rows.back()[static_cast<std::size_t>(history.column("elements"))];
    EXPECT_GT(elements, 0.0);
    EXPECT_LT(elements, found.run.summary.json["elements"].get<double>());
    EXPECT_NEAR(found.rows[0][3], std::abs(load), std::abs(load) * balanced);
    EXPECT_NEAR(found.rows.back()[2], 0.0, std::abs(load) * balanced);
    EXPECT_NEAR(found.rows.back()[3], 0.0, std::abs(load) * balanced);
    EXPECT_TRUE(found.run.summary.warnings.empty()) << found.run.summary.text;
  }
}

/// Includes displacements prescribed in a later stage, and conjugate gradients.
TEST(Reactions, BalanceInEveryKindOfRun) {
  const std::string stages =
      "[[stages]]\nname = \"weight\"\nto = 1\n[[stages]]\nname = \"pull\"\nto = 0.001\n"
      "[[loads]]\nregion = \"b\"\nforce = [0, -50]\nstage = \"weight\"\n"
      "[[displacements]]\nregion = \"right\"\nx = 1\nstage = \"pull\"\n";
  const RunReactions staged(tall_beam(support("left", "\"x\", \"y\""), stages));
  EXPECT_NEAR(staged.rows[0][3] + staged.rows[1][3], 50.0, 50.0 * balanced);
  EXPECT_TRUE(staged.run.summary.warnings.empty()) << staged.run.summary.text;
  for (const char* kind : {"elastic", "damage"}) {
    std::string text =
        tall_beam(support("left", "\"x\", \"y\""),
                  fmt::format("[[loads]]\nregion = \"right\"\nforce = [0, -1000]\n"
                              "[analysis]\ntype = \"{}\"\nsolver = \"iterative\"\n{}",
                              kind, kind[0] == 'd' ? "[stop]\nbroken_bonds = 2\n" : ""));
    text.erase(text.find("[elements]\n"), 24);  // only a factor supports them
    const RunReactions iterative(text);
    EXPECT_NEAR(iterative.rows.back()[3] / iterative.rows[0][3], 0.0, 1e-8);
    EXPECT_TRUE(iterative.run.summary.warnings.empty()) << iterative.run.summary.text;
  }
}

}  // namespace
}  // namespace perilink
