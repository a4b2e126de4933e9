#include "network/builder/repeated_box.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

struct RepeatedCase {
  std::string name;
  Pattern pattern;
  BondModel model;
  Vector3 size;    // in spacings
  double horizon;  // in spacings
};

std::ostream& operator<<(std::ostream& out, const RepeatedCase& own) { return out << own.name; }

/// A box that is not at the origin, its last three layers three times as tough.
LatticeInput input_of(const RepeatedCase& own) {
  LatticeInput input;
  input.pattern = own.pattern;
  input.surface = Surface::calibrated;
  input.spacing = 0.2;
  input.horizon = own.horizon * input.spacing;
  Box box{{0.3, -0.1, 0.7}, {}};
  for (int a = 0; a < 3; ++a) box.upper[a] = box.lower[a] + own.size[a] * input.spacing;
  Box upper = box;
  upper.lower[2] = box.upper[2] - 3.0 * input.spacing;
  input.solid = {box, upper};
  input.material = {0, 1};
  return input;
}

NetworkInput network_of(const RepeatedCase& own) {
  NetworkInput input = network_input(input_of(own));
  input.model = own.model;
  input.materials = {{30.0, 0.02, 0.2}, {30.0, 0.06, 0.2}};
  return input;
}

class RepeatedBoxes : public testing::TestWithParam<RepeatedCase> {};

/// Positions differ by round-off, and what is solved for by what its conjugate gradients leave,
/// some 1e-13.
void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] != b[k]) largest = std::max(largest, std::abs(a[k] - b[k]) / std::abs(b[k]));
  }
  EXPECT_LT(largest, 1e-11);
}

TEST_P(RepeatedBoxes, AreThoseThatAreMadeInOnePiece) {
  const Body body = make_body(input_of(GetParam()));
  NetworkInput input = network_of(GetParam());
  input.cracks.push_back({{{0.0, 0.0, 1.03}, {1.0, 0.0, 1.03}, {1.0, 0.35, 1.03}}});
  input.cracks.back().closes = true;
  ASSERT_TRUE(repeats_smaller_box(body, input));
  const Network whole = build_network(body, in_one_piece(input));
  const Network repeated = build_network(body, input);
  EXPECT_EQ(repeated.bonds.first, whole.bonds.first);
  EXPECT_EQ(repeated.bonds.second, whole.bonds.second);
  EXPECT_LT(repeated.bonds.lengths.size(), 100u) << "as many as a particle has bonds at most";
  for (Index b = 0; b < whole.bonds.size(); ++b) {  // positions in spacings: up to 45
    ASSERT_NEAR(repeated.bonds.length(b), whole.bonds.length(b), 1e-14);
    for (int a = 0; a < 3; ++a) {
      ASSERT_NEAR(repeated.bonds.direction(b)[a], whole.bonds.direction(b)[a], 1e-13);
    }
  }
  EXPECT_EQ(repeated.report.cut_by_crack, whole.report.cut_by_crack);
  EXPECT_GT(repeated.report.cut_by_crack.front(), 0);
  expect_same(repeated.stiffness, whole.stiffness);
  EXPECT_GT(repeated.num_contacts, 0);
  expect_same(repeated.critical_stretch, whole.critical_stretch);
  expect_same(repeated.bending, whole.bending);
  expect_same(repeated.bending_ratio, whole.bending_ratio);
  expect_same(repeated.inflection, whole.inflection);
  EXPECT_EQ(repeated.bending.empty(), input.model == BondModel::bond_based);
  EXPECT_LT(repeated.report.calibration->free_bonds, whole.report.calibration->free_bonds);
  EXPECT_LT(repeated.report.calibration->residual_after, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, RepeatedBoxes,
    testing::Values(
        RepeatedCase{"Cubic", Pattern::cubic, BondModel::bond_based, {6, 7, 40}, 2},
        RepeatedCase{"FaceCentred", Pattern::face_centred, BondModel::bond_based, {40, 5, 3}, 1.5},
        RepeatedCase{"Micropolar", Pattern::cubic, BondModel::micropolar, {5, 5, 40}, 2}),
    [](const auto& instance) { return instance.param.name; });

TEST(RepeatedBox, IsALargeBoxInSpaceWithOneSetOfConstants) {
  const RepeatedCase large{"", Pattern::cubic, BondModel::bond_based, {6, 7, 40}, 2};
  const Body body = make_body(input_of(large));
  NetworkInput input = network_of(large);
  EXPECT_TRUE(repeats_smaller_box(body, input));
  input.materials[1].youngs_modulus = 31.0;
  EXPECT_FALSE(repeats_smaller_box(body, input));
  RepeatedCase small = large;
  small.size[2] = 20;  // the smaller box has 14
  EXPECT_FALSE(repeats_smaller_box(make_body(input_of(small)), network_of(small)));
  LatticeInput uncorrected = input_of(large);
  uncorrected.surface = Surface::none;
  EXPECT_FALSE(repeats_smaller_box(make_body(uncorrected), network_of(large)));
  const LatticeInput plane = body_input({"", Pattern::rectangular, Surface::calibrated}, 60);
  EXPECT_FALSE(repeats_smaller_box(make_body(plane), network_input(plane)));
}

}  // namespace
}  // namespace perilink
