#include "material/states/state_moduli.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace perilink {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;

void check_ratio(double nu) {
  if (nu > -1.0 && nu < 0.5) return;
  throw std::invalid_argument(
      fmt::format("Poisson's ratio {} is outside the range of solids, -1 to 1/2", nu));
}

}  // namespace

StateModuli hexagonal_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                             double spacing, double thickness) {
  const double nu = poissons_ratio;
  check_ratio(nu);
  if (problem == Problem::three_dimensional) {
    throw std::invalid_argument("a hexagonal lattice fills the plane, not space");
  }
  const double scale = youngs_modulus * spacing * thickness / sqrt3;
  const double sum = problem == Problem::plane_stress
                         ? (1.0 - 3.0 * nu) / (6.0 * (nu * nu - 1.0))
                         : (1.0 - 4.0 * nu) / (6.0 * (2.0 * nu - 1.0) * (1.0 + nu));
  return {2.0 * scale / (1.0 + nu), 0.0, scale * sum};
}

StateModuli face_centred_moduli(double youngs_modulus, double poissons_ratio, double spacing) {
  const double nu = poissons_ratio;
  check_ratio(nu);
  const double scale = youngs_modulus * spacing * spacing;
  const double own = scale / (sqrt2 * (1.0 + nu));
  return {own, (1.0 / (2.0 * sqrt2) - 1.0) * own,
          scale * (3.0 * sqrt2 - 4.0) * (1.0 - 4.0 * nu) / (16.0 * (1.0 + nu) * (2.0 * nu - 1.0))};
}

}  // namespace perilink
