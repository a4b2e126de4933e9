// Double cantilevers that are glued together open along the glue at the load of beam theory.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/from_case/configure.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double arm_modulus = 30000.0, arm = 22.5, length = 120.0, fracture_energy = 0.1;

/// Returns two arms with a crack between them up to x = 50, displaced apart at x = 0. The glue has
/// the strength 12; the arms have twice that and ten times the energy.
std::string cantilever_case(const std::string& model) {
  const std::string ratio = model == "micropolar" ? "poissons_ratio = 0.2\n" : "";
  std::string text = fmt::format(
      "[body]\nproblem = \"plane_stress\"\nmodel = \"{}\"\nspacing = 3\nhorizon_ratio = 3\n",
      model);
  const auto region = [&](const char* name, double from, double to, double below, double above) {
    text += fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, from, to,
                        below, above);
  };
  region("lower", 0, length, 0, arm);
  region("upper", 0, length, arm, 2 * arm);
  region("lower load", 0, 0, 0, 0);
  region("upper load", 0, 0, 2 * arm, 2 * arm);
  region("lower pad", 0, 15, 0, 6);
  region("upper pad", 0, 15, 2 * arm - 6, 2 * arm);
  region("end", length, length, 0, 0);
  text += fmt::format(
      "[[materials]]\nregions = [\"lower\", \"upper\"]\nyoungs_modulus = {0}\n"
      "fracture_energy = {1}\ntensile_strength = 24\n{2}"
      "[[materials]]\nregions = [\"lower pad\", \"upper pad\"]\nyoungs_modulus = {0}\n"
      "fracture_energy = \"infinite\"\n{2}",
      arm_modulus, 10.0 * fracture_energy, ratio);
  text += fmt::format(
      "[[interfaces]]\nbetween = [\"lower\", \"upper\"]\nfracture_energy = {}\n"
      "tensile_strength = 12\nsoftening = \"linear\"\n"
      "[[cracks]]\npoints = [[-1, {}], [50, {}]]\n",
      fracture_energy, arm, arm);
  return text +
         "[[supports]]\nregion = \"end\"\nfix = [\"x\", \"y\"]\n"
         "[[displacements]]\nregion = \"upper load\"\ny = 0.3\n"
         "[[displacements]]\nregion = \"lower load\"\ny = -0.3\n[stop]\nload_fraction = 0.6\n";
}

std::vector<double> values_of(const CsvTable& table, const std::string& name) {
  const auto column = static_cast<std::size_t>(table.column(name));
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(row.at(column));
  return values;
}

class WeakCantilevers : public testing::TestWithParam<const char*> {};

TEST_P(WeakCantilevers, OpenAlongTheInterfaceAtTheLoadOfBeamTheory) {
  const CaseFile input = parse_case(cantilever_case(GetParam()), "");
  const Network network = build_model(input).network;
  const CsvTable history = WholeRun(input).history();
  const std::vector<double> load = values_of(history, "load");
  const std::vector<double> opening = values_of(history, "displacement");
  const std::vector<double> element = values_of(history, "element");
  const double limit = network.report.interfaces.at(0).strength.first_stretch;
  // G = 12 P^2 L^2 / (E h^3), and the opening is 8 P L^3 / (E h^3). L is the crack length plus the
  // effect of rotation at the roots of the arms. Without L: P^2 = 8 (G E h^3 / 12)^(3/2) / (E h^3
  // opening).
  const double stiffness = arm_modulus * std::pow(arm, 3);
  const double scale = 8.0 * std::pow(fracture_energy * stiffness / 12.0, 1.5) / stiffness;
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < load.size(); ++k) {
    if (element[k] >= 0.0) {
      ASSERT_EQ(network.critical_stretch.at(static_cast<std::size_t>(element[k])), limit)
          << "a bond softens that does not cross the interface";
    }
    if (k < load.size() / 4 || k >= 3 * load.size() / 4) continue;
    sum += load[k] / std::sqrt(scale / opening[k]);
    ++count;
  }
  EXPECT_NEAR(sum / count, 1.0, 0.03);  // segments, and shear of the arms
}

INSTANTIATE_TEST_SUITE_P(Models, WeakCantilevers, testing::Values("bond_based", "micropolar"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace perilink
