#include "assembly/distributed_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

Particles particles_at(int dim, const std::vector<double>& positions) {
  Particles particles;
  particles.dim = dim;
  particles.positions = positions;
  particles.volumes.assign(positions.size() / dim, 0.25);
  return particles;
}

Loads no_loads(const Particles& particles, int width) {
  return {std::vector<double>(static_cast<std::size_t>(particles.size()) * width, 0.0)};
}

/// Round-off of sums of a dozen numbers near one.
constexpr double round_off = 1e-14;

/// Along an edge of length L from 0 to L: the integral of N_i s^p over s, times the thickness.
TEST(DistributedLoads, OnAnEdgeAreExactToTheFourthOrder) {
  const Particles particles = particles_at(2, {1.0, 0.0, 1.0, 2.0});
  Facets facets;
  const std::vector<Index> corners = {0, 1};
  facets.append(corners, {2.0 * 0.5, 0.0, 0.0}, 0, no_index);  // thickness 0.5
  const std::vector<Index> all = {0};
  for (int order = 0; order <= 4; ++order) {
    Loads loads = no_loads(particles, 2);
    add_surface_load(
        particles, facets, all,
        [order](std::span<const double> x, const Vector3& normal) {
          EXPECT_DOUBLE_EQ(normal[0], 1.0);
          return Vector3{0.0, std::pow(x[1], order), 0.0};
        },
        loads);
    const double p = order;
    const double second = 0.5 * std::pow(2.0, p + 1) / (p + 2);  // s / L s^p
    const double both = 0.5 * std::pow(2.0, p + 1) / (p + 1);
    EXPECT_NEAR(loads.forces[3], second, 16 * round_off);
    EXPECT_NEAR(loads.forces[1], both - second, 16 * round_off);
    EXPECT_EQ(loads.forces[0], 0.0);
  }
}

/// On the triangle (0,0), (1,0), (0,1) the integral of x^a y^b is a! b! / (a + b + 2)!.
TEST(DistributedLoads, OnATriangleAreExactToTheThirdOrder) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  const auto monomial = [&](int a, int b) {
    return factorial(a) * factorial(b) / factorial(a + b + 2);
  };
  const Particles particles = particles_at(3, {0, 0, 1, 1, 0, 1, 0, 1, 1});
  Facets facets;
  facets.dim = 3;
  const std::vector<Index> corners = {0, 1, 2};
  facets.append(corners, {0.0, 0.0, 0.5}, 0, no_index);
  const std::vector<Index> all = {0};
  for (int a = 0; a <= 3; ++a) {
    for (int b = 0; a + b <= 3; ++b) {
      Loads loads = no_loads(particles, 3);
      add_surface_load(
          particles, facets, all,
          [&](std::span<const double> x, const Vector3& normal) {
            return Vector3{0.0, 0.0, normal[2] * std::pow(x[0], a) * std::pow(x[1], b)};
          },
          loads);
      EXPECT_NEAR(loads.forces[5], monomial(a + 1, b), round_off);
      EXPECT_NEAR(loads.forces[8], monomial(a, b + 1), round_off);
      EXPECT_NEAR(loads.forces[2], monomial(a, b) - monomial(a + 1, b) - monomial(a, b + 1),
                  round_off);
    }
  }
}

/// On the rectangle 2 by 3 with corners in order around it, t = x y: products of edge integrals.
TEST(DistributedLoads, OnARectangleAreBilinear) {
  const Particles particles = particles_at(3, {0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0});
  Facets facets;
  facets.dim = 3;
  const std::vector<Index> corners = {0, 1, 2, 3};
  facets.append(corners, {0.0, 0.0, -6.0}, 0, no_index);
  const std::vector<Index> all = {0};
  Loads loads = no_loads(particles, 6);  // width of particles that rotate
  add_surface_load(
      particles, facets, all,
      [](std::span<const double> x, const Vector3& normal) {
        EXPECT_EQ(normal[2], -1.0);
        return Vector3{x[0] * x[1], 0.0, 0.0};
      },
      loads);
  const double low_x = 4.0 / 6.0, high_x = 4.0 / 3.0;  // integrals of N x over [0, 2]
  const double low_y = 9.0 / 6.0, high_y = 9.0 / 3.0;
  EXPECT_NEAR(loads.forces[0], low_x * low_y, 8 * round_off);
  EXPECT_NEAR(loads.forces[6], high_x * low_y, 8 * round_off);
  EXPECT_NEAR(loads.forces[12], high_x * high_y, 8 * round_off);
  EXPECT_NEAR(loads.forces[18], low_x * high_y, 8 * round_off);
  for (const std::size_t slot : {1u, 2u, 3u, 4u, 5u}) EXPECT_EQ(loads.forces[slot], 0.0);
}

class DistributedOnLattices : public testing::TestWithParam<Pattern> {};

