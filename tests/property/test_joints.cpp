// Bodies of two materials that meet in a plane: fields that are linear on either side of it, with
// the same strains along it and the same tractions across it, are in equilibrium.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "assembly/internal_force.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "network/builder/network_builder.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

constexpr double height_of_joint = 0.5;

struct JointCase {
  const char* name;
  Pattern pattern;
  int dim;
  double contrast;  ///< modulus above over that below
  double ratio;     ///< horizon over spacing
};

/// Without this CTest lists the cases by their bytes.
void PrintTo(const JointCase& tested, std::ostream* stream) { *stream << tested.name; }

/// The unit box, of the second material where the last axis is above the joint.
struct JointBody {
  Body body;
  NetworkInput input;
  Network network;

  JointBody(const JointCase& tested, int count) {
    const int last = tested.dim - 1;
    if (tested.pattern == Pattern::irregular) {
      Mesh mesh = test::box_mesh(tested.dim, count);
      for (Index i = 0; i < mesh.num_points(); ++i) {  // back onto the joint
        double& x = mesh.positions[i * tested.dim + last];
        if (std::abs(x - height_of_joint) < 0.2 / count) x = height_of_joint;
      }
      std::vector<Index> material;
      for (Index e = 0; e < mesh.num_cells(); ++e) {
        double middle = 0.0;
        for (int c = 0; c <= tested.dim; ++c) {
          middle += mesh.positions[mesh.cells[e * (tested.dim + 1) + c] * tested.dim + last];
        }
        material.push_back(middle > height_of_joint * (tested.dim + 1) ? 1 : 0);
      }
      body = make_mesh_body(mesh, material, 1.0);
      body.lattice.surface = Surface::calibrated;
      input.horizon = tested.ratio * body.lattice.spacing;
    } else {
      LatticeInput lattice;
      lattice.pattern = tested.pattern;
      lattice.surface = Surface::calibrated;
      lattice.spacing = 1.0 / count;
      Box below{{0, 0, 0}, {1, 1, 1}}, above = below;
      below.upper[last] = above.lower[last] = height_of_joint;
      lattice.solid = {below, above};
      lattice.material = {0, 1};
      lattice.horizon = tested.ratio * lattice.spacing;
      body = make_body(lattice);
      input.solid = lattice.solid;
      input.horizon = lattice.horizon;
    }
    input.problem = tested.dim == 2 ? Problem::plane_stress : Problem::three_dimensional;
    input.materials = {{3.0}, {3.0 * tested.contrast}};
    network = build_network(body, input);
  }
};

using Gradient = std::array<Vector3, 3>;

/// Displacement gradients below and above: strains along the joint and tractions across it are the
/// same. \param field  a component of the strain below, axes ascending
std::array<Gradient, 2> gradients(const std::array<LameConstants, 2>& constants, int dim,
                                  std::array<int, 2> field) {
  const int n = dim - 1;
  std::array<Gradient, 2> sides{};
  for (int side = 0; side < 2; ++side) {
    const LameConstants& own = constants[side];
    const LameConstants& below = constants[0];
    const double across = own.lambda + 2.0 * own.mu;
    Gradient& g = sides[side];
    if (field[0] == n) {
      g[n][n] = (below.lambda + 2.0 * below.mu) / across;
    } else if (field[1] == n) {
      g[field[0]][n] = below.mu / own.mu;
    } else {
      g[field[0]][field[1]] = 1.0;
      if (field[0] == field[1]) g[n][n] = (below.lambda - own.lambda) / across;
    }
  }
  return sides;
}

/// Largest difference between the forces of bonds and the tractions on the surface, over those on a
/// facet.
double largest_rest(const JointBody& joint, std::array<int, 2> field) {
  const Network& network = joint.network;
  const int dim = network.dim();
  const std::array<LameConstants, 2> constants = {
      lame_constants(joint.input, joint.input.materials[0]),
      lame_constants(joint.input, joint.input.materials[1])};
  const std::array<Gradient, 2> sides = gradients(constants, dim, field);
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    const Gradient& g = sides[x[dim - 1] > height_of_joint ? 1 : 0];
    for (int a = 0; a < dim; ++a) {
      double u = g[a][dim - 1] * (x[dim - 1] - height_of_joint);
      for (int b = 0; b + 1 < dim; ++b) u += g[a][b] * x[b];
      motion.push_back(u);
    }
  }
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  std::vector<double> rest = internal_force(network, intact, motion).forces;
  double size = 0.0;
  for (Index f = 0; f < network.facets.size(); ++f) {
    if (!network.facets.on_surface(f)) continue;
    const Gradient& g = sides[network.facets.inside[f]];
    const LameConstants& own = constants[network.facets.inside[f]];
    const auto area = network.facets.area_vector(f);
    double trace = 0.0;
    for (int a = 0; a < dim; ++a) trace += g[a][a];
    for (int a = 0; a < dim; ++a) {
      double force = own.lambda * trace * area[a];
      for (int b = 0; b < dim; ++b) force += own.mu * (g[a][b] + g[b][a]) * area[b];
      size = std::max(size, std::abs(force));
      for (Index c = network.facets.corners.offsets[f]; c < network.facets.corners.offsets[f + 1];
           ++c) {
        rest[network.facets.corners.values[c] * dim + a] -= network.facets.shares[c] * force;
      }
    }
  }
  double largest = 0.0;
  for (const double value : rest) largest = std::max(largest, std::abs(value));
  return largest / size;
}

class PiecewiseLinearFields : public testing::TestWithParam<JointCase> {};

TEST_P(PiecewiseLinearFields, AreInEquilibrium) {
  const JointBody joint(GetParam(), 8);
  EXPECT_LT(joint.network.calibration->residual_after, 1e-9);
  for (int a = 0; a < GetParam().dim; ++a) {
    for (int b = a; b < GetParam().dim; ++b) {
      // Round-off of the calibration, which is met to 1e-10.
      EXPECT_LT(largest_rest(joint, {a, b}), 1e-8) << "field " << a << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Joints, PiecewiseLinearFields,
    testing::Values(JointCase{"rectangular", Pattern::rectangular, 2, 8.0, 3.0},
                    JointCase{"rectangular_softer", Pattern::rectangular, 2, 0.2, 3.0},
                    JointCase{"short_horizon", Pattern::rectangular, 2, 3.0, 2.0},
                    JointCase{"hexagonal", Pattern::hexagonal, 2, 8.0, 3.0},
                    JointCase{"mesh", Pattern::irregular, 2, 4.0, 3.0},
                    JointCase{"cubic", Pattern::cubic, 3, 4.0, 3.0}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace perilink
