#include "assembly/linear_elements.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "assembly/stiffness.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

constexpr double thickness = 0.5;

struct MeshCase {
  Problem problem;
  int count;  // steps along each side of the unit box
};

/// Without this CTest lists the meshes by their bytes.
void PrintTo(const MeshCase& mesh_case, std::ostream* stream) { *stream << mesh_case.count; }

Body mesh_body(const MeshCase& mesh_case, bool two_materials) {
  const Mesh mesh = test::box_mesh(dimension_of(mesh_case.problem), mesh_case.count);
  std::vector<Index> material(static_cast<std::size_t>(mesh.num_cells()), 0);
  for (std::size_t k = 0; two_materials && k < material.size(); k += 3) material[k] = 1;
  return make_mesh_body(mesh, material, thickness);
}

LinearElements elements_of(const MeshCase& mesh_case, const Body& body) {
  const std::vector<IsotropicMaterial> materials = {{200.0, 0.3}, {50.0, 0.1}};
  return make_linear_elements(body.cells, body.particles.positions,
                              body.particles.dim == 2 ? thickness : 1.0, mesh_case.problem,
                              materials);
}

Unknowns all_unknown(const Body& body) {
  const std::size_t size = body.particles.positions.size();
  return number_unknowns(body.particles.dim, std::vector<std::uint8_t>(size, 0),
                         std::vector<double>(size, 0.0));
}

/// u = G x at all particles.
std::vector<double> linear_field(const Body& body, const std::vector<double>& gradient) {
  const std::size_t dim = static_cast<std::size_t>(body.particles.dim);
  std::vector<double> field(body.particles.positions.size(), 0.0);
  for (std::size_t k = 0; k < field.size(); ++k) {
    for (std::size_t axis = 0; axis < dim; ++axis) {
      field[k] += gradient[k % dim * dim + axis] * body.particles.positions[k / dim * dim + axis];
    }
  }
  return field;
}

class Elements : public testing::TestWithParam<MeshCase> {
 protected:
  int dim() const { return dimension_of(GetParam().problem); }
  /// A displacement gradient of no particular kind.
  std::vector<double> gradient() const {
    return dim() == 2
               ? std::vector<double>{0.01, 0.004, -0.006, -0.02}
               : std::vector<double>{0.01, 0.004, 0.003, -0.006, -0.02, 0.007, 0.002, 0.005, 0.015};
  }
};

TEST_P(Elements, StiffnessTimesDisplacementIsTheInternalForce) {
  const Body body = mesh_body(GetParam(), true);
  const LinearElements elements = elements_of(GetParam(), body);
  const Unknowns unknowns = all_unknown(body);
  Eigen::VectorXd u(unknowns.count);
  for (Index k = 0; k < unknowns.count; ++k) u[k] = std::sin(1.0 + 3.0 * k);
  const Eigen::VectorXd force =
      assemble_stiffness(elements, unknowns).selfadjointView<Eigen::Lower>() * u;
  const InternalForce internal =
      internal_force(elements, {u.data(), static_cast<std::size_t>(u.size())});
  const double scale = force.cwiseAbs().maxCoeff();
  for (Index k = 0; k < unknowns.count; ++k) {
    EXPECT_NEAR(force[k], internal.forces[k], 1e-13 * scale);
  }
  EXPECT_NEAR(0.5 * u.dot(force), internal.energy, 1e-13 * internal.energy);
}

TEST_P(Elements, HeldUnknownsLeaveTheRestOfTheMatrixAlone) {
  const Body body = mesh_body(GetParam(), true);
  const LinearElements elements = elements_of(GetParam(), body);
  const Unknowns all = all_unknown(body);
  std::vector<std::uint8_t> held(all.number.size(), 0);
  for (std::size_t k = 0; k < held.size(); k += 4) held[k] = 1;
  const Unknowns some = number_unknowns(dim(), held, std::vector<double>(held.size(), 0.0));
  const Eigen::MatrixXd whole =
      Eigen::MatrixXd(assemble_stiffness(elements, all)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd part =
      Eigen::MatrixXd(assemble_stiffness(elements, some)).selfadjointView<Eigen::Lower>();
  for (std::size_t r = 0; r < held.size(); ++r) {
    for (std::size_t c = 0; c < held.size(); ++c) {
      if (held[r] || held[c]) continue;
      EXPECT_EQ(part(some.number[r], some.number[c]), whole(all.number[r], all.number[c]));
    }
  }
}

TEST_P(Elements, RigidMotionCostsNothing) {
  const Body body = mesh_body(GetParam(), true);
  const std::vector<double> turn = dim() == 2
                                       ? std::vector<double>{0, -1, 1, 0}
                                       : std::vector<double>{0, -1, 0.5, 1, 0, -2, -0.5, 2, 0};
  const InternalForce internal =
      internal_force(elements_of(GetParam(), body), linear_field(body, turn));
  // Round-off of terms near 200.
  for (const double force : internal.forces) EXPECT_NEAR(force, 0.0, 1e-12);
  EXPECT_NEAR(internal.energy, 0.0, 1e-12);
}

TEST_P(Elements, UniformStrainGivesUniformStressWithoutInnerForces) {
  const Body body = mesh_body(GetParam(), false);
  const LinearElements elements = elements_of(GetParam(), body);
  const std::vector<double> g = gradient();
  const std::vector<double> u = linear_field(body, g);
  const std::size_t d = static_cast<std::size_t>(dim());
  const double e = 200.0, nu = 0.3;
  // Hooke's law in its usual form.
  const double trace = dim() == 2 ? g[0] + g[3] : g[0] + g[4] + g[8];
  const auto stress = [&](std::size_t a, std::size_t b) {
    const double strain = 0.5 * (g[a * d + b] + g[b * d + a]);
    const double shear = e / (1.0 + nu) * strain;
    if (a != b) return shear;
    return GetParam().problem == Problem::plane_stress
               ? e / (1.0 - nu * nu) * (strain + nu * (trace - strain))
               : shear + e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)) * trace;
  };
  const std::vector<double> stresses = cell_stresses(elements, cell_strains(elements, u));
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    EXPECT_NEAR(stresses[k], stress(k / d % d, k % d), 1e-12);
  }
  const InternalForce internal = internal_force(elements, u);
  for (Index i = 0; i < body.particles.size(); ++i) {
    const auto x = body.particles.position(i);
    const bool inside =
        std::all_of(x.begin(), x.end(), [](double c) { return c > 0.01 && c < 0.99; });
    for (std::size_t a = 0; inside && a < d; ++a) {
      EXPECT_NEAR(internal.forces[i * d + a], 0.0, 1e-12);
    }
  }
  double density = 0.0;
  for (std::size_t a = 0; a < d; ++a) {
    for (std::size_t b = 0; b < d; ++b) density += 0.5 * stress(a, b) * g[a * d + b];
  }
  const double volume = dim() == 2 ? thickness : 1.0;
  EXPECT_NEAR(internal.energy, density * volume, 1e-13);
}

