#include "material/elasticity.hpp"

namespace perilink {

int dimension_of(Problem problem) { return problem == Problem::three_dimensional ? 3 : 2; }

double bond_poissons_ratio(Problem problem) {
  return problem == Problem::plane_stress ? 1.0 / 3.0 : 0.25;
}

}  // namespace perilink
