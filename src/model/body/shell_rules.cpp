#include "model/body/shell_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Refuses shells of bonds without bending stiffness, in which particles rotate freely about the
/// normal of the mid-surface.
void refuse_turning_particles(const CaseFile& input, const Body& body, const NetworkInput& network,
                              std::size_t material) {
  SolidMaterial without = network.materials[material];
  const double left = moduli_of(body, network, without).bending_modulus;
  without.poissons_ratio = 0.0;
  if (left > 1e-3 * moduli_of(body, network, without).bending_modulus) return;
  throw InputError(input.where(item_key("materials", material, "poissons_ratio")),
                   fmt::format("is {}, the ratio of bonds without shear stiffness: particles of a "
                               "shell would rotate freely about the normal of the mid-surface",
                               network.materials[material].poissons_ratio),
                   "give a smaller one; shells have ratios above -1 and below 1/3");
}

void refuse_overlapping_mid_surface(const CaseFile& input, const Body& body) {
  if (!input.body.radius) return;
  double lower = INFINITY, upper = -INFINITY;
  for (Index i = 0; i < body.particles.size(); ++i) {
    lower = std::min(lower, body.particles.position(i)[0]);
    upper = std::max(upper, body.particles.position(i)[0]);
  }
  const double around = 2.0 * std::numbers::pi * *input.body.radius;
  if (upper - lower < around) return;
  throw InputError(
      input.where("body.radius"),
      fmt::format("is {}, so that the circumference of the cylinder is {:.6g}, but the "
                  "mid-surface is {:.6g} long in x",
                  *input.body.radius, around, upper - lower),
      "enlarge the radius or shorten the mid-surface");
}

/// Refuses planes of symmetry off the top of a cylinder, where the x axis is not tangential to the
/// mid-surface.
void refuse_slanting_symmetry(const CaseFile& input) {
  if (!input.body.radius) return;
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    const SymmetrySection& section = input.symmetry[k];
    if (section.axis != 0 || (section.at && *section.at == 0.0)) continue;
    throw InputError(input.where(item_key("symmetry", k)),
                     "is a plane of symmetry of a cylinder away from its top, x = 0",
                     "let the mid-surface begin at x = 0, or give [[supports]]");
  }
}

}  // namespace

void refuse_impossible_shell(const CaseFile& input, const Body& body, const NetworkInput& network) {
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    refuse_turning_particles(input, body, network, m);
  }
  refuse_overlapping_mid_surface(input, body);
  refuse_slanting_symmetry(input);
}

}  // namespace perilink
