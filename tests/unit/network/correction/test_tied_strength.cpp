#include "network/correction/tied_strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace perilink {
namespace {

/// Rows of particles over each other, each bonded to the next and the one after: bonds of stiffness
/// one and 1/4 carry the same energy, and the lowest row stands on a glued face.
struct Ladder {
  Network network;

  explicit Ladder(int rows) {
    Particles& particles = network.particles;
    particles.dim = network.bonds.dim = network.facets.dim = 2;
    for (int row = 0; row < rows; ++row) {
      particles.positions.insert(particles.positions.end(), {0.0, static_cast<double>(row)});
      particles.volumes.push_back(1.0);
      particles.kind.push_back(ParticleKind::solid);
      particles.material.push_back(0);
    }
    for (int row = 0; row < rows; ++row) {
      for (const int step : {1, 2}) {
        if (row + step >= rows) continue;
        network.bonds.append(particles, row, row + step);
        network.stiffness.push_back(1.0 / (step * step));
        network.critical_stretch.push_back(0.1);
      }
    }
    particles.positions.insert(particles.positions.end(), {1.0, 0.0});  // other end of the face
    particles.volumes.push_back(1.0);
    particles.kind.push_back(ParticleKind::solid);
    particles.material.push_back(0);
    network.facets.append(std::vector<Index>{0, rows}, {0.0, -1.0, 0.0}, 0, no_index);
    network.facets.tied.push_back(1);
  }

  /// What the bonds that cross a height hold, over k xi^2 s_c^2 of one as they were.
  double energy(double height) const {
    double sum = 0.0;
    for (Index b = 0; b < network.bonds.size(); ++b) {
      const double from = network.particles.position(network.bonds.first[b])[1] - height;
      const double to = network.particles.position(network.bonds.second[b])[1] - height;
      if (from * to > 0.0) continue;
      const double held = network.critical_stretch[b] * network.bonds.lengths[b];
      sum += network.stiffness[b] * held * held / 0.01;
    }
    return sum;
  }
};

/// The cut at 1/2 misses one of the three bonds inside, and carries 1.5 of 2 units of force.
TEST(TiedStrength, CutsBesideTheFaceHoldAsMuchForTheirForceAsInside) {
  Ladder ladder(12);
  EXPECT_NEAR(ladder.energy(0.5), 2.0, 1e-12);
  EXPECT_NEAR(ladder.energy(6.5), 3.0, 1e-12);
  const std::vector<double> before = ladder.network.critical_stretch;
  toughen_tied_faces(2.0, 1.0, ladder.network);
  // Factors on stretches are multiples of 0.01.
  EXPECT_NEAR(ladder.energy(0.5), 3.0 * 1.5 / 2.0, 0.03);
  EXPECT_NEAR(ladder.energy(6.5), 3.0, 1e-12);
  for (std::size_t b = 0; b < before.size(); ++b) {
    EXPECT_GE(ladder.network.critical_stretch[b], before[b] - 1e-15);
  }
}

TEST(TiedStrength, PartsWithoutAnInsideStayAsTheyAre) {
  Ladder ladder(3);
  const std::vector<double> before = ladder.network.critical_stretch;
  toughen_tied_faces(2.0, 1.0, ladder.network);
  EXPECT_EQ(ladder.network.critical_stretch, before);
}

}  // namespace
}  // namespace perilink
