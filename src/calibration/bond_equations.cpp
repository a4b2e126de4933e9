#include "calibration/bond_equations.hpp"

#include <array>

namespace perilink {
namespace {

double delta(int a, int b) { return a == b ? 1.0 : 0.0; }

/// Calls f(a, b, c) for every component of a symmetric third-order tensor.
template <class Function>
void for_third_order(int dim, Function f) {
  for (int a = 0; a < dim; ++a) {
    for (int b = a; b < dim; ++b) {
      for (int c = b; c < dim; ++c) f(a, b, c);
    }
  }
}

/// Calls f(a, b, c, d) for the independent components of a tensor of moduli: by its major and minor
/// symmetries or, where it is symmetric in all indices, with ascending indices.
template <class Function>
void for_moduli(int dim, bool symmetric, Function f) {
  constexpr std::array<std::array<int, 2>, 6> all_pairs = {
      {{0, 0}, {1, 1}, {0, 1}, {2, 2}, {1, 2}, {0, 2}}};
  if (!symmetric) {
    const int pairs = dim == 2 ? 3 : 6;
    for (int i = 0; i < pairs; ++i) {
      for (int j = i; j < pairs; ++j) {
        f(all_pairs[i][0], all_pairs[i][1], all_pairs[j][0], all_pairs[j][1]);
      }
    }
    return;
  }
  for (int a = 0; a < dim; ++a) {
    for_third_order(dim, [&](int b, int c, int d) {
      if (b >= a) f(a, b, c, d);
    });
  }
}

/// Fills the components of xi^2 (nn - I/dim) and returns the next position.
double* fill_couple(int dim, double length, std::span<const double> n, double* row) {
  const double square = length * length;
  for (int a = 0; a < dim; ++a) {
    for (int b = a + 1; b < dim; ++b) *row++ = square * n[a] * n[b];
  }
  for (int a = 0; a + 1 < dim; ++a) *row++ = 0.5 * square * (n[a] * n[a] - n[a + 1] * n[a + 1]);
  return row;
}

}  // namespace

void ForceRows::axial(double length, std::span<const double> n, double* row) const {
  for_third_order(dim, [&](int a, int b, int c) { *row++ = length * n[a] * n[b] * n[c]; });
  for (int k = third_order(); k < balance(); ++k) *row++ = 0.0;
  if (dilatation) *row = 0.5 * length * length;
}

void ForceRows::shear(double length, std::span<const double> n, double* row) const {
  for_third_order(dim, [&](int a, int b, int c) { *row++ = -length * n[a] * n[b] * n[c]; });
  for (int a = 0; a < dim; ++a) *row++ = length * n[a];
  row = fill_couple(dim, length, n, row);
  if (dilatation) *row = 0.0;
}

void ForceRows::right(const Vector3& lambda_area, const Vector3& mu_area, double* row) const {
  for_third_order(dim, [&](int a, int b, int c) {
    *row++ = -(delta(a, b) * lambda_area[c] + delta(a, c) * lambda_area[b] +
               delta(b, c) * lambda_area[a]);
  });
  if (bending) {
    for (int a = 0; a < dim; ++a) *row++ = -2.0 * (mu_area[a] - lambda_area[a]);
  }
  for (int k = odd(); k < count(); ++k) *row++ = 0.0;
}

void ModuliRows::axial(double length, std::span<const double> n, double* row) const {
  const double half_square = 0.5 * length * length;
  for_moduli(dim, !bending,
             [&](int a, int b, int c, int d) { *row++ = half_square * n[a] * n[b] * n[c] * n[d]; });
  for (int k = moduli(); k < count(); ++k) *row++ = 0.0;
}

void ModuliRows::shear(double length, std::span<const double> n, double* row) const {
  const double half_square = 0.5 * length * length;
  for_moduli(dim, !bending, [&](int a, int b, int c, int d) {
    const double product = 0.25 * (delta(a, c) * n[b] * n[d] + delta(a, d) * n[b] * n[c] +
                                   delta(b, c) * n[a] * n[d] + delta(b, d) * n[a] * n[c]);
    *row++ = half_square * (product - n[a] * n[b] * n[c] * n[d]);
  });
  fill_couple(dim, length, n, row);
}

void ModuliRows::right(double volume, const LameConstants& constants, double* row) const {
  for_moduli(dim, !bending, [&](int a, int b, int c, int d) {
    *row++ = volume * (constants.lambda * delta(a, b) * delta(c, d) +
                       constants.mu * (delta(a, c) * delta(b, d) + delta(a, d) * delta(b, c)));
  });
  for (int k = moduli(); k < count(); ++k) *row++ = 0.0;
}

LameConstants constants_across(const Facets& facets, Index facet,
                               std::span<const LameConstants> materials) {
  LameConstants jump = materials[facets.inside[facet]];
  if (facets.on_surface(facet)) return jump;
  jump.lambda -= materials[facets.outside[facet]].lambda;
  jump.mu -= materials[facets.outside[facet]].mu;
  return jump;
}

std::vector<double> boundary_forces(const ForceRows& equations, const Facets& facets,
                                    std::span<const LameConstants> materials, Index num_particles) {
  std::vector<Vector3> lambda(static_cast<std::size_t>(num_particles), Vector3{});
  std::vector<Vector3> mu = lambda;
  for (Index f = 0; f < facets.size(); ++f) {
    const LameConstants jump = constants_across(facets, f, materials);
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      const Index i = facets.corners.values[c];
      for (int a = 0; a < equations.dim; ++a) {
        const double area = facets.shares[c] * facets.area_vector(f)[a];
        lambda[i][a] += jump.lambda * area;
        mu[i][a] += jump.mu * area;
      }
    }
  }
  const std::size_t rows = static_cast<std::size_t>(equations.count());
  std::vector<double> right(num_particles * rows);
  for (Index i = 0; i < num_particles; ++i)
    equations.right(lambda[i], mu[i], right.data() + i * rows);
  return right;
}

std::vector<double> forces_out_of_balance(const ForceRows& equations, const Facets& facets,
                                          std::span<const LameConstants> materials,
                                          const Bonds& bonds, const BondStiffness& stiffness,
                                          Index num_particles) {
  std::vector<double> rest = boundary_forces(equations, facets, materials, num_particles);
  const std::size_t rows = static_cast<std::size_t>(equations.count());
  const std::size_t odd = static_cast<std::size_t>(equations.odd());
  std::vector<double> row(rows);
  for (Index b = 0; b < bonds.size(); ++b) {
    double* first = rest.data() + bonds.first[b] * rows;
    double* second = rest.data() + bonds.second[b] * rows;
    for (const bool bends : {false, true}) {
      if (bends && stiffness.bending.empty()) break;
      equations.fill(bonds.length(b), bonds.direction(b), bends, row.data());
      const double k = bends ? stiffness.bending[b] : stiffness.axial[b];
      const double at_first = bends ? 2.0 * stiffness.inflection[b] : 1.0;
      for (std::size_t r = 0; r < odd; ++r) {
        first[r] -= k * row[r];
        second[r] += k * row[r];
      }
      for (std::size_t r = odd; r < rows; ++r) {
        first[r] -= at_first * k * row[r];
        second[r] -= (2.0 - at_first) * k * row[r];
      }
    }
  }
  return rest;
}

}  // namespace perilink
