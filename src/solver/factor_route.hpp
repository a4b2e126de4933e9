#pragma once

namespace perilink {

/// How a factor follows the removal of a bond.
enum class FactorRoute {
  in_place,        ///< our LDL' downdate on the supernodal pattern
  cholmod_updown,  ///< CHOLMOD's simplicial update/downdate, the reference of the tests
  refactorize,     ///< numerical factorisation from the changed matrix, the yardstick
};

}  // namespace perilink
