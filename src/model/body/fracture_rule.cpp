#include "model/body/fracture_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "network/crack_cost.hpp"

namespace perilink {
namespace {

/// Largest ratio of lattice steps for which the fracture-energy correction applies. It was measured
/// with equal steps.
constexpr double nearly_equal = 1.1;

bool bonds_can_break(const Network& network) {
  for (std::size_t e = 0; e < network.critical_stretch.size(); ++e) {
    if (network.can_break(static_cast<Index>(e))) return true;
  }
  return false;
}

/// Ratio of the longest to the shortest step of a lattice, each relative to the regular lattice.
double ratio_of_steps(const Lattice& lattice) {
  Vector3 steps = lattice.step;
  if (lattice.pattern == Pattern::hexagonal) steps[1] /= std::sqrt(0.75);
  const auto [least, most] = std::minmax_element(steps.begin(), steps.begin() + lattice.dim);
  return *most / *least;
}

}  // namespace

std::vector<double> count_on_the_path(const CaseFile& input, const Body& body,
                                      NetworkInput& network) {
  std::vector<double> costs;
  if (network.elastic || input.body.critical_stretch != CriticalStretch::dissipated ||
      !body.spans.empty()) {
    return costs;
  }
  for (SolidMaterial& material : network.materials) {
    // Softening bonds release no kinetic energy.
    const bool snaps = material.softening.shape.kind == Softening::brittle;
    costs.push_back(snaps ? crack_cost(body, network, material) : 1.0);
    material.fracture_energy /= costs.back();
  }
  for (WeakInterface& face : network.interfaces) {
    if (face.softening.shape.kind != Softening::brittle) continue;
    double sum = 0.0;
    for (const SolidMaterial& material : network.materials) {
      sum += crack_cost(body, network, material);
    }
    face.fracture_energy /= sum / static_cast<double>(network.materials.size());
  }
  return costs;
}

std::optional<std::string> short_horizon_note(const Model& model) {
  const double ratio = model.horizon / model.lattice.spacing;
  if (ratio > least_ratio_of_cracks - 1e-6 || model.network.is_beam() ||
      !bonds_can_break(model.network)) {
    return std::nullopt;
  }
  return fmt::format(
      "the horizon is {:.3g} spacings: below 3, the energy that a crack "
      "dissipates per area depends on its direction by 10 % and more; take "
      "horizon_ratio = 3 or more where bonds break",
      ratio);
}

std::optional<std::string> unmeasured_cost_note(const Model& model) {
  if (model.crack_cost.empty() || !bonds_can_break(model.network)) return std::nullopt;
  constexpr const char* what = "the fracture-energy correction was not measured";
  if (model.lattice.pattern != Pattern::irregular) {
    const double ratio = ratio_of_steps(model.lattice);
    if (ratio <= nearly_equal) return std::nullopt;
    return fmt::format(
        "{} on lattices like this one, whose steps differ by {:.0f} %: the "
        "correction for equal steps is used; choose a spacing that divides all "
        "sides of the body more evenly",
        what, 100.0 * (ratio - 1.0));
  }
  const Network& network = model.network;
  // Beside bars that bend, bonds of the solid have a bending stiffness of zero.
  const bool bends = network.carries_moments() && network.bending.front() > 0.0;
  if (network.dim() == 2 || network.shell || !bends) return std::nullopt;
  return fmt::format(
      "{} for three-dimensional unstructured particle sets with bending "
      "bonds: the correction for bonds without bending is used",
      what);
}

}  // namespace perilink
