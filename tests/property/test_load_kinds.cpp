#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

/// \file
/// Invariants for every kind of load: forces, prescribed displacements, both together, yielding
/// bars.

namespace perilink {
namespace {

/// Returns a small block fixed below with the load `loading` and further tables `more`.
Model block(const std::string& loading, const std::string& more = "") {
  return build_model(parse_case(R"(
[body]
pattern = "hexagonal"
columns = 9
horizon_ratio = 3.0
[[regions]]
name = "block"
x = [0, 100]
y = [0, 100]
[[regions]]
name = "base"
x = [0, 100]
y = [0, 10]
[[regions]]
name = "cap"
x = [0, 100]
y = [90, 100]
[[materials]]
region = "block"
youngs_modulus = 3604.0
fracture_energy = 0.001
[[materials]]
regions = ["base", "cap"]
youngs_modulus = 3604.0
fracture_energy = "infinite"
[[supports]]
region = "base"
fix = ["x", "y"]
)" + loading + more,
                                "test"));
}

const std::string driven = "[[displacements]]\nregion = \"cap\"\ny = 1.0\n";
const std::string pulled = "[[loads]]\nregion = \"cap\"\nforce = [0, 100]\n";
const std::string weight = "[[loads]]\nregion = \"block\"\nbody_force = [0, 0.5]\n";

/// Springs on a displaced side, at a loaded one, and as the only support in x.
const std::string springs =
    "[[springs]]\nregion = \"cap\"\ntotal = [50, 200]\n"
    "[[springs]]\nregion = \"surface\"\nstiffness = [0.5, 0]\n";

/// Stores rows and, on request, the state at every row, as field output does.
struct RowRecorder final : StepObserver {
  explicit RowRecorder(bool look_at_state = false) : look(look_at_state) {}
  void on_step(const StepRecord& record, StateSource& source) override {
    rows.push_back(record);
    if (look) {
      EXPECT_FALSE(source.state().displacement.empty());
    }
  }
  bool look;
  std::vector<StepRecord> rows;
};

DamageResult run_rows(const Model& model, const DamageOptions& options, RowRecorder& recorder) {
  return run_damage_analysis(model, options, recorder);
}

class LoadKind : public testing::TestWithParam<std::string> {};

TEST_P(LoadKind, FirstRowIsTheElasticAnswerAndEnergyBalances) {
  const Model model = block(GetParam());
  const ElasticResult elastic = run_elastic_analysis(model);
  RowRecorder recorder;
  DamageOptions options;
  options.stop.broken_bonds = 60;

  const DamageResult result = run_rows(model, options, recorder);

  const StepRecord& first = recorder.rows.front();
  const double expected = first.load_factor * first.load_factor * elastic.strain_energy;
  EXPECT_NEAR(first.strain_energy, expected, 1e-10 * expected);  // two solutions of one system
  EXPECT_NEAR(first.external_work, expected, 1e-10 * expected);
  EXPECT_LT(result.energy_error, 1e-9);  // error allowed in every history
  EXPECT_GE(result.broken_bonds, 60);
}

TEST_P(LoadKind, LookingAtTheStateChangesNoRow) {
  const Model model = block(GetParam());
  DamageOptions options;
  options.stop.broken_bonds = 40;
  RowRecorder blind, watching(true);

  run_rows(model, options, blind);
  run_rows(model, options, watching);

  ASSERT_EQ(blind.rows.size(), watching.rows.size());
  for (std::size_t k = 0; k < blind.rows.size(); ++k) {
    EXPECT_EQ(blind.rows[k].element, watching.rows[k].element);
    EXPECT_EQ(blind.rows[k].load_factor, watching.rows[k].load_factor);
    EXPECT_EQ(blind.rows[k].displacement, watching.rows[k].displacement);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LoadKind,
                         testing::Values(driven, pulled, driven + weight, pulled + weight,
                                         driven + springs, pulled + springs));

/// A block on springs much softer than its bonds is a rigid body on its foundation.
TEST(ElasticSupports, CarryTheWholeLoad) {
  const std::string free = R"(
[body]
columns = 5
horizon_ratio = 2.0
[[regions]]
name = "block"
x = [0, 1]
y = [0, 1]
[[regions]]
name = "bottom"
x = [0, 1]
y = [0, 0]
[[materials]]
region = "block"
youngs_modulus = 1e9
fracture_energy = "infinite"
[[springs]]
region = "bottom"
stiffness = [5, 20]
[[tractions]]
region = "bottom"
traction = [1, "3*x"]
[analysis]
type = "elastic"
)";
  const Model model = build_model(parse_case(free, "test"));
  const ElasticResult elastic = run_elastic_analysis(model);
  // Along x: force 1 on stiffness 5. Along y: force 3/2 on 20. The force 3 x and the uniform force
  // along x at y = 0 have the couple 1/4 about the centre of the springs, the integral of 3 x (x -
  // 1/2). It acts on the lumped second moment of the springs, 20 (1/12 + h^2 / 6) with h = 1/4.
  const double turn = 0.25 / (20.0 * (1.0 / 12.0 + 1.0 / 96.0));
  for (Index i = 0; i < 5; ++i) {
    const double x = model.network.particles.position(i)[0];
    // The bonds are 1e7 times as stiff as the springs.
    EXPECT_NEAR(elastic.displacement[2 * i], 0.2, 1e-6);
    EXPECT_NEAR(elastic.displacement[2 * i + 1], 0.075 + turn * (x - 0.5), 1e-6);
  }
}

/// Returns a narrow micropolar body, fixed below and rotated above by `loading`.
Model column(const std::string& loading) {
  return build_model(parse_case(R"(
[body]
model = "micropolar"
columns = 5
horizon_ratio = 2.0
[[regions]]
name = "column"
x = [0, 1]
y = [0, 2]
[[regions]]
name = "rim"
x = [0, 1]
y = [0, 0]
[[regions]]
name = "corner"
x = [1, 1]
y = [2, 2]
[[materials]]
region = "column"
youngs_modulus = 10
poissons_ratio = 0.1
fracture_energy = "infinite"
[analysis]
type = "elastic"
)" + loading,
                                "test"));
}