/// On every lattice a linear traction on one side gives the exact resultant, and the exact moments
/// where the sides are resolved by their corners (edges and rectangles).
TEST_P(DistributedOnLattices, GiveExactResultantsOfLinearTractions) {
  LatticeInput input;
  input.pattern = GetParam();
  const bool face_centred = input.pattern == Pattern::face_centred;
  input.spacing = face_centred ? 0.25 * std::sqrt(2.0) : 0.25;
  input.thickness = 0.5;
  const double height = input.pattern == Pattern::hexagonal ? 8.0 / 9.0 : 1.0;
  input.solid = {{{0, 0, 0}, {2, height, 1}}};
  input.material = {0};
  const Body body = make_body(input);
  const int dim = body.particles.dim;
  std::vector<Index> right;
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (body.facets.centre(f, body.particles.positions)[0] > 2.0 - 1e-9) right.push_back(f);
  }
  Loads loads = no_loads(body.particles, dim);
  add_surface_load(
      body.particles, body.facets, right,
      [](std::span<const double> x, const Vector3&) {
        return Vector3{1.0 - 3.0 * x[1], 0, 0};
      },
      loads);
  double force = 0.0, moment = 0.0;
  for (Index i = 0; i < body.particles.size(); ++i) {
    force += loads.forces[i * dim];
    moment += loads.forces[i * dim] * body.particles.position(i)[1];
  }
  const double depth = dim == 2 ? input.thickness : 1.0;
  EXPECT_NEAR(force, depth * (height - 1.5 * height * height), 1e-13);
  if (face_centred) return;
  EXPECT_NEAR(moment, depth * (0.5 * height * height - height * height * height), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Patterns, DistributedOnLattices,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic,
                                         Pattern::face_centred));

TEST(DistributedLoads, OverTheVolumeOfALatticeAreValuesTimesVolumes) {
  const Particles particles = particles_at(2, {0, 0, 1, 0, 2, 0});
  Loads loads = no_loads(particles, 3);
  const std::vector<Index> members = {1, 2};
  add_lumped_body_load(
      particles, members,
      [](std::span<const double> x) {
        return Vector3{x[0], 2.0, 0.0};
      },
      loads);
  EXPECT_EQ(loads.forces, (std::vector<double>{0, 0, 0, 0.25, 0.5, 0, 0.5, 0.5, 0}));
}

/// Two triangles over the rectangle 2 by 3, with the diagonal from particle 0 to 2, and volumes
/// that no rule of areas gives.
TEST(DistributedLoads, ForcesAreSharedByCellsElseByFacetsElseByVolumes) {
  const Particles particles = particles_at(2, {0, 0, 2, 0, 2, 3, 0, 3});
  Simplices cells;
  cells.vertices = {0, 1, 2, 0, 2, 3};
  cells.material = {0, 0};
  const Facets facets = facets_of(cells, particles.positions, 1.0);
  const auto shares = [&](const std::vector<Index>& members, const Simplices& of) {
    const std::vector<double> all = force_shares(particles, of, facets, members);
    std::vector<double> own;
    for (const Index i : members) own.push_back(all[i]);
    return own;
  };
  EXPECT_EQ(shares({0, 1, 2, 3}, cells), (std::vector<double>{6, 3, 6, 3})) << "areas of cells";
  EXPECT_EQ(shares({1, 2}, cells), (std::vector<double>{1.5, 1.5})) << "half the edge of 3 each";
  EXPECT_EQ(shares({0, 2}, cells), (std::vector<double>{0.25, 0.25})) << "no face: volumes";
  EXPECT_EQ(shares({3}, cells), (std::vector<double>{0.25})) << "a point";
  EXPECT_EQ(shares({1, 2}, Simplices{}), (std::vector<double>{0.25, 0.25})) << "a lattice of bonds";
}

/// Integrals of barycentric products over a simplex of volume V in dimension d:
/// d! V a! b! c! / (a + b + c + d)!, here of N_0 N_1^2.
TEST(DistributedLoads, OverCellsIntegrateQuadraticForces) {
  Simplices triangle;
  triangle.vertices = {0, 1, 2};
  triangle.material = {0};
  const Particles plane = particles_at(2, {0, 0, 2, 0, 0, 3});
  Loads loads = no_loads(plane, 2);
  std::vector<std::uint8_t> everyone(3, 1);
  const auto square = [](std::span<const double> x) { return Vector3{0.25 * x[0] * x[0], 0, 0}; };
  add_cell_body_load(plane, triangle, 0.5, everyone, square, loads);
  const double area = 3.0 * 0.5;  // times thickness
  EXPECT_NEAR(loads.forces[0], 2.0 * area * 2.0 / 120.0, round_off);
  EXPECT_NEAR(loads.forces[2], 2.0 * area * 6.0 / 120.0, round_off);
  EXPECT_NEAR(loads.forces[4], 2.0 * area * 2.0 / 120.0, round_off);

  Simplices tetrahedron;
  tetrahedron.dim = 3;
  tetrahedron.vertices = {0, 1, 2, 3};
  tetrahedron.material = {0};
  const Particles space = particles_at(3, {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 5});
  Loads in_space = no_loads(space, 3);
  everyone.assign(4, 1);
  everyone[2] = 0;
  add_cell_body_load(space, tetrahedron, 1.0, everyone, square, in_space);
  const double volume = 5.0;
  EXPECT_NEAR(in_space.forces[0], 6.0 * volume * 2.0 / 720.0, round_off);
  EXPECT_NEAR(in_space.forces[3], 6.0 * volume * 6.0 / 720.0, round_off);
  EXPECT_EQ(in_space.forces[6], 0.0) << "not in the region";
}

}  // namespace
}  // namespace perilink
