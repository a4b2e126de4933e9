#include "material/principal_values.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(PrincipalValues, Diagonalise) {
  const SymmetricTensor plane{3.0, -1.0, 0.0, 1.5, 0.0, 0.0};
  const SymmetricTensor space{3.0, -1.0, 0.5, 1.5, -0.4, 0.7};
  for (const int dim : {2, 3}) {
    const SymmetricTensor& t = dim == 2 ? plane : space;
    const PrincipalValues values = principal_values(t, dim);
    const Vector3 n = principal_direction(t, dim);
    EXPECT_NEAR(t[0] * n[0] + t[3] * n[1] + t[5] * n[2], values.first * n[0], 1e-14);
    EXPECT_NEAR(t[3] * n[0] + t[1] * n[1] + t[4] * n[2], values.first * n[1], 1e-14);
    EXPECT_NEAR(t[5] * n[0] + t[4] * n[1] + t[2] * n[2], values.first * n[2], 1e-14);
    const double rest = dim == 2 ? 0.0 : values.middle;
    EXPECT_NEAR(values.first + rest + values.last, t[0] + t[1] + t[2], 1e-14);
  }
}

}  // namespace

}  // namespace perilink