TEST(DrivenRotation, ABodyTurnedAsAWholeStaysWithoutStress) {
  const Model model = column(
      "[[displacements]]\nregion = \"rim\"\nx = \"-0.1*y\"\n"
      "y = \"0.1*x\"\nrotation = 0.1\n");
  const ElasticResult elastic = run_elastic_analysis(model);
  EXPECT_NEAR(elastic.strain_energy, 0.0, 1e-25);  // the square of round-off, stiffness 10
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    EXPECT_NEAR(elastic.displacement[3 * i], -0.1 * x[1], 1e-12);
    EXPECT_NEAR(elastic.displacement[3 * i + 1], 0.1 * x[0], 1e-12);
    EXPECT_NEAR(elastic.displacement[3 * i + 2], 0.1, 1e-12);
  }
}

/// The reaction moment of a prescribed rotation causes that rotation when applied as a load.
TEST(DrivenRotation, NeedsTheMomentThatMakesIt) {
  const std::string held = "[[supports]]\nregion = \"rim\"\nfix = [\"x\", \"y\", \"rotation\"]\n";
  const Model turned = column(held + "[[point_loads]]\nat = [1, 2]\nmoment = 0.3\n");
  const ElasticResult by_moment = run_elastic_analysis(turned);
  const Index corner = turned.network.particles.size() - 1;
  const double angle = by_moment.displacement[3 * corner + 2];
  ASSERT_GT(angle, 0.0);
  const Model moved =
      column(held + fmt::format("[[displacements]]\nregion = \"corner\"\nrotation = {}\n", angle));
  const ElasticResult by_angle = run_elastic_analysis(moved);
  EXPECT_TRUE(moved.reference.driven);
  EXPECT_EQ(moved.reference.value, angle);
  // Two solutions of systems with condition numbers near 1e3.
  EXPECT_NEAR(2.0 * by_angle.strain_energy / angle, 0.3, 1e-12);
  for (std::size_t slot = 0; slot < by_angle.displacement.size(); ++slot) {
    EXPECT_NEAR(by_angle.displacement[slot], by_moment.displacement[slot], 1e-12 * angle);
  }
}

TEST(DrivenBody, ItsDisplacementIsTheDrivenOne) {
  for (const std::string& loading : {driven, driven + weight}) {
    const Model model = block(loading);
    RowRecorder recorder;
    DamageOptions options;
    options.stop.broken_bonds = 20;
    run_rows(model, options, recorder);
    for (const StepRecord& row : recorder.rows) {
      EXPECT_DOUBLE_EQ(row.displacement, row.load_factor);  // displacement 1 at load factor 1
    }
  }
}

TEST(DrivenBody, LoadFractionLooksAtTheLoad) {
  const Model model = block(driven);
  RowRecorder recorder;
  DamageOptions options;
  options.stop.load_fraction = 0.5;

  const DamageResult result = run_rows(model, options, recorder);

  ASSERT_EQ(result.termination, Termination::completed);
  // The last ten consecutive rows are below the limit, the row before them is not.
  const std::size_t count = recorder.rows.size();
  ASSERT_GT(count, 10u);
  for (std::size_t k = count - 10; k < count; ++k) {
    EXPECT_LT(recorder.rows[k].load, 0.5 * result.peak_load);
  }
  EXPECT_GE(recorder.rows[count - 11].load, 0.5 * result.peak_load);
}

TEST(LoadSteps, StopWithinAStepAtTheNumberOfBrokenBonds) {
  const Model model = block(driven);
  RowRecorder recorder;
  DamageOptions options;
  options.load_factors = {1.0};  // far beyond the strength of the body
  options.stop.broken_bonds = 25;

  const DamageResult result = run_rows(model, options, recorder);

  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_EQ(result.broken_bonds, 25);
}

TEST(YieldingBar, EndsAsAPlasticMechanism) {
  const Model model = block(pulled,
                            "[[rebar]]\nfrom = [50, 0]\nto = [50, 100]\nyoungs_modulus = 29000.0\n"
                            "area = 0.05\nyield_strength = 60.0\n");
  RowRecorder recorder;

  const DamageResult result = run_rows(model, DamageOptions{}, recorder);

  EXPECT_EQ(result.termination, Termination::collapsed) << result.reason;
  EXPECT_LT(result.largest_residual, 1e-6);
}

}  // namespace
}  // namespace perilink
