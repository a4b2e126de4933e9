#include "app/fracture_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/crack_cost.hpp"

namespace perilink {

std::vector<double> count_on_the_path(const CaseFile& input, const Body& body,
                                      NetworkInput& network) {
  std::vector<double> costs;
  if (input.body.critical_stretch != "dissipated") return costs;
  for (SolidMaterial& material : network.materials) {
    costs.push_back(crack_cost(body, network, material));
    material.fracture_energy /= costs.back();
  }
  return costs;
}

std::optional<std::string> short_horizon_note(const CaseFile& input, const Model& model) {
  const double ratio = model.horizon / model.lattice.spacing;
  const auto breakable = [](double limit) { return std::isfinite(limit); };
  const std::vector<double>& limits = model.network.critical_stretch;
  if (input.analysis.type == "elastic" || ratio > least_ratio_of_cracks - 1e-6 ||
      std::none_of(limits.begin(), limits.end(), breakable)) {
    return std::nullopt;
  }
  return fmt::format(
      "the horizon is {:.3g} spacings: below 3, what a crack dissipates per area differs by 10 % "
      "and more from one path to another; take horizon_ratio = 3 or more where bonds break",
      ratio);
}

}  // namespace perilink
