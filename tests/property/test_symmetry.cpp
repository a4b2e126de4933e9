#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

/// \file
/// Symmetry planes of calibrated bodies. Bonds near the plane act as in a body that ends there, and
/// the plane's reactions replace the other half.

namespace perilink {
namespace {

struct SymmetricBody {
  std::string name;
  std::string body;  ///< keys of [body]
  std::string nu;    ///< Poisson's ratio, as in the case
  int dim = 2;
};

std::ostream& operator<<(std::ostream& out, const SymmetricBody& body) { return out << body.name; }

/// Returns a quarter or eighth of a bar with tension 3 along y.
Model symmetric_bar(const SymmetricBody& tested) {
  const bool space = tested.dim == 3;
  const std::string depth = space ? "z = [0, 1]\n" : "";
  return build_model(parse_case(
      fmt::format(
          "[body]\nsurface = \"calibrated\"\n{}\n"
          "[[regions]]\nname = \"bar\"\nx = [0, 1]\ny = [0, 1]\n{}"
          "[[regions]]\nname = \"top\"\nx = [0, 1]\ny = [1, 1]\n{}"
          "[[materials]]\nregion = \"bar\"\nyoungs_modulus = 30\npoissons_ratio = {}\n"
          "fracture_energy = \"infinite\"\n[[symmetry]]\naxis = \"x\"\nat = 0\n"
          "[[symmetry]]\naxis = \"y\"\nat = 0\n{}"
          "[[tractions]]\nregion = \"top\"\ntraction = {}\n[analysis]\ntype = \"elastic\"\n",
          tested.body, depth, depth, tested.nu, space ? "[[symmetry]]\naxis = \"z\"\nat = 0\n" : "",
          space ? "[0, 3, 0]" : "[0, 3]"),
      "symmetric.toml"));
}

class Symmetry : public testing::TestWithParam<SymmetricBody> {};

TEST_P(Symmetry, PlanesHoldUniformTension) {
  const SymmetricBody& tested = GetParam();
  const Model model = symmetric_bar(tested);
  const ElasticResult elastic = run_elastic_analysis(model);
  const double nu = tested.nu == "0.3333333333333333" ? 1.0 / 3.0 : std::stod(tested.nu);
  const int width = model.network.width();
  const double bar = 1e-8;  // tolerance of the patch tests of calibrated bonds
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    for (int a = 0; a < tested.dim; ++a) {
      const double exact = (a == 1 ? 0.1 : -0.1 * nu) * x[a];
      ASSERT_NEAR(elastic.displacement[static_cast<std::size_t>(i) * width + a], exact, bar)
          << "particle " << i << " along "
          << "xyz"[a];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Symmetry,
    testing::Values(
        SymmetricBody{"rectangular", "spacing = 0.125\nhorizon_ratio = 3", "0.3333333333333333"},
        SymmetricBody{"hexagonal", "pattern = \"hexagonal\"\nspacing = 0.125\nhorizon_ratio = 3",
                      "0.3333333333333333"},
        SymmetricBody{"micropolar", "model = \"micropolar\"\nspacing = 0.125\nhorizon_ratio = 3",
                      "0.2"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace perilink
