#include "material/states/state_moduli.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/types.hpp"

namespace perilink {
namespace {

using Tensor = std::array<std::array<double, 3>, 3>;

/// Stress of one interior particle under a uniform strain: sum over its bonds.
Tensor stress_of(const StateModuli& moduli, const std::vector<Vector3>& bonds, double spacing,
                 double volume, const Tensor& strain) {
  std::vector<double> stretch, length;
  double sum = 0.0;
  for (const Vector3& bond : bonds) {
    double square = 0.0, elongation = 0.0;
    for (int a = 0; a < 3; ++a) {
      square += bond[a] * bond[a];
      for (int b = 0; b < 3; ++b) elongation += bond[a] * strain[a][b] * bond[b];
    }
    length.push_back(std::sqrt(square));
    stretch.push_back(elongation / square);
    sum += length.back() / spacing * stretch.back();
  }
  Tensor stress{};
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const double far = length[k] > 1.2 * spacing ? moduli.far : 0.0;
    const double force = (moduli.own + far) * stretch[k] + moduli.sum * sum;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        stress[a][b] += force * bonds[k][a] * bonds[k][b] / (2.0 * volume * length[k]);
      }
    }
  }
  return stress;
}

/// lambda tr(strain) + 2 mu strain; round-off of a dozen terms against the largest component.
void expect_hooke(Problem problem, double e, double nu, const Tensor& strain,
                  const Tensor& stress) {
  const HookeConstants hooke = hooke_constants(problem, e, nu);
  const double trace = strain[0][0] + strain[1][1] + strain[2][2];
  for (int a = 0; a < dimension_of(problem); ++a) {
    for (int b = 0; b < dimension_of(problem); ++b) {
      const double expected = hooke.lambda * trace * (a == b) + 2.0 * hooke.mu * strain[a][b];
      EXPECT_NEAR(stress[a][b], expected, 1e-13 * e) << "nu " << nu << ", " << a << b;
    }
  }
}

std::vector<Vector3> hexagon(double spacing, double turn) {
  std::vector<Vector3> bonds;
  for (int k = 0; k < 6; ++k) {
    const double angle = turn + k * std::numbers::pi / 3.0;
    bonds.push_back({spacing * std::cos(angle), spacing * std::sin(angle), 0.0});
  }
  return bonds;
}

std::vector<Vector3> eighteen(double spacing) {
  std::vector<Vector3> bonds;
  const double half = spacing / std::numbers::sqrt2;
  for (int a = 0; a < 3; ++a) {
    for (const double s : {-1.0, 1.0}) {
      Vector3 far{};
      far[a] = 2.0 * s * half;
      bonds.push_back(far);
      for (const double r : {-1.0, 1.0}) {
        Vector3 near{};
        near[a] = s * half;
        near[(a + 1) % 3] = r * half;
        bonds.push_back(near);
      }
    }
  }
  return bonds;
}

TEST(StateModuli, HexagonsCarryHookesStressAtAnyTurn) {
  const double spacing = 0.7, thickness = 1.3, e = 2.0;
  const double volume = 0.5 * std::numbers::sqrt3 * thickness * spacing * spacing;
  const Tensor strain{{{0.3, -0.2, 0.0}, {-0.2, 0.5, 0.0}, {0.0, 0.0, 0.0}}};
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    for (const double nu : {-0.3, 0.0, 0.2, 1.0 / 3.0, 0.45}) {
      const StateModuli moduli = hexagonal_moduli(problem, e, nu, spacing, thickness);
      for (const double turn : {0.0, 0.26, 0.5}) {
        expect_hooke(problem, e, nu, strain,
                     stress_of(moduli, hexagon(spacing, turn), spacing, volume, strain));
      }
    }
  }
}

TEST(StateModuli, EighteenBondsCarryHookesStress) {
  const double spacing = 0.7, e = 2.0;
  const double volume = spacing * spacing * spacing / std::numbers::sqrt2;
  const Tensor strain{{{0.3, -0.2, 0.1}, {-0.2, 0.5, 0.25}, {0.1, 0.25, -0.4}}};
  for (const double nu : {-0.3, 0.0, 0.2, 0.25, 0.45}) {
    const StateModuli moduli = face_centred_moduli(e, nu, spacing);
    expect_hooke(Problem::three_dimensional, e, nu, strain,
                 stress_of(moduli, eighteen(spacing), spacing, volume, strain));
  }
}

TEST(StateModuli, RefusesWhatNoSolidHas) {
  EXPECT_THROW(hexagonal_moduli(Problem::plane_stress, 1.0, 0.5, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(hexagonal_moduli(Problem::three_dimensional, 1.0, 0.2, 1.0, 1.0),
               std::invalid_argument);
  EXPECT_THROW(face_centred_moduli(1.0, -1.0, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
