#include <gtest/gtest.h>

#include <cmath>

#include "meshes.hpp"
#include "support/temporary_directory.hpp"

namespace perilink::verification {
namespace {

/// Stiffnesses and peaks of a body whose mesh is scaled, moved far away, noisy in the last bit,
/// written in binary, renumbered.
void expect_same(const MeshBody& body, double stiffness, double peak) {
  SCOPED_TRACE(body.name);
  const int broken = peak > 0.0 ? 30 : 0;
  const test::TemporaryDirectory work;
  const ChangedBody plain = run_changed(body, Change::none, broken, work.path());
  for (const Change change : all_changes) {
    SCOPED_TRACE(static_cast<int>(change));
    const ChangedBody other = run_changed(body, change, broken, work.path());
    EXPECT_LT(stiffness_difference(body, plain.model, other.model, change), stiffness);
    if (broken > 0) {
      EXPECT_LT(std::abs(other.peak / plain.peak - 1.0), peak);
    }
  }
}

/// Coordinates a thousand sizes away have 1e-13 of the size, a bond of the L 1e-12 of its length.
TEST(RoundOff, DoesNotChangeAnswersOnMeshesInThePlane) {
  expect_same({"L", read_body("l_shape", 2)}, 1e-8, 1e-8);
  expect_same({"L, two spacings", read_body("l_shape", 2), 2.0}, 1e-8, 1e-8);
  expect_same({"L with moments", read_body("l_shape", 2), 2.0, 0.2}, 1e-8, 1e-8);
  expect_same({"plate", read_body("plate_with_hole", 2)}, 1e-8, 1e-8);
  expect_same({"corbel", read_body("corbel", 2), 2.0}, 1e-8, 1e-8);
}

/// Searches in space read coefficients in single precision.
TEST(RoundOff, DoesNotChangeStiffnessesOfMeshesInSpace) {
  expect_same({"L", read_body("l_block_coarse", 3)}, 1e-6, 0.0);
}

}  // namespace
}  // namespace perilink::verification
