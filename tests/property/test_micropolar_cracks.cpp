// Cracks of micropolar bodies on irregular meshes: bonds break only at the crack.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

namespace perilink {
namespace {

/// Returns a plate [-3, 3]^2 with a hole of radius 1 around the origin in tension along x. It
/// splits along x = 0. The mesh is three times finer at the hole.
std::string pulled_plate(double poissons_ratio) {
  return R"([body]
mesh = "full_plate_with_hole.msh"
horizon_ratio = 3
model = "micropolar"

[[regions]]
name = "plate"
group = "plate"

[[regions]]
name = "left side"
group = "left"

[[regions]]
name = "right side"
group = "right"

[[materials]]
region = "plate"
youngs_modulus = 30e3
fracture_energy = 0.1
poissons_ratio = )" +
         std::to_string(poissons_ratio) + R"(

[[tractions]]
region = "right side"
traction = [5, 0]

[[tractions]]
region = "left side"
traction = [-5, 0]

[analysis]
rigid_body_modes = "pin"

[stop]
load_fraction = 0.3
)";
}

class CrackRecorder final : public StepObserver {
 public:
  void on_step(const StepRecord& record, StateSource&) override { rows.push_back(record); }
  std::vector<StepRecord> rows;
};

class PulledPlate : public testing::TestWithParam<double> {};

TEST_P(PulledPlate, BreaksAcrossTheHoleOnly) {
  const CaseFile input =
      parse_case(pulled_plate(GetParam()), PERILINK_SOURCE_DIR "/meshes/plate.toml");
  const Model model = build_model(input);
  ASSERT_LT(model.network.report.calibration->smallest_weight, 0.1);
  CrackRecorder recorder;
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), recorder);
  const auto peak =
      std::max_element(recorder.rows.begin(), recorder.rows.end(),
                       [](const StepRecord& a, const StepRecord& b) { return a.load < b.load; });
  ASSERT_GT(peak->step, 10);
  ASSERT_LT(recorder.rows.back().load, 0.3 * peak->load);
  const Bonds& bonds = model.network.bonds;
  for (const StepRecord& row : recorder.rows) {
    const double x = 0.5 * (model.network.particles.position(bonds.first[row.element])[0] +
                            model.network.particles.position(bonds.second[row.element])[0]);
    EXPECT_LT(std::abs(x), model.horizon) << "row " << row.step << " of " << result.broken_bonds;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, PulledPlate, testing::Values(0.0, 0.2, 0.3));

}  // namespace
}  // namespace perilink
