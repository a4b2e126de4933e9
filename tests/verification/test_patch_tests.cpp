// The linear patch test with calibrated bonds: uniform strains are equilibria, under tractions and under
// prescribed displacements of the surface, on lattices and on meshes with holes, curves and re-entrant
// corners.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/elastic_analysis.hpp"
#include "app/configure.hpp"
#include "assembly/internal_force.hpp"
#include "io/case_file.hpp"

namespace perilink {
namespace {

struct PatchBody {
  std::string name;
  std::string keys;  ///< of [body]
  int dim = 2;
  std::string group = {};  ///< of meshes: the solid
};

std::ostream& operator<<(std::ostream& out, const PatchBody& body) { return out << body.name; }

/// E = 1; lattices fill a box of 1.5 by 1 (by 1).
Model model_of(const PatchBody& body, const std::string& loading) {
  const std::string region =
      !body.group.empty() ? fmt::format("group = \"{}\"\n", body.group)
                          : fmt::format("x = [0, 1.5]\ny = [0, 1]\n{}", body.dim == 3 ? "z = [0, 1]\n" : "");
  return build_model(parse_case(
      fmt::format("[body]\n{}\n[[regions]]\nname = \"solid\"\n{}[[materials]]\nregion = \"solid\"\n"
                  "youngs_modulus = 1\nfracture_energy = \"infinite\"\n{}"
                  "[analysis]\ntype = \"elastic\"\nrigid_body_modes = \"pin\"\n",
                  body.keys, region, loading),
      std::string(PERILINK_SOURCE_DIR) + "/meshes/patch.toml"));
}

class Patch : public testing::TestWithParam<PatchBody> {};

/// Pressure 1 all around: the stress is -1, the strain -(lambda dim + 2 mu)^-1 in all directions. What is
/// left on a particle, over the mean pull of a facet's corner. Calibration leaves 1e-10; the rest is
/// round-off of the sums.
TEST_P(Patch, PressureAllAroundIsBalanced) {
  const PatchBody& body = GetParam();
  const Model model = model_of(body, "[[tractions]]\nregion = \"surface\"\npressure = 1\n");
  ASSERT_TRUE(model.network.calibration.has_value());
  const double nu = body.dim == 3 ? 0.25 : 1.0 / 3.0;
  const double strain = body.dim == 3 ? -(1.0 - 2.0 * nu) : -(1.0 - nu);
  std::vector<double> motion = model.network.particles.positions;
  for (double& x : motion) x *= strain;
  const std::vector<double> intact(static_cast<std::size_t>(model.network.num_elements()), 1.0);
  const std::vector<double> forces = internal_force(model.network, intact, motion).forces;
  double largest = 0.0, pull = 0.0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    largest = std::max(largest, std::abs(forces[k] - model.loads.forces[k]));
    pull = std::max(pull, std::abs(model.loads.forces[k]));
  }
  EXPECT_LT(largest, 1e-9 * pull);
}

/// A strain with all components prescribed on the surface: the inside follows.
TEST_P(Patch, DisplacementsOfTheSurfaceReachTheInside) {
  const PatchBody& body = GetParam();
  const bool space = body.dim == 3;
  const Model model = model_of(
      body, fmt::format("[[displacements]]\nregion = \"surface\"\nx = \"0.01*x + 0.004*y{}\"\n"
                        "y = \"0.002*x - 0.007*y\"\n{}",
                        space ? " - 0.003*z" : "", space ? "z = \"0.001*x + 0.002*y + 0.005*z\"\n" : ""));
  const ElasticResult elastic = run_elastic_analysis(model.network, model.unknowns, model.loads, 1);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const auto x = model.network.particles.position(i);
    const double z = space ? x[2] : 0.0;
    const double exact[3] = {0.01 * x[0] + 0.004 * x[1] - 0.003 * z, 0.002 * x[0] - 0.007 * x[1],
                             0.001 * x[0] + 0.002 * x[1] + 0.005 * z};
    for (int a = 0; a < body.dim; ++a) {
      ASSERT_NEAR(elastic.displacement[i * body.dim + a], exact[a], 1e-10) << "particle " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Patch,
    testing::Values(
        PatchBody{"rectangular_2", "spacing = 0.05\nhorizon_ratio = 2"},
        PatchBody{"rectangular_3", "spacing = 0.05\nhorizon_ratio = 3"},
        PatchBody{"rectangular_4", "spacing = 0.05\nhorizon_ratio = 4"},
        PatchBody{"hexagonal_2", "pattern = \"hexagonal\"\nspacing = 0.05\nhorizon_ratio = 2"},
        PatchBody{"hexagonal_3", "pattern = \"hexagonal\"\nspacing = 0.05\nhorizon_ratio = 3"},
        PatchBody{"cubic", "problem = \"three_dimensional\"\nspacing = 0.125\nhorizon_ratio = 2", 3},
        PatchBody{"face_centred",
                  "problem = \"three_dimensional\"\npattern = \"face_centred\"\nspacing = 0.15\n"
                  "horizon_ratio = 2",
                  3},
        PatchBody{"plate_with_hole", "mesh = \"plate_with_hole.msh\"\nhorizon_ratio = 3", 2, "plate"},
        PatchBody{"disc", "mesh = \"disc.msh\"\nhorizon_ratio = 3", 2, "disc"},
        PatchBody{"l_shape", "mesh = \"l_shape.msh\"\nhorizon_ratio = 3", 2, "body"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace perilink
