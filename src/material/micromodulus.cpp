#include "material/micromodulus.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace perilink {

double continuum_micromodulus(Problem problem, double youngs_modulus, double horizon,
                              double thickness) {
  const double cube = horizon * horizon * horizon;
  switch (problem) {
    case Problem::plane_stress:
    case Problem::shell:
    case Problem::beam: return 9.0 * youngs_modulus / (std::numbers::pi * cube * thickness);
    case Problem::plane_strain:
      return 48.0 * youngs_modulus / (5.0 * std::numbers::pi * cube * thickness);
    case Problem::three_dimensional: break;
  }
  return 12.0 * youngs_modulus / (std::numbers::pi * cube * horizon);
}

LatticeModuli lattice_moduli(Problem problem, std::span<const Vector3> offsets,
                             double cell_volume) {
  double biaxial = 0.0;  // U1 = 1/4 sum xi; in three dimensions the hydrostatic energy
  double shear = 0.0;    // U2 = 1/4 sum xi cos^2(2 theta)
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    const double cos_double = (xi[0] * xi[0] - xi[1] * xi[1]) / (length * length);
    biaxial += 0.25 * length;
    shear += 0.25 * length * cos_double * cos_double;
  }
  if (!(biaxial > 0.0) || (problem != Problem::three_dimensional && !(shear > 0.0))) {
    throw std::invalid_argument("the horizon encloses too few particles to resist a shear strain");
  }
  // Energy density of the continuum at unit strain = c V times the sums.
  if (problem == Problem::plane_stress) {  // E / (1 - nu) and E / (1 + nu)
    return {(1.0 / biaxial + 1.0 / shear) / (2.0 * cell_volume),
            (biaxial - shear) / (biaxial + shear)};
  }
  if (problem == Problem::plane_strain) {  // E / ((1 + nu) (1 - 2 nu)) and E / (1 + nu)
    const double nu = 0.5 * (1.0 - shear / biaxial);
    return {1.0 / (cell_volume * shear * (1.0 + nu)), nu};
  }
  // With C_ijkl = (c V / 2) sum xi n_i n_j n_k n_l every contraction is A = C_iijj = C_ijij = 2 c V
  // U1. So K = A / 9, the Voigt mean is G = (3 C_ijij - C_iijj) / 30 = A / 15, and
  // 1 / E = 1 / (9 K) + 1 / (3 G) = 6 / A. Hence nu = 1/4 for every lattice.
  return {6.0 / (2.0 * cell_volume * biaxial), 0.25};
}

}  // namespace perilink
