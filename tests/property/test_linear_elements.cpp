// Linear elements on lattices and meshes: patch test and second-order convergence of displacements.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/study/convergence.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

constexpr double youngs_modulus = 3.0;
constexpr double poissons_ratio = 0.2;  // differs from the bonds' ratio in the plane and in space

using Field = std::function<Vector3(const Vector3&)>;

/// Unit box of a lattice or an irregular mesh, with its elements.
struct ElementBox {
  Body body;
  LinearElements elements;

  ElementBox(Pattern pattern, int dim, int count) {
    if (pattern == Pattern::irregular) {
      const Mesh mesh = test::box_mesh(dim, count);
      body = make_mesh_body(mesh, std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0),
                            1.0);
    } else {
      LatticeInput input;
      input.pattern = pattern;
      input.spacing = 1.0 / count;
      input.solid = {{{0, 0, 0}, {1, 1, 1}}};
      input.material = {0};
      body = make_body(input);
      body.cells = triangulate(input, body);
      body.facets = facets_of(body.cells, body.particles.positions, 1.0);
      body.particles.volumes = shape_integrals(body.cells, body.particles.positions, 1.0);
    }
    const std::vector<IsotropicMaterial> materials = {{youngs_modulus, poissons_ratio}};
    elements = make_linear_elements(body.cells, body.particles.positions, 1.0,
                                    dim == 2 ? Problem::plane_strain : Problem::three_dimensional,
                                    materials);
  }

  Vector3 position(Index i) const {
    const auto x = body.particles.position(i);
    return {x[0], x[1], x.size() == 3 ? x[2] : 0.0};
  }
  std::vector<double> sample(const Field& field) const {
    std::vector<double> values;
    for (Index i = 0; i < body.particles.size(); ++i) {
      const Vector3 u = field(position(i));
      values.insert(values.end(), u.begin(), u.begin() + body.particles.dim);
    }
    return values;
  }
  bool on_surface(Index i) const {
    const auto x = body.particles.position(i);
    return std::any_of(x.begin(), x.end(), [](double c) { return c < 1e-9 || c > 1.0 - 1e-9; });
  }
};

struct BoxCase {
  const char* name;
  Pattern pattern;
  int dim;
};

/// Prints the name; otherwise CTest would list the bytes of a box.
void PrintTo(const BoxCase& box, std::ostream* stream) { *stream << box.name; }

class LinearElementsOn : public testing::TestWithParam<BoxCase> {};

/// Tractions of a uniform stress on the whole surface with a statically determinate support at
/// three corners give the linear field. Condition numbers near 1e3 leave 13 digits.
TEST_P(LinearElementsOn, ThePatchTestHoldsUnderTractions) {
  const int dim = GetParam().dim;
  const ElementBox box(GetParam().pattern, dim, 5);
  const double gradient[3][3] = {
      {0.01, 0.004, -0.003}, {0.004, -0.02, 0.006}, {-0.003, 0.006, 0.015}};
  const Field exact = [&](const Vector3& x) {
    Vector3 u{};
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b) u[a] += gradient[a][b] * x[b];
    }
    return u;
  };
  const double mu = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
  const double lambda = 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio);
  double trace = 0.0;
  for (int a = 0; a < dim; ++a) trace += gradient[a][a];

  const std::vector<double> expected = box.sample(exact);
  Loads loads;
  loads.forces.assign(expected.size(), 0.0);
  for (Index f = 0; f < box.body.facets.size(); ++f) {
    const auto corners = box.body.facets.corners.row(f);
    for (const Index i : corners) {
      for (int a = 0; a < dim; ++a) {
        for (int b = 0; b < dim; ++b) {
          const double stress = 2.0 * mu * gradient[a][b] + (a == b ? lambda * trace : 0.0);
          loads.forces[static_cast<std::size_t>(i) * dim + a] +=
              stress * box.body.facets.area_vector(f)[b] / static_cast<double>(corners.size());
        }
      }
    }
  }
  // Fixed: all displacements of the origin, those of (1, 0, 0) across x, that of (0, 1, 0) along z.
  std::vector<std::uint8_t> held(expected.size(), 0);
  for (Index i = 0; i < box.body.particles.size(); ++i) {
    const Vector3 x = box.position(i);
    const std::size_t slot = static_cast<std::size_t>(i) * dim;
    const auto near = [&](double a, double b, double c) {
      return std::hypot(x[0] - a, x[1] - b, x[2] - c) < 1e-9;
    };
    for (int axis = 0; axis < dim; ++axis) {
      held[slot + axis] =
          near(0, 0, 0) || (axis > 0 && near(1, 0, 0)) || (axis > 1 && near(0, 1, 0));
    }
  }
  std::vector<double> prescribed = expected;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (!held[k]) prescribed[k] = 0.0;
  }
  const ElasticResult result =
      run_elastic_analysis(box.elements, number_unknowns(dim, held, prescribed), loads, 1);
  EXPECT_LT(relative_l2_error(box.body.particles, result.displacement, expected, false), 1e-12);
}

