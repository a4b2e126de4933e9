#pragma once

namespace perilink {

/// Method by which a factor follows the removal of a bond.
enum class FactorRoute {
  in_place,        ///< LDL' downdate on the supernodal pattern
  cholmod_updown,  ///< CHOLMOD's simplicial update and downdate, the reference of the tests
  refactorize,     ///< numerical factorisation of the changed matrix, the standard of comparison
};

}  // namespace perilink
