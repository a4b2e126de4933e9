#include "bar.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

constexpr double gauge_length = 2.0;
constexpr double youngs_modulus = 30.0;
constexpr double stress = 0.03;

/// Between the gauge and either end the disturbance by the load decays.
double length_of(const BarInput& bar) {
  return gauge_length + 2.0 * std::ceil(2.0 * bar.width + 2.0);
}

std::string case_of(const BarInput& bar) {
  const char* surface = bar.surface == Surface::calibrated ? "calibrated" : "none";
  return fmt::format(R"(
[body]
model = "micropolar"
surface = "{6}"
spacing = {0}
horizon_ratio = {1}

[[regions]]
name = "bar"
x = [0, {2}]
y = [0, {3}]

[[regions]]
name = "left"
x = [0, 0]
y = [0, {3}]

[[regions]]
name = "right"
x = [{2}, {2}]
y = [0, {3}]

[[materials]]
region = "bar"
youngs_modulus = {4}
poissons_ratio = {5}
fracture_energy = "infinite"

[[tractions]]
region = "left"
traction = [-{7}, 0]

[[tractions]]
region = "right"
traction = [{7}, 0]

[analysis]
type = "elastic"
rigid_body_modes = "pin"
)",
                     1.0 / bar.horizon_ratio, bar.horizon_ratio, length_of(bar), bar.width,
                     youngs_modulus, bar.poissons_ratio, surface, stress);
}

/// Mean displacement along the bar of the particles at x.
double mean_displacement(const Network& network, std::span<const double> motion, double x,
                         double spacing) {
  const Particles& particles = network.particles;
  double sum = 0.0, volume = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    if (std::abs(particles.position(i)[0] - x) > 0.1 * spacing) continue;
    sum += particles.volumes[i] * motion[static_cast<std::size_t>(i) * network.width()];
    volume += particles.volumes[i];
  }
  return sum / volume;
}

}  // namespace

double apparent_modulus(const BarInput& input) {
  const Model model = build_model(parse_case(case_of(input), "bar.toml"));
  const ElasticResult result = run_elastic_analysis(model);
  const double middle = 0.5 * length_of(input), spacing = model.lattice.spacing;
  const auto at = [&](double x) {
    return mean_displacement(model.network, result.displacement, x, spacing);
  };
  const double strain =
      (at(middle + 0.5 * gauge_length) - at(middle - 0.5 * gauge_length)) / gauge_length;
  return stress / strain / youngs_modulus;
}

}  // namespace perilink::verification