TEST_P(Elements, TheNumberOfThreadsChangesNothing) {
  const Body body = mesh_body(GetParam(), true);
  const LinearElements elements = elements_of(GetParam(), body);
  const Unknowns unknowns = all_unknown(body);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = assemble_stiffness(elements, unknowns);
  omp_set_num_threads(3);
  const auto three = assemble_stiffness(elements, unknowns);
  omp_set_num_threads(before);
  ASSERT_EQ(one.nonZeros(), three.nonZeros());
  for (Index k = 0; k < one.nonZeros(); ++k) {
    EXPECT_EQ(one.valuePtr()[k], three.valuePtr()[k]);
    EXPECT_EQ(one.innerIndexPtr()[k], three.innerIndexPtr()[k]);
  }
}

INSTANTIATE_TEST_SUITE_P(Problems, Elements,
                         testing::Values(MeshCase{Problem::plane_stress, 4},
                                         MeshCase{Problem::plane_strain, 3},
                                         MeshCase{Problem::three_dimensional, 3}),
                         [](const auto& test) {
                           return test.param.problem == Problem::plane_stress   ? "plane_stress"
                                  : test.param.problem == Problem::plane_strain ? "plane_strain"
                                                                                : "space";
                         });

/// A right triangle with legs 2 and 1: the textbook matrix with E = 1, nu = 0.
TEST(LinearElements, TriangleByHand) {
  Simplices cells;
  cells.vertices = {0, 1, 2};
  cells.material = {0};
  const std::vector<double> positions = {0, 0, 2, 0, 0, 1};
  const std::vector<IsotropicMaterial> materials = {{1.0, 0.0}};
  const LinearElements elements =
      make_linear_elements(cells, positions, 3.0, Problem::plane_stress, materials);
  EXPECT_DOUBLE_EQ(elements.volumes[0], 3.0);
  // Gradients (-1/2, -1), (1/2, 0), (0, 1); lambda = 0, mu = 1/2.
  const Unknowns unknowns = number_unknowns(2, {1, 1, 0, 0, 0, 0}, std::vector<double>(6, 0.0));
  const Eigen::MatrixXd k = Eigen::MatrixXd(assemble_stiffness(elements, unknowns));
  EXPECT_DOUBLE_EQ(k(0, 0), 0.75);   // V (mu g g + mu g.g) = 3 (1/8 + 1/8)
  EXPECT_DOUBLE_EQ(k(1, 1), 0.375);  // V mu g.g
  EXPECT_DOUBLE_EQ(k(2, 1), 0.75);   // V mu g_1x g_2y
  EXPECT_DOUBLE_EQ(k(3, 3), 3.0);
  EXPECT_EQ(k(3, 0), 0.0);
}

TEST(LinearElements, PrincipalValuesAreLargestFirst) {
  // Eigenvalues of [[2, 1], [1, 2]] are 3 and 1.
  const std::vector<double> plane = principal_values(std::vector<double>{2, 1, 1, 2}, 2);
  EXPECT_NEAR(plane[0], 3.0, 1e-15);
  EXPECT_NEAR(plane[1], 1.0, 1e-15);
  const std::vector<double> space =
      principal_values(std::vector<double>{-5, 0, 0, 0, 2, 1, 0, 1, 2}, 3);
  EXPECT_NEAR(space[0], 3.0, 1e-14);
  EXPECT_NEAR(space[2], -5.0, 1e-14);
}

TEST(LinearElements, MeansAtParticlesWeighWithVolume) {
  LinearElements elements;
  elements.cells.vertices = {0, 1, 2, 1, 3, 2};
  elements.cells.material = {0, 0};
  elements.volumes = {1.0, 3.0};
  elements.num_particles = 4;
  EXPECT_EQ(averaged_at_particles(elements, std::vector<double>{2, 10, 6, 30}, 2),
            (std::vector<double>{2, 10, 5, 25, 5, 25, 6, 30}));
}

}  // namespace
}  // namespace perilink
