#pragma once

#include "base/types.hpp"
#include "material/j2_plasticity.hpp"

namespace perilink {

/// Eigenvalues of a symmetric tensor, from the largest to the smallest.
struct PrincipalValues {
  double first = 0.0, middle = 0.0, last = 0.0;
};
/// \param dim  2: of the part in the plane; `middle` equals `last`
PrincipalValues principal_values(const SymmetricTensor& tensor, int dim);
/// Unit vector along the first of them.
Vector3 principal_direction(const SymmetricTensor& tensor, int dim);

}  // namespace perilink
