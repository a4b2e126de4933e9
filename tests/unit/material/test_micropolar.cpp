#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "material/micromodulus.hpp"
#include "material/micropolar.hpp"

namespace perilink {
namespace {

constexpr Problem problems[] = {Problem::plane_stress, Problem::plane_strain,
                                Problem::three_dimensional};

/// Points of a square, hexagonal or cubic lattice of unit spacing within a radius.
std::vector<Vector3> lattice_offsets(double skew, double row, int layers, double radius) {
  const int reach = static_cast<int>(2.0 * radius) + 2;
  std::vector<Vector3> offsets;
  for (int k = -layers; k <= layers; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const Vector3 xi{i + skew * j, row * j, double(k)};
        const double length = std::hypot(xi[0], xi[1], xi[2]);
        if (length > 0.0 && length <= radius * (1.0 + 1e-9)) offsets.push_back(xi);
      }
    }
  }
  return offsets;
}
std::vector<Vector3> square_neighbourhood(double radius) {
  return lattice_offsets(0.0, 1.0, 0, radius);
}
std::vector<Vector3> hexagonal(double radius) {
  return lattice_offsets(0.5, std::sqrt(0.75), 0, radius);
}
std::vector<Vector3> cubic(double radius) {
  return lattice_offsets(0.0, 1.0, static_cast<int>(radius), radius);
}

using Strain = std::array<Vector3, 3>;

/// Energy per volume of a particle whose neighbours move with a homogeneous strain while no
/// particle rotates: half of every bond's c xi s^2 / 2 + 6 d |eps n - s n|^2 / xi per product of
/// volumes.
double energy_density(const std::vector<Vector3>& offsets, double volume,
                      const MicropolarModuli& moduli, const Strain& strain) {
  double energy = 0.0;
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    double stretch = 0.0, square_neighbourhood = 0.0;
    for (int row = 0; row < 3; ++row) {
      double component = 0.0;
      for (int col = 0; col < 3; ++col) component += strain[row][col] * xi[col] / length;
      stretch += component * xi[row] / length;
      square_neighbourhood += component * component;
    }
    energy += 0.5 * volume *
              (0.5 * moduli.micromodulus * length * stretch * stretch +
               6.0 * moduli.bending_modulus * (square_neighbourhood - stretch * stretch) / length);
  }
  return energy;
}

/// Hooke's energy per volume; in plane stress the strain across the plane follows.
double hooke(Problem problem, const ElasticConstants& elastic, const Strain& strain) {
  const double E = elastic.youngs_modulus, nu = elastic.poissons_ratio;
  const double mu = 0.5 * E / (1.0 + nu);
  const double lambda = problem == Problem::plane_stress ? E * nu / (1.0 - nu * nu)
                                                         : E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  double trace = 0.0, square_neighbourhood = 0.0;
  for (int row = 0; row < 3; ++row) {
    trace += strain[row][row];
    for (int col = 0; col < 3; ++col) square_neighbourhood += strain[row][col] * strain[row][col];
  }
  return 0.5 * lambda * trace * trace + mu * square_neighbourhood;
}

// Gerstle, Sau & Aguilera 2007, section 6: c = 3.713e6 GN/m^5 and d = 18.54 GN/m^3 belong to
// E = 24.85 GPa, nu = 0.22 and a horizon of 25.4 mm. (The figure says plane strain; the numbers are
// those of plane stress.)
TEST(ContinuumMicropolar, GivesTheConstantsOfThePaper) {
  const MicropolarModuli moduli =
      continuum_micropolar(Problem::plane_stress, {24.85, 0.22}, 0.0254, 1.0);
  EXPECT_NEAR(moduli.micromodulus, 3.713e6, 0.001e6);
  EXPECT_NEAR(moduli.bending_modulus, 18.54, 0.01);
}

