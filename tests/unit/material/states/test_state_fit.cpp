#include "material/states/state_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "material/states/state_moduli.hpp"

namespace perilink {
namespace {

constexpr double state_modulus = 25.0, spacing = 0.1;

std::vector<NeighbourhoodBond> hexagonal_neighbourhood(double angle) {
  std::vector<NeighbourhoodBond> neighbourhood;
  for (int k = 0; k < 6; ++k) {
    const double a = angle + k * std::numbers::pi / 3.0;
    neighbourhood.push_back({{std::cos(a), std::sin(a), 0.0}, spacing, true});
  }
  return neighbourhood;
}

std::vector<NeighbourhoodBond> face_centred_neighbourhood() {
  std::vector<NeighbourhoodBond> neighbourhood;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        const double size = std::sqrt(1.0 * (x * x + y * y + z * z));
        if ((x + y + z) % 2 != 0 || size == 0.0 || size > 2.1) continue;
        neighbourhood.push_back(
            {{x / size, y / size, z / size}, size * spacing / std::numbers::sqrt2, size > 1.5});
      }
    }
  }
  return neighbourhood;
}

std::vector<NeighbourhoodBond> random_neighbourhood(int dim, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> length(0.5 * spacing, 1.5 * spacing);
  std::vector<NeighbourhoodBond> neighbourhood;
  for (int k = 0; k < (dim == 2 ? 6 : 18); ++k) {
    Vector3 n{normal(generator), normal(generator), dim == 3 ? normal(generator) : 0.0};
    const double size = std::hypot(n[0], n[1], n[2]);
    for (double& c : n) c /= size;
    const double l = length(generator);
    neighbourhood.push_back({n, l, l > 1.2 * spacing});
  }
  return neighbourhood;
}

TEST(StateFit, OfHexagonalFamiliesAreTheClosedForms) {
  const double thickness = 0.3, volume = 0.5 * std::numbers::sqrt3 * thickness * spacing * spacing;
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    for (const double ratio : {-0.3, 0.0, 0.2, 0.45}) {
      const StateModuli exact = hexagonal_moduli(problem, state_modulus, ratio, spacing, thickness);
      const ParticleFit fit =
          fit_particle_moduli(problem, state_modulus, ratio, hexagonal_neighbourhood(0.3), volume);
      EXPECT_EQ(fit.kind, FitKind::exact);
      EXPECT_NEAR(fit.moduli.own, exact.own, 1e-13 * exact.own);
      EXPECT_NEAR(fit.moduli.state * spacing, exact.sum, 1e-13 * exact.own);
      EXPECT_EQ(fit.moduli.far, 0.0);
      EXPECT_LT(fit.residual, 1e-13);
    }
  }
}

TEST(StateFit, OfFaceCentredFamiliesAreTheClosedForms) {
  const double volume = std::pow(spacing, 3) / std::numbers::sqrt2;
  for (const double ratio : {0.0, 0.2, 0.4}) {
    const StateModuli exact = face_centred_moduli(state_modulus, ratio, spacing);
    const ParticleFit fit = fit_particle_moduli(Problem::three_dimensional, state_modulus, ratio,
                                                face_centred_neighbourhood(), volume);
    EXPECT_EQ(fit.kind, FitKind::exact);
    EXPECT_NEAR(fit.moduli.own, exact.own, 1e-12 * exact.own);
    EXPECT_NEAR(fit.moduli.far, exact.far, 1e-12 * exact.own);
    EXPECT_NEAR(fit.moduli.state * spacing, exact.sum, 1e-12 * exact.own);
  }
}

/// Difference from Hooke's tensor of a neighbourhood with these constants, component by component:
/// the stress under each unit strain, Frobenius norm over all four indices.
double residual_of(const ParticleModuli& moduli, std::span<const NeighbourhoodBond> neighbourhood,
                   double volume, Problem problem, double ratio) {
  const int dim = dimension_of(problem);
  const HookeConstants hooke = hooke_constants(problem, state_modulus, ratio);
  double difference = 0.0, size = 0.0;
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      for (int k = 0; k < dim; ++k) {
        for (int l = 0; l < dim; ++l) {
          const double wanted = hooke.lambda * (i == j) * (k == l) +
                                hooke.mu * ((i == k) * (j == l) + (i == l) * (j == k));
          double sum = 0.0, found = 0.0;
          for (const NeighbourhoodBond& bond : neighbourhood) {
            sum += bond.length * bond.direction[k] * bond.direction[l];
          }
          for (const NeighbourhoodBond& bond : neighbourhood) {
            const Vector3& n = bond.direction;
            const double own = moduli.own + (bond.far ? moduli.far : 0.0);
            found +=
                0.5 / volume * bond.length * n[i] * n[j] * (own * n[k] * n[l] + moduli.state * sum);
          }
          difference += std::pow(found - wanted, 2);
          size += wanted * wanted;
        }
      }
    }
  }
  return std::sqrt(difference / size);
}

