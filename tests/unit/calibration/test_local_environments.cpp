#include "calibration/local_environments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "calibration/calibration.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

using namespace test;

/// An L with arms of one length, whose bonds near the surface are free.
struct Corner {
  Problem problem;
  std::vector<LameConstants> materials = {{1.0, 1.0}};
  std::vector<std::uint8_t> free;

  CalibrationInput input(bool alike = true) const {
    CalibrationInput result{problem.body.particles, problem.bonds, materials, free};
    if (alike) result.step = problem.body.lattice.step;
    return result;
  }
  BondOrbits orbits() const {
    return find_environments(input(), problem.body.facets, problem.stiffness, 100000);
  }
};

/// Takes out the bonds that cross the inner corner, where x and y are above the width.
void take_bonds_across(Problem& problem, double width) {
  std::vector<std::uint8_t> keep;
  std::vector<double> axial, bending;
  for (Index b = 0; b < problem.bonds.size(); ++b) {
    const auto p = problem.body.particles.position(problem.bonds.first[b]);
    const auto q = problem.body.particles.position(problem.bonds.second[b]);
    bool crosses = false;
    for (const double t : {0.2, 0.4, 0.5, 0.6, 0.8}) {
      crosses = crosses || (p[0] + t * (q[0] - p[0]) > width + 1e-9 &&
                            p[1] + t * (q[1] - p[1]) > width + 1e-9);
    }
    keep.push_back(!crosses);
    if (crosses) continue;
    axial.push_back(problem.stiffness.axial[b]);
    if (!problem.stiffness.bending.empty()) bending.push_back(problem.stiffness.bending[b]);
  }
  keep_bonds(problem.bonds, keep);
  problem.stiffness = {std::move(axial), std::move(bending), {}};
}

/// \param arm    length along x and y
/// \param width  that of both arms
Corner make_corner(double arm, double width, double depth, double ratio, bool bending = false) {
  LatticeInput lattice = box(Pattern::cubic, 1.0, {arm, width, depth});
  lattice.solid.push_back({{0, 0, 0}, {width, arm, depth}});
  lattice.material.push_back(0);
  Corner corner;
  corner.problem = make_problem(lattice, ratio, 0.0, bending);
  take_bonds_across(corner.problem, width);
  if (bending) corner.materials = {{0.8, 1.3}};
  corner.free.assign(static_cast<std::size_t>(corner.problem.bonds.size()), 1);
  return corner;
}

using Place = std::array<long, 3>;
using Mapping = std::function<Place(const Place&)>;

Place place_of(const Particles& particles, Index i) {
  const auto x = particles.position(i);
  return {std::lround(x[0]), std::lround(x[1]), std::lround(x[2])};
}

/// Numbers of the bonds by the places of their ends.
std::map<std::pair<Place, Place>, Index> bonds_by_place(const Problem& problem) {
  std::map<std::pair<Place, Place>, Index> result;
  for (Index b = 0; b < problem.bonds.size(); ++b) {
    const Place p = place_of(problem.body.particles, problem.bonds.first[b]);
    const Place q = place_of(problem.body.particles, problem.bonds.second[b]);
    result[{p, q}] = result[{q, p}] = b;
  }
  return result;
}

/// Number of bonds that have an image, all in the same class as it.
int count_images(const Corner& corner, const Mapping& map) {
  const BondOrbits orbits = corner.orbits();
  int images = 0;
  const auto numbers = bonds_by_place(corner.problem);
  for (const auto& [ends, bond] : numbers) {
    const auto image = numbers.find({map(ends.first), map(ends.second)});
    if (image == numbers.end()) continue;
    ++images;
    EXPECT_EQ(orbits.of_bond(bond), orbits.of_bond(image->second));
  }
  return images;
}

TEST(LocalEnvironments, MirroredBondsLieAlike) {
  const Corner corner = make_corner(9, 4, 5, 2.0);
  const int all = 2 * corner.problem.bonds.size();
  EXPECT_EQ(count_images(corner, [](const Place& p) { return Place{p[1], p[0], p[2]}; }), all);
  EXPECT_EQ(count_images(corner, [](const Place& p) { return Place{p[0], p[1], 5 - p[2]}; }), all);
}

/// Bonds of the middle of an arm are moved along it; those beside its end are not alike.
TEST(LocalEnvironments, MovedBondsLieAlikeFarFromTheEnds) {
  const Corner corner = make_corner(24, 4, 4, 2.0);
  const BondOrbits orbits = corner.orbits();
  const auto numbers = bonds_by_place(corner.problem);
  const auto class_at = [&](long x) {
    return orbits.of_bond(numbers.at({{x, 0, 0}, {x + 1, 0, 0}}));
  };
  EXPECT_EQ(class_at(12), class_at(13));
  EXPECT_EQ(class_at(12), class_at(15));
  EXPECT_NE(class_at(12), class_at(23));
  EXPECT_NE(class_at(12), class_at(21));
  // A longer arm has no more kinds of places.
  EXPECT_EQ(make_corner(34, 4, 4, 2.0).orbits().representatives.size(),
            orbits.representatives.size());
}

