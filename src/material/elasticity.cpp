#include "material/elasticity.hpp"

namespace perilink {

int dimension_of(Problem problem) { return problem == Problem::three_dimensional ? 3 : 2; }

double bond_poissons_ratio(Problem problem) {
  const bool thin = problem == Problem::plane_stress || problem == Problem::shell;
  return thin ? 1.0 / 3.0 : 0.25;
}

HookeConstants hooke_constants(Problem problem, double youngs_modulus, double poissons_ratio) {
  const double e = youngs_modulus, nu = poissons_ratio;
  return {problem == Problem::plane_stress || problem == Problem::shell
              ? e * nu / (1.0 - nu * nu)
              : e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
          e / (2.0 * (1.0 + nu))};
}

}  // namespace perilink
