#include "analysis/quasistatic/equilibrium/body/crack_faces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Particles of a square lattice within `half` of the origin in both directions, turned by an
/// angle. All pairs up to three spacings have bonds of the stiffness one over their length.
Network lattice(int half, double angle) {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  std::vector<std::array<int, 2>> places;
  for (int x = -half; x <= half; ++x) {
    for (int y = -half; y <= half; ++y) {
      places.push_back({x, y});
      network.particles.positions.push_back(x * std::cos(angle) - y * std::sin(angle));
      network.particles.positions.push_back(x * std::sin(angle) + y * std::cos(angle));
    }
  }
  const auto count = static_cast<Index>(places.size());
  network.particles.volumes.assign(places.size(), 1.0);
  network.particles.material.assign(places.size(), 0);
  network.particles.kind.assign(places.size(), ParticleKind::solid);
  for (Index i = 0; i < count; ++i) {
    for (Index j = i + 1; j < count; ++j) {
      const int dx = places[j][0] - places[i][0], dy = places[j][1] - places[i][1];
      if (dx * dx + dy * dy > 9) continue;
      network.bonds.append(network.particles, i, j);
      network.stiffness.push_back(1.0 / std::hypot(dx, dy));
    }
  }
  network.laws = {BondLaw::brittle().closing()};
  network.critical_stretch.assign(network.stiffness.size(), 1e-3);
  network.first_slip_spring = network.first_bar_element = network.num_elements();
  return network;
}

TEST(CrackFaces, ABondThatBreaksAloneStaysAStrut) {
  const Network network = lattice(4, 0.3);
  for (Index e = 0; e < network.num_elements(); e += 17) {
    CrackFaces faces(network);
    faces.set_broken(e, true);
    const auto ratios = faces.ratios_of(faces.broken_around(std::array{e}));
    ASSERT_EQ(ratios.size(), 1u);
    EXPECT_EQ(ratios[0].first, e);
    EXPECT_NEAR(ratios[0].second, 1.0, 1e-12);
  }
}

/// Bonds across a straight cut between two rows: those along the normal carry the normal stress of
/// all bonds in uniaxial stress, the oblique ones nothing, whatever the direction of the cut.
TEST(CrackFaces, BondsAlongTheNormalCarryThePressureOfAll) {
  for (const double angle : {0.0, 0.3, 0.5 * std::numbers::pi}) {
    constexpr int half = 12;
    const Network network = lattice(half, angle);
    const double normal[2] = {-std::sin(angle), std::cos(angle)};
    const auto height = [&](Index i) {
      const auto x = network.particles.position(i);
      return normal[0] * x[0] + normal[1] * x[1];
    };
    CrackFaces faces(network);
    std::vector<Index> broken;
    for (Index e = 0; e < network.num_elements(); ++e) {
      const double first = height(network.bonds.first[e]), second = height(network.bonds.second[e]);
      if ((first > 0.5) == (second > 0.5)) continue;
      faces.set_broken(e, true);
      broken.push_back(e);
    }
    double wanted = 0.0, carried = 0.0;
    std::map<Index, double> ratios;
    for (const auto& [e, ratio] : faces.ratios_of(faces.broken_around(broken))) ratios[e] = ratio;
    ASSERT_EQ(ratios.size(), broken.size());
    for (const Index e : broken) {
      // The column in the middle repeats itself; at the ends of the cut normals are less exact.
      if (network.bonds.first[e] / (2 * half + 1) != half) continue;
      const auto n = network.bonds.direction(e);
      const double square = std::pow(n[0] * normal[0] + n[1] * normal[1], 2);
      // Normal part of the force in the strain of uniaxial stress with Poisson's ratio 1/3, times
      // the distance across the crack.
      const double pressure = network.stiffness[e] * std::pow(network.bonds.length(e), 2) * square *
                              (square - (1.0 - square) / 3.0);
      wanted += pressure;
      carried += ratios[e] * pressure;
      if (square < 0.9) {
        EXPECT_EQ(ratios[e], 0.0) << angle;
      }
      if (square > 0.999) {
        EXPECT_GT(ratios[e], 1.0) << angle;
      }
    }
    EXPECT_NEAR(carried, wanted, 1e-10 * wanted);
  }
}

/// Ratios depend on the broken bonds only, not on the order in which they broke.
TEST(CrackFaces, ABondThatIsWholeAgainLeavesTheRatiosAsBefore) {
  constexpr double angle = 0.3;
  const Network network = lattice(6, angle);
  const auto is_above = [&](Index i) {  // the middle of two rows
    const auto x = network.particles.position(i);
    return std::cos(angle) * x[1] - std::sin(angle) * x[0] > 0.5;
  };
  std::vector<Index> some, more;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const bool crosses = is_above(network.bonds.first[e]) != is_above(network.bonds.second[e]);
    if (crosses) some.push_back(e);
    if (!crosses && e % 3 == 0) more.push_back(e);
  }
  CrackFaces faces(network), others(network);
  for (const Index e : some) faces.set_broken(e, true);
  for (const Index e : more) others.set_broken(e, true);
  for (auto e = some.rbegin(); e != some.rend(); ++e) others.set_broken(*e, true);
  EXPECT_NE(faces.ratios_of(some), others.ratios_of(some));
  for (const Index e : more) others.set_broken(e, false);
  EXPECT_EQ(faces.ratios_of(some), others.ratios_of(some));
  EXPECT_EQ(faces.take_around_broken(), others.take_around_broken());
}

}  // namespace
}  // namespace perilink