/// All particles of a kind have bonds of the same classes, and the same forces to balance.
TEST(LocalEnvironments, PlacesOfAKindHaveTheSameBonds) {
  const Corner corner = make_corner(16, 4, 4, 2.0);
  const Problem& problem = corner.problem;
  const BondOrbits orbits = corner.orbits();
  std::vector<std::vector<Index>> at(static_cast<std::size_t>(problem.body.particles.size()));
  for (Index b = 0; b < problem.bonds.size(); ++b) {
    at[problem.bonds.first[b]].push_back(orbits.views[b][0]);
    at[problem.bonds.second[b]].push_back(orbits.views[b][1]);
  }
  for (auto& views : at) std::sort(views.begin(), views.end());
  std::vector<std::vector<Index>> known;
  for (const Index i : orbits.representatives) known.push_back(at[i]);
  std::sort(known.begin(), known.end());
  for (const auto& views : at) {
    EXPECT_TRUE(std::binary_search(known.begin(), known.end(), views));
  }
}

TEST(LocalEnvironments, AreNotLookedForAnyFartherWhereThereAreTooMany) {
  const Corner corner = make_corner(9, 4, 5, 2.0);
  const BondOrbits none =
      find_environments(corner.input(), corner.problem.body.facets, corner.problem.stiffness, 1);
  EXPECT_TRUE(none.representatives.empty());
}

TEST(LocalEnvironments, StiffnessTellsBondsApart) {
  Corner corner = make_corner(9, 4, 5, 2.0);
  corner.problem.stiffness.axial[0] *= 1.001;
  const BondOrbits orbits = corner.orbits();
  const auto alike = [&](Index b) { return orbits.of_bond(b) == orbits.of_bond(0); };
  for (Index b = 1; b < corner.problem.bonds.size(); ++b) EXPECT_FALSE(alike(b));
}

/// Without and with moments: forces are in balance everywhere, and bonds that are mirrored have
/// the same stiffness.
TEST(LocalEnvironments, WholeBodiesAreCalibratedByTheirKindsOfPlaces) {
  for (const auto& [ratio, bending] :
       {std::pair(2.0, false), std::pair(3.0, false), std::pair(2.0, true)}) {
    Corner corner = make_corner(26, 6, 6, ratio, bending);
    Problem& problem = corner.problem;
    ASSERT_TRUE(equivalent_bonds(corner.input(), problem.body.facets, problem.stiffness));
    const CalibrationReport report =
        calibrate_bonds(corner.input(), {}, problem.body.facets, problem.stiffness);
    EXPECT_TRUE(report.alike);
    EXPECT_GT(report.residual_before, 0.1);
    EXPECT_LT(report.residual_after, 1e-10);
    EXPECT_LT(report.moment_after, 1e-10);
    EXPECT_EQ(report.unmet, 0);
    const auto numbers = bonds_by_place(problem);
    const auto mirrored = [](const Place& p) { return Place{p[1], p[0], p[2]}; };
    for (const auto& [ends, bond] : numbers) {
      const Index image = numbers.at({mirrored(ends.first), mirrored(ends.second)});
      EXPECT_EQ(problem.stiffness.axial[bond], problem.stiffness.axial[image]);
    }
  }
}

/// The change from one is hardly larger than that of bonds on their own.
TEST(LocalEnvironments, ChangeTheStiffnessesLittleMore) {
  const auto change = [](bool alike) {
    Corner corner = make_corner(20, 5, 5, 2.0);
    const std::vector<double> start = corner.problem.stiffness.axial;
    const CalibrationReport report = calibrate_bonds(
        corner.input(alike), {}, corner.problem.body.facets, corner.problem.stiffness);
    EXPECT_EQ(report.alike, alike);
    EXPECT_LT(report.residual_after, 1e-10);
    double sum = 0.0;
    for (std::size_t b = 0; b < start.size(); ++b) {
      const double part = corner.problem.stiffness.axial[b] / start[b] - 1.0;
      sum += part * part;
    }
    return sum;
  };
  const double single = change(false), alike = change(true);
  EXPECT_GE(alike, single * (1.0 - 1e-6));
  EXPECT_LT(alike, 1.05 * single);
}

/// Where hardly anything repeats, single bonds are cheaper.
TEST(LocalEnvironments, AreNotLookedForWhereLittleRepeats) {
  LatticeInput lattice = box(Pattern::cubic, 1.0, {12, 5, 5});
  const std::array<Vector3, 4> corners = {{{3, 8, 4}, {9, 6, 8}, {6, 11, 9}, {5, 7, 10}}};
  for (const Vector3& upper : corners) {
    lattice.solid.push_back({{0, 0, 0}, upper});
    lattice.material.push_back(0);
  }
  Corner stairs;
  stairs.problem = make_problem(lattice, 3.0, 0.0, false);
  stairs.free.assign(static_cast<std::size_t>(stairs.problem.bonds.size()), 1);
  EXPECT_FALSE(
      equivalent_bonds(stairs.input(), stairs.problem.body.facets, stairs.problem.stiffness));
}

}  // namespace
}  // namespace perilink
