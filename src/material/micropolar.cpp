#include "material/micropolar.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "material/micromodulus.hpp"

namespace perilink {
namespace {

constexpr double pi = std::numbers::pi;

void require_ratio(double poissons_ratio, double largest) {
  // At the limit the bending modulus is zero; allow round-off.
  if (poissons_ratio > -1.0 && poissons_ratio <= largest + 1e-12) return;
  throw std::invalid_argument("micropolar bonds have Poisson's ratios above -1 and up to " +
                              std::to_string(largest) + ", not " + std::to_string(poissons_ratio));
}

/// Returns the rest of the modulus for bending. At the limit of Poisson's ratio it is round-off;
/// such bending stiffness would leave rotations unresisted, so it becomes zero.
double above_round_off(double rest, double youngs_modulus) {
  return rest > 1e-12 * youngs_modulus ? rest : 0.0;
}

}  // namespace

MicropolarModuli continuum_micropolar(Problem problem, const ElasticConstants& elastic,
                                      double horizon, double thickness) {
  const double E = elastic.youngs_modulus;
  const double nu = elastic.poissons_ratio;
  require_ratio(nu, bond_poissons_ratio(problem));
  const double square = horizon * horizon;
  if (problem == Problem::plane_stress) {
    return {6.0 * E / (pi * square * horizon * (1.0 - nu) * thickness),
            above_round_off(E * (1.0 - 3.0 * nu), E) /
                (6.0 * pi * horizon * (1.0 - nu * nu) * thickness)};
  }
  const double shear = above_round_off(E * (1.0 - 4.0 * nu), E) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  if (problem == Problem::plane_strain) {
    return {6.0 * E / (pi * square * horizon * (1.0 + nu) * (1.0 - 2.0 * nu) * thickness),
            shear / (6.0 * pi * horizon * thickness)};
  }
  return {6.0 * E / (pi * square * square * (1.0 - 2.0 * nu)), shear / (4.0 * pi * square)};
}

MicropolarModuli lattice_micropolar(Problem problem, std::span<const Vector3> offsets,
                                    double cell_volume, const ElasticConstants& elastic) {
  const double E = elastic.youngs_modulus;
  const double nu = elastic.poissons_ratio;
  require_ratio(nu, lattice_moduli(problem, offsets, cell_volume).poissons_ratio);
  double biaxial = 0.0;     // U1, in three dimensions the hydrostatic energy
  double shear = 0.0;       // U2
  double bending = 0.0;     // U3
  double reciprocal = 0.0;  // sum 1 / xi
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    const double cos_double = (xi[0] * xi[0] - xi[1] * xi[1]) / (length * length);
    biaxial += 0.25 * length;
    shear += 0.25 * length * cos_double * cos_double;
    bending += 3.0 / length * (1.0 - cos_double * cos_double);
    reciprocal += 1.0 / length;
  }
  if (problem == Problem::three_dimensional) {
    const double c = 1.5 * E / (1.0 - 2.0 * nu) / (cell_volume * biaxial);
    const double rest = 0.5 * E / (1.0 + nu) - 2.0 * c * cell_volume * biaxial / 15.0;
    return {c, above_round_off(rest, E) / (0.6 * cell_volume * reciprocal)};
  }
  const double energy =
      problem == Problem::plane_stress ? E / (1.0 - nu) : E / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double c = energy / (cell_volume * biaxial);
  const double rest = above_round_off(E / (1.0 + nu) - c * cell_volume * shear, E);
  if (rest == 0.0) return {c, 0.0};
  if (!(bending > 0.0)) {
    throw std::invalid_argument(
        "the horizon encloses too few particles: bonds along the axes do not bend in shear");
  }
  return {c, rest / (cell_volume * bending)};
}

}  // namespace perilink