TEST(StateFit, OfScatteredFamiliesIsTheNearest) {
  for (const Problem problem : {Problem::plane_stress, Problem::three_dimensional}) {
    const int dim = dimension_of(problem);
    const double volume = std::pow(spacing, dim);
    int fitted = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      const auto neighbourhood = random_neighbourhood(dim, seed);
      const ParticleFit fit =
          fit_particle_moduli(problem, state_modulus, 0.2, neighbourhood, volume);
      const auto residual = [&](const ParticleModuli& moduli) {
        return residual_of(moduli, neighbourhood, volume, problem, 0.2);
      };
      EXPECT_NEAR(fit.residual, residual(fit.moduli), 1e-12);
      if (fit.kind != FitKind::least) continue;
      ++fitted;
      EXPECT_GT(fit.residual, 1e-3) << "scattered bonds are not isotropic";
      for (const double change : {-1e-3, 1e-3}) {
        ParticleModuli other = fit.moduli;
        other.own *= 1.0 + change;
        EXPECT_GT(residual(other), fit.residual);
        other = fit.moduli;
        other.state += change * fit.moduli.own / spacing;
        EXPECT_GT(residual(other), fit.residual);
        other = fit.moduli;
        other.far += change * fit.moduli.own;
        EXPECT_GT(residual(other), fit.residual);
      }
    }
    EXPECT_GT(fitted, 10);
  }
}

TEST(StateFit, ReportsFamiliesThatLeaveAStrainFree) {
  // All neighbours in one line: a sheared neighbourhood does not notice.
  const std::vector<NeighbourhoodBond> line = {{{1.0, 0.0, 0.0}, spacing, false},
                                               {{-1.0, 0.0, 0.0}, spacing, false}};
  const ParticleFit fit = fit_particle_moduli(Problem::plane_stress, state_modulus, 0.2, line, 0.1);
  EXPECT_EQ(fit.kind, FitKind::singular);
  EXPECT_GT(fit.moduli.own, 0.0);
  EXPECT_EQ(fit.moduli.state, 0.0);
  EXPECT_EQ(fit_particle_moduli(Problem::plane_stress, state_modulus, 0.2, {}, 0.1).kind,
            FitKind::singular);
}

TEST(StateFit, ReportsSeveralSolutions) {
  // Two hexagons, one larger: either is isotropic, and what one takes the other may give.
  std::vector<NeighbourhoodBond> neighbourhood = hexagonal_neighbourhood(0.3);
  for (NeighbourhoodBond& bond : neighbourhood) bond.far = false;
  for (NeighbourhoodBond bond : hexagonal_neighbourhood(0.1)) {
    bond.length *= 1.5;
    bond.far = true;
    neighbourhood.push_back(bond);
  }
  const ParticleFit fit =
      fit_particle_moduli(Problem::plane_stress, state_modulus, 0.2, neighbourhood, 0.01);
  EXPECT_EQ(fit.kind, FitKind::many);
  EXPECT_EQ(fit.moduli.far, 0.0);
  EXPECT_LT(fit.residual, 1e-13) << "without the one too many they are exact";
}

TEST(StateFit, OfSquareFamiliesIsExact) {
  std::vector<NeighbourhoodBond> neighbourhood;
  for (int k = 0; k < 8; ++k) {
    const double a = k * std::numbers::pi / 4.0;
    const double length = k % 2 == 0 ? spacing : spacing * std::numbers::sqrt2;
    neighbourhood.push_back({{std::cos(a), std::sin(a), 0.0}, length, k % 2 == 1});
  }
  const double volume = spacing * spacing;
  const ParticleFit fit =
      fit_particle_moduli(Problem::plane_stress, state_modulus, 0.2, neighbourhood, volume);
  EXPECT_EQ(fit.kind, FitKind::exact);
  // C11 - C12 = 2 C66 needs a + c = a / sqrt(2), and C11 - C12 = a h / V is E / (1 + nu).
  EXPECT_NEAR(fit.moduli.own + fit.moduli.far, fit.moduli.own / std::numbers::sqrt2,
              1e-12 * fit.moduli.own);
  EXPECT_NEAR(fit.moduli.own * spacing / volume, state_modulus / 1.2, 1e-12 * state_modulus);
}

TEST(StateFit, OfBondsThatAreAllFarIsThatOfNearOnes) {
  const double volume = std::pow(spacing, 3);
  auto near = random_neighbourhood(3, 5), far = near;
  for (NeighbourhoodBond& bond : near) bond.far = false;
  for (NeighbourhoodBond& bond : far) bond.far = true;
  const auto fit = [&](const std::vector<NeighbourhoodBond>& neighbourhood) {
    return fit_particle_moduli(Problem::three_dimensional, state_modulus, 0.2, neighbourhood,
                               volume);
  };
  EXPECT_EQ(fit(far).kind, FitKind::least);
  EXPECT_EQ(fit(far).moduli.own, fit(near).moduli.own);
  EXPECT_EQ(fit(far).moduli.state, fit(near).moduli.state);
}

TEST(StateFit, TakesNoConstantsOfNegativeEnergy) {
  // Close to a ratio of -1 the state takes most of the bonds' energy away.
  int refused = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto neighbourhood = random_neighbourhood(2, seed);
    const ParticleFit fit =
        fit_particle_moduli(Problem::plane_stress, state_modulus, -0.95, neighbourhood, 0.01);
    double reach = 0.0;
    for (const NeighbourhoodBond& bond : neighbourhood) {
      const double own = fit.moduli.own + (bond.far ? fit.moduli.far : 0.0);
      EXPECT_GT(own, 0.0);
      reach += bond.length / own;
    }
    EXPECT_GT(1.0 + fit.moduli.state * reach, 0.0);
    refused += fit.kind == FitKind::indefinite;
    if (fit.kind != FitKind::indefinite) continue;
    EXPECT_EQ(fit.moduli.state, 0.0);
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace perilink