/// Gerstle, Sau & Aguilera 2007, Eqs. 16, 18 and 21.
ElasticConstants elastic_constants(Problem problem, const MicropolarModuli& moduli, double horizon,
                                   double thickness) {
  const double pi = std::numbers::pi, square_neighbourhood = horizon * horizon;
  if (problem == Problem::three_dimensional) {
    const double axial = moduli.micromodulus * square_neighbourhood;
    const double bending = moduli.bending_modulus;
    const double sum = axial + 6.0 * bending;
    return {pi * square_neighbourhood * axial * (axial + 36.0 * bending) / (12.0 * sum),
            (axial - 24.0 * bending) / (4.0 * sum)};
  }
  const double axial = moduli.micromodulus * square_neighbourhood * thickness;
  const double bending = moduli.bending_modulus * thickness;
  if (problem == Problem::plane_stress) {
    const double sum = axial + 12.0 * bending;
    return {pi * horizon * axial * (axial + 36.0 * bending) / (9.0 * sum),
            (axial - 36.0 * bending) / (3.0 * sum)};
  }
  return {pi * horizon * (axial + 36.0 * bending) * (5.0 * axial - 36.0 * bending) / (48.0 * axial),
          (axial - 36.0 * bending) / (4.0 * axial)};
}

TEST(ContinuumMicropolar, TheWayBackGivesTheElasticConstants) {
  for (const Problem problem : problems) {
    for (const double nu : {-0.9, -0.3, 0.0, 0.1, 0.2, 0.25}) {
      const ElasticConstants back =
          elastic_constants(problem, continuum_micropolar(problem, {30.0, nu}, 0.4, 0.7), 0.4, 0.7);
      EXPECT_NEAR(back.youngs_modulus, 30.0, 1e-12 * 30.0) << nu;
      EXPECT_NEAR(back.poissons_ratio, nu, 1e-13) << nu;
    }
  }
}

TEST(ContinuumMicropolar, AtTheLargestRatioBondsDoNotBend) {
  for (const Problem problem : problems) {
    const MicropolarModuli moduli =
        continuum_micropolar(problem, {30.0, bond_poissons_ratio(problem)}, 0.4, 0.7);
    EXPECT_EQ(moduli.bending_modulus, 0.0);
    const double c = continuum_micromodulus(problem, 30.0, 0.4, 0.7);
    EXPECT_NEAR(moduli.micromodulus, c, 1e-13 * c);
  }
}

TEST(ContinuumMicropolar, RefusesRatiosThatWouldNeedNegativeBending) {
  for (const Problem problem : problems) {
    for (const double nu : {-1.0, bond_poissons_ratio(problem) + 1e-6, 0.49}) {
      EXPECT_THROW(continuum_micropolar(problem, {30.0, nu}, 0.4, 1.0), std::invalid_argument);
    }
  }
}