/// u = (sin(x + 2y), cos(2x - y)[, sin(x - z)]) with its body force, prescribed on the surface.
TEST_P(LinearElementsOn, TheErrorOfASmoothSolutionFallsWithOrderTwo) {
  const int dim = GetParam().dim;
  const double mu = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
  const double lambda = 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio);
  const double third = dim == 3 ? 1.0 : 0.0;
  const Field exact = [&](const Vector3& x) {
    return Vector3{std::sin(x[0] + 2 * x[1]), std::cos(2 * x[0] - x[1]),
                   third * std::sin(x[0] - x[2])};
  };
  // b = -mu laplace(u) - (lambda + mu) grad(div u), div u = cos(x + 2y) + sin(2x - y) - cos(x - z)
  const Field body_force = [&](const Vector3& x) {
    const double s = std::sin(x[0] + 2 * x[1]), c = std::cos(2 * x[0] - x[1]);
    const double w = third * std::sin(x[0] - x[2]);
    const double both = lambda + mu;
    return Vector3{5 * mu * s - both * (-s + 2 * c + w), 5 * mu * c - both * (-2 * s - c),
                   2 * mu * w + both * w};
  };
  std::vector<double> errors;
  const std::vector<int> counts = dim == 2 ? std::vector<int>{16, 32} : std::vector<int>{8, 16};
  for (const int count : counts) {
    const ElementBox box(GetParam().pattern, dim, count);
    const std::vector<double> expected = box.sample(exact);
    Loads loads;
    loads.forces = box.sample(body_force);
    std::vector<double> prescribed = expected;
    std::vector<std::uint8_t> held(expected.size(), 0);
    for (std::size_t k = 0; k < held.size(); ++k) {
      const Index i = static_cast<Index>(k / static_cast<std::size_t>(dim));
      loads.forces[k] *= box.body.particles.volumes[i];
      held[k] = box.on_surface(i);
      if (!held[k]) prescribed[k] = 0.0;
    }
    const ElasticResult result =
        run_elastic_analysis(box.elements, number_unknowns(dim, held, prescribed), loads, 1);
    errors.push_back(relative_l2_error(box.body.particles, result.displacement, expected, false));
  }
  EXPECT_LT(errors[1], 0.01);
  const double order = std::log2(errors[0] / errors[1]);
  EXPECT_GT(order, 1.9) << errors[0];
}

INSTANTIATE_TEST_SUITE_P(Subdomains, LinearElementsOn,
                         testing::Values(BoxCase{"rectangular", Pattern::rectangular, 2},
                                         BoxCase{"hexagonal", Pattern::hexagonal, 2},
                                         BoxCase{"irregular", Pattern::irregular, 2},
                                         BoxCase{"cubic", Pattern::cubic, 3},
                                         BoxCase{"tetrahedra", Pattern::irregular, 3}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace perilink
