#include "app/model/body/shell_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Without bending stiffness nothing keeps particles of a shell from turning within the sheet.
void refuse_turning_particles(const CaseFile& input, const Body& body, const NetworkInput& network,
                              std::size_t material) {
  SolidMaterial without = network.materials[material];
  const double left = moduli_of(body, network, without).bending_modulus;
  without.poissons_ratio = 0.0;
  if (left > 1e-3 * moduli_of(body, network, without).bending_modulus) return;
  throw InputError(input.where(item_key("materials", material, "poissons_ratio")),
                   fmt::format("is {}, that of bonds which resist no shear: the particles of a "
                               "shell would turn freely within the sheet",
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
  throw InputError(input.where("body.radius"),
                   fmt::format("is {}, so that the cylinder is {:.6g} around, but the sheet is "
                               "{:.6g} long in x",
                               *input.body.radius, around, upper - lower),
                   "enlarge the radius or shorten the sheet");
}

/// Off its top the axis x is not along the sheet of a cylinder.
void refuse_slanting_symmetry(const CaseFile& input) {
  if (!input.body.radius) return;
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    const SymmetrySection& section = input.symmetry[k];
    if (section.axis != 0 || (section.at && *section.at == 0.0)) continue;
    throw InputError(input.where(item_key("symmetry", k)),
                     "is a plane across the sheet of a cylinder elsewhere than at its top, x = 0",
                     "let the sheet begin at x = 0, or give [[supports]]");
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