TEST(LatticeMicropolar, HexagonalLatticesAreIsotropicWithTheConstantsAskedFor) {
  const double volume = std::sqrt(0.75) * 0.3;
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    for (const double nu : {-0.2, 0.0, 0.2}) {
      const ElasticConstants elastic{30.0, nu};
      const auto offsets = hexagonal(3.0);
      const MicropolarModuli moduli = lattice_micropolar(problem, offsets, volume, elastic);
      EXPECT_GT(moduli.bending_modulus, 0.0);
      for (const Strain& strain : {Strain{{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
                                   Strain{{{0.3, 0.8, 0}, {0.8, -0.5, 0}, {0, 0, 0}}}}) {
        const double expected = hooke(problem, elastic, strain);
        EXPECT_NEAR(energy_density(offsets, volume, moduli, strain), expected, 1e-13 * expected);
      }
    }
  }
}

TEST(LatticeMicropolar, SquareLatticesAreExactAlongTheirAxes) {
  const ElasticConstants elastic{30.0, 0.2};
  const auto offsets = square_neighbourhood(3.0);
  const MicropolarModuli moduli = lattice_micropolar(Problem::plane_stress, offsets, 2.0, elastic);
  for (const Strain& strain :
       {Strain{{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, Strain{{{1, 0, 0}, {0, -0.2, 0}, {0, 0, 0}}}}) {
    const double expected = hooke(Problem::plane_stress, elastic, strain);
    EXPECT_NEAR(energy_density(offsets, 2.0, moduli, strain), expected, 1e-13 * expected);
  }
}

TEST(LatticeMicropolar, CubicLatticesHaveTheBulkModulusAndTheVoigtMeanOfTheShearModulus) {
  const ElasticConstants elastic{30.0, 0.15};
  const auto offsets = cubic(2.0);
  const MicropolarModuli moduli =
      lattice_micropolar(Problem::three_dimensional, offsets, 0.5, elastic);
  const Strain hydrostatic{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const double bulk = hooke(Problem::three_dimensional, elastic, hydrostatic);
  EXPECT_NEAR(energy_density(offsets, 0.5, moduli, hydrostatic), bulk, 1e-13 * bulk);
  // Five independent shears of equal norm; their mean energy is the Voigt mean.
  const double h = std::sqrt(0.5), s = std::sqrt(1.0 / 6.0);
  double mean = 0.0, expected = 0.0;
  for (const Strain& shear :
       {Strain{{{0, h, 0}, {h, 0, 0}, {0, 0, 0}}}, Strain{{{0, 0, h}, {0, 0, 0}, {h, 0, 0}}},
        Strain{{{0, 0, 0}, {0, 0, h}, {0, h, 0}}}, Strain{{{h, 0, 0}, {0, -h, 0}, {0, 0, 0}}},
        Strain{{{s, 0, 0}, {0, s, 0}, {0, 0, -2 * s}}}}) {
    mean += energy_density(offsets, 0.5, moduli, shear) / 5.0;
    expected += hooke(Problem::three_dimensional, elastic, shear) / 5.0;
  }
  EXPECT_NEAR(mean, expected, 1e-13 * expected);
}

TEST(LatticeMicropolar, AtTheLatticesOwnRatioTheBondsAreTrusses) {
  for (const Problem problem : problems) {
    const auto offsets =
        problem == Problem::three_dimensional ? cubic(2.0) : square_neighbourhood(3.0);
    const LatticeModuli truss = lattice_moduli(problem, offsets, 2.0);
    const MicropolarModuli moduli =
        lattice_micropolar(problem, offsets, 2.0, {30.0, truss.poissons_ratio});
    EXPECT_EQ(moduli.bending_modulus, 0.0);
    EXPECT_NEAR(moduli.micromodulus, 30.0 * truss.micromodulus_per_modulus,
                1e-12 * moduli.micromodulus);
    EXPECT_THROW(lattice_micropolar(problem, offsets, 2.0, {30.0, truss.poissons_ratio + 1e-6}),
                 std::invalid_argument);
    EXPECT_THROW(lattice_micropolar(problem, offsets, 2.0, {30.0, -1.0}), std::invalid_argument);
  }
}

// The four nearest neighbours of a square lattice neither stretch nor bend in shear along the axes.
TEST(LatticeMicropolar, RefusesNeighboursThatCannotResist) {
  EXPECT_THROW(
      lattice_micropolar(Problem::plane_stress, square_neighbourhood(1.0), 1.0, {30.0, -0.1}),
      std::invalid_argument);
}

// The sums tend to the integrals: at 20 spacings the disc holds its area within a per cent, and the
// sum of 1 / xi lacks the particle's own cell, a disc of radius 0.49: 2.5 % of the horizon.
TEST(LatticeMicropolar, TendsToTheContinuum) {
  const double volume = std::sqrt(0.75);
  const MicropolarModuli lattice =
      lattice_micropolar(Problem::plane_stress, hexagonal(20.0), volume, {30.0, 0.1});
  const MicropolarModuli body = continuum_micropolar(Problem::plane_stress, {30.0, 0.1}, 20.0, 1.0);
  EXPECT_NEAR(lattice.micromodulus, body.micromodulus, 0.01 * body.micromodulus);
  EXPECT_NEAR(lattice.bending_modulus, body.bending_modulus / (1.0 - 0.49 / 20.0),
              0.01 * body.bending_modulus);
}

}  // namespace
}  // namespace perilink
