#pragma once

#include "base/types.hpp"
#include "material/j2_plasticity.hpp"

namespace perilink {

/// tensor += factor v v'
void add_square(SymmetricTensor& tensor, double factor, const Vector3& v);

/// Eigenvalues of a symmetric tensor, largest first.
struct PrincipalValues {
  double first = 0.0, middle = 0.0, last = 0.0;
};
/// Returns the eigenvalues of a symmetric tensor.
/// \param dim  2: of the plane part; `middle` equals `last`
PrincipalValues principal_values(const SymmetricTensor& tensor, int dim);
/// Returns the unit vector along the first principal axis.
Vector3 principal_direction(const SymmetricTensor& tensor, int dim);

}  // namespace perilink
