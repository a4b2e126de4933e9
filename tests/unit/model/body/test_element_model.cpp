#include "model/body/element_model.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "app/run/quasistatic.hpp"
#include "io/case/case_overrides.hpp"
#include "results/field_file.hpp"
#include "support/program_cases.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

CaseFile elements(const char* text, const std::string& more = "") {
  return parse_case(text + more, "case.toml", {body_key("method", std::string("linear_elements"))});
}

TEST(ElementModel, EdgesStandForTheCells) {
  const Model model = build_model(elements(test::tension_strip_case));
  ASSERT_TRUE(model.elements.has_value());
  EXPECT_EQ(model.elements->cells.size(), 8 * 4 * 2);
  // Euler: vertices - edges + triangles = 1 for a plate without holes.
  EXPECT_EQ(
      model.network.particles.size() - model.network.num_elements() + model.elements->cells.size(),
      1);
}

TEST(ElementModel, VolumesAndFacetsAreThoseOfTheElements) {
  const Model model = build_model(elements(test::prism_text, "[analysis]\ntype = \"elastic\"\n"));
  const std::vector<double>& volumes = model.network.particles.volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), 0.4 * 0.4 * 0.8, 1e-14);
  EXPECT_EQ(model.facets.corners.row(0).size(), 3u) << "triangles, not the lattice's squares";
}

/// The strip is stretched by 0.02 at E = 100 and contracts freely, so it stores
/// 100 * 0.02^2 / 2 * 2 = 0.04 for every Poisson's ratio.
TEST(ElementModel, SolvesTheStripExactly) {
  for (const char* ratio : {"-0.5", "0.2", "0.45"}) {
    std::string text = test::tension_strip_case;
    const std::string key = "youngs_modulus = 100";
    text.replace(text.find(key), key.size(), key + "\npoissons_ratio = " + ratio);
    const CaseFile input = elements(text.c_str());
    const Model model = build_model(input);
    const ElasticAnswer answer = solve_elastic(model, {});
    EXPECT_NEAR(answer.solution.strain_energy, 0.04, 1e-14);
    for (Index i = 0; i < model.network.particles.size(); ++i) {
      const auto x = model.network.particles.position(i);
      EXPECT_NEAR(answer.solution.displacement[2 * i], 0.02 * x[0], 1e-14);
      EXPECT_NEAR(answer.solution.displacement[2 * i + 1], -0.02 * std::stod(ratio) * x[1], 1e-14);
    }
  }
}

TEST(ElementModel, WithoutARatioItIsThatOfBonds) {
  const Model model = build_model(elements(test::tension_strip_case));
  // E / (2 (1 + 1/3)) in plane stress
  EXPECT_DOUBLE_EQ(model.elements->mu[0], 37.5);
}

TEST(ElementModel, FreeRigidModesAreRefused) {
  std::string text = test::tension_strip_case;
  text.erase(text.find("[[supports]]\nregion = \"corner\""), 46);
  EXPECT_THROW(build_model(elements(text.c_str())), InputError) << "free along y";
}

TEST(ElementModel, FieldsOfTheStripAreUniform) {
  const CaseFile input = elements(test::tension_strip_case);
  const Model model = build_model(input);
  const ElasticAnswer answer = solve_elastic(model, {});
  const VtuGrid grid =
      make_element_grid(*model.elements, model.network.particles, answer.solution.displacement,
                        {1, 0, 1.0, answer.row.load, 0.25});
  const std::size_t particles = model.network.particles.volumes.size();
  ASSERT_EQ(grid.types.size(), particles + model.elements->volumes.size());
  EXPECT_EQ(grid.types.back(), VtuCell::triangle);
  const VtuArray* stress = grid.find_cell_data("principal_stress");
  ASSERT_NE(stress, nullptr);
  for (std::size_t cell = particles; cell < grid.types.size(); ++cell) {
    EXPECT_NEAR(stress->values[3 * cell], 2.0, 1e-11);  // 100 * 0.02
    EXPECT_NEAR(stress->values[3 * cell + 1], 0.0, 1e-11);
  }
  for (std::size_t i = 0; i < particles; ++i) {
    EXPECT_NEAR(grid.find_point_data("principal_strain")->values[3 * i], 0.02, 1e-13);
    EXPECT_NEAR(grid.find_point_data("strain_energy_density")->values[i], 0.02, 1e-13);
  }
}

}  // namespace
}  // namespace perilink
