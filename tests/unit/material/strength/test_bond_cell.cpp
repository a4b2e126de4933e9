#include "material/strength/bond_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "material/softening.hpp"

namespace perilink {
namespace {

constexpr Vector3 along_x = {1.0, 0.0, 0.0};

/// With segments that add less than 1e-4 to the strength.
double strength_factor(std::span<const CellBond> cell, int dim, const SofteningShape& shape,
                       double end) {
  return cell_strength(cell, dim, along_x,
                       saw_tooth_of(SofteningCurve(shape, softening_energy(shape, end)), 0.005));
}

constexpr std::array ends = {5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0};

struct StrengthTable {
  Problem problem;
  SofteningShape shape;
  std::array<double, ends.size()> factor;
};

class StrengthFactors : public testing::TestWithParam<StrengthTable> {};

/// Computed independently: the largest stress of a continuum of bonds whose softening curves are
/// followed without segments. 1 % for the finite directions here.
TEST_P(StrengthFactors, AreThoseOfAContinuumOfBonds) {
  const StrengthTable& table = GetParam();
  const std::vector<CellBond> cell = isotropic_cell(table.problem, 1.0);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    EXPECT_NEAR(strength_factor(cell, dimension_of(table.problem), table.shape, ends[k]),
                table.factor[k], 0.01 * table.factor[k])
        << "s_1 / s_0 = " << ends[k];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Curves, StrengthFactors,
    testing::Values(StrengthTable{Problem::plane_stress,
                                  {Softening::linear},
                                  {1.118, 1.183, 1.219, 1.242, 1.274, 1.309, 1.350}},
                    StrengthTable{Problem::plane_stress,
                                  {Softening::bilinear},
                                  {1.047, 1.096, 1.130, 1.154, 1.189, 1.231, 1.283}},
                    StrengthTable{Problem::three_dimensional,
                                  {Softening::linear},
                                  {1.323, 1.445, 1.509, 1.552, 1.607, 1.669, 1.740}},
                    StrengthTable{Problem::three_dimensional,
                                  {Softening::bilinear},
                                  {1.175, 1.281, 1.346, 1.392, 1.456, 1.531, 1.623}}),
    [](const auto& test) {
      const std::string dim = test.param.problem == Problem::plane_stress ? "plane" : "space";
      return dim + (test.param.shape.kind == Softening::linear ? "_linear" : "_bilinear");
    });

/// Bonds of all directions with shares w of k xi^2 / V that add up to one and the ratio q of shear:
/// with the means of n n and n n n n over all directions lambda = (1 - q) / 8 and mu = (1 + q) / 8
/// in the plane, lambda = (1 - q) / 15 and mu = (2 + 3 q) / 30 in space. The plane is in plane
/// stress.
TEST(IsotropicCells, HaveTheModuliOfTheSolid) {
  for (const double ratio : {-0.2, 0.0, 0.1, 0.2, 0.3, 1.0 / 3.0}) {
    const double r = 2.0 * ratio / (1.0 - ratio), q = (1.0 - r) / (1.0 + r);
    const double mu = (1.0 + q) / 8.0;
    const double expected = 2.0 * mu * (1.0 + ratio);
    // Sixty directions integrate fourth powers exactly.
    EXPECT_NEAR(cell_modulus(isotropic_cell(Problem::plane_stress, r), 2, along_x), expected,
                1e-12 * expected);
  }
  for (const double ratio : {-0.2, 0.0, 0.1, 0.2, 0.25}) {
    const double r = 2.0 * ratio / (1.0 - 2.0 * ratio), q = 2.0 * (1.0 - r) / (2.0 + 3.0 * r);
    const double mu = (2.0 + 3.0 * q) / 30.0;
    const double expected = 2.0 * mu * (1.0 + ratio);
    // The rule over the axis has an error with the square of a step of 5.6 degrees.
    EXPECT_NEAR(cell_modulus(isotropic_cell(Problem::three_dimensional, r), 3, along_x), expected,
                0.005 * expected);
  }
}

/// Plane strain has the bonds of the plane, whose r is one at Poisson's ratio 1/4.
TEST(IsotropicCells, OfPlaneProblemsAreAlike) {
  const std::vector<CellBond> stress = isotropic_cell(Problem::plane_stress, 0.5);
  const std::vector<CellBond> strain = isotropic_cell(Problem::plane_strain, 0.5);
  ASSERT_EQ(stress.size(), strain.size());
  EXPECT_EQ(cell_modulus(stress, 2, along_x), cell_modulus(strain, 2, along_x));
}

/// The bond along the pull breaks at the strain s_c; directions nearest to it are 1.5 (plane) and
/// 2.8 degrees away (space), where the stretch is less by (1 + nu) times the square of the angle.
TEST(IsotropicCells, BreakAtTheCriticalStretchWhereBondsAreBrittle) {
  const BondLaw brittle = BondLaw::brittle();
  for (const auto& [problem, margin] :
       {std::pair{Problem::plane_stress, 0.001}, std::pair{Problem::three_dimensional, 0.0035}}) {
    const std::vector<CellBond> cell = isotropic_cell(problem, 1.0);
    const double factor = cell_strength(cell, dimension_of(problem), along_x, brittle);
    EXPECT_GT(factor, 1.0);
    EXPECT_LT(factor, 1.0 + margin);
  }
}

TEST(IsotropicCells, AreStrongerWithLongerTails) {
  for (const double r : {1.0, 0.5}) {
    const std::vector<CellBond> cell = isotropic_cell(Problem::plane_stress, r);
    double before = 1.0;
    for (const double end : {2.0, 6.0, 20.0, 60.0}) {
      const double factor = strength_factor(cell, 2, {Softening::linear}, end);
      EXPECT_GT(factor, before);
      before = factor;
    }
  }
}

/// Neighbours of a lattice particle, both of each pair.
std::vector<Vector3> with_opposites(std::vector<Vector3> offsets) {
  for (std::size_t k = 0, count = offsets.size(); k < count; ++k) {
    const auto [x, y, z] = offsets[k];
    offsets.push_back({-x, -y, -z});
  }
  return offsets;
}

const double third = 0.5 * std::numbers::sqrt3;
const std::vector<Vector3> triangle =
    with_opposites({{0.2, 0.0, 0.0}, {0.1, 0.2 * third, 0.0}, {-0.1, 0.2 * third, 0.0}});
const double triangle_area = 0.2 * 0.2 * third;

/// Springs k between nearest neighbours of a triangular lattice: E = 2 k / sqrt(3) per thickness,
/// and with a shear stiffness q k (1 + q) / (3 + q) of three times that.
TEST(LatticeCells, HaveTheModulusOfTheLattice) {
  const double k = 7.0, thickness = 0.5;
  const std::vector<double> axial(triangle.size(), k);
  for (const double q : {0.0, 0.2, 0.6}) {
    const std::vector<double> shear(q > 0.0 ? triangle.size() : 0, q);
    const auto cell = lattice_cell(triangle, axial, shear, triangle_area * thickness);
    EXPECT_EQ(cell.size(), 3U) << "one of each pair";
    const double expected = 2.0 * std::numbers::sqrt3 * k / thickness * (1.0 + q) / (3.0 + q);
    for (const Vector3& pull : {along_x, Vector3{0.0, 1.0, 0.0}, Vector3{0.6, 0.8, 0.0}}) {
      EXPECT_NEAR(cell_modulus(cell, 2, pull), expected, 1e-13 * expected) << q;
    }
  }
}

/// Springs k to the nearest neighbours of a square lattice and k / 2 to the diagonal ones are
/// isotropic with lambda = mu = k / 2: E = 8 mu / 3.
TEST(LatticeCells, OfSquaresHaveTheModulusOfTheLattice) {
  const std::vector<Vector3> offsets =
      with_opposites({{0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}});
  const std::vector<double> axial = {3.0, 3.0, 1.5, 1.5, 3.0, 3.0, 1.5, 1.5};
  const auto cell = lattice_cell(offsets, axial, {}, 0.01);
  EXPECT_NEAR(cell_modulus(cell, 2, along_x), 4.0, 1e-13);
  EXPECT_NEAR(cell_modulus(cell, 2, {0.0, 1.0, 0.0}), 4.0, 1e-13);
}

/// Along a row of a triangular lattice the row's bond has the strain s_c when it breaks; the other
/// two with k' = 3 k / 4 across then carry less.
TEST(LatticeCells, BreakWhereTheirRowsDo) {
  const auto cell =
      lattice_cell(triangle, std::vector<double>(triangle.size(), 7.0), {}, triangle_area);
  EXPECT_NEAR(cell_strength(cell, 2, along_x, BondLaw::brittle()), 1.0, 1e-12);
}

/// In the intact triangle only the bonds at 30 degrees to the pull stretch, by 3/4 - nu / 4 = 2/3
/// of the strain: they break at 3/2 s_c.
TEST(LatticeCells, AreStrongerBetweenTheirRows) {
  const auto cell =
      lattice_cell(triangle, std::vector<double>(triangle.size(), 7.0), {}, triangle_area);
  EXPECT_NEAR(cell_strength(cell, 2, {0.0, 1.0, 0.0}, BondLaw::brittle()), 1.5, 1e-12);
}

TEST(LatticeCells, HaveNoModulusWithoutShear) {
  const std::vector<Vector3> row = with_opposites({{0.1, 0.0, 0.0}});
  const auto cell = lattice_cell(row, std::vector<double>{1.0, 1.0}, {}, 0.01);
  EXPECT_EQ(cell_modulus(cell, 2, {0.0, 1.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace perilink
