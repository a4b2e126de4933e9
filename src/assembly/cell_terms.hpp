#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "network/cells/linear_elements.hpp"

/// \file
/// Contributions of linear finite elements to stiffness and forces.

namespace perilink {

/// Gradients of a cell's shape functions, one row per vertex [1/length].
template <int Dim>
using Gradients = Eigen::Map<const Eigen::Matrix<double, Dim + 1, Dim, Eigen::RowMajor>>;

template <int Dim>
Gradients<Dim> gradients_of(const LinearElements& elements, Index cell) {
  return Gradients<Dim>(elements.gradients.data() +
                        static_cast<std::size_t>(cell) * (Dim + 1) * Dim);
}

inline Csr cells_of_particles(const LinearElements& elements) {
  return sorted_into_rows(elements.num_particles, [&](auto&& act) {
    for (Index number = 0; number < elements.cells.size(); ++number) {
      for (const Index i : elements.cells.cell(number)) act(i, number);
    }
  });
}

/// Stiffness blocks of cells for LowerTriangle: V (lambda g_j g_i' + mu g_i g_j' + mu (g_i g_j) 1).
template <int Dim>
class CellBlocks {
 public:
  static constexpr int width = Dim;

  explicit CellBlocks(const LinearElements& elements)
      : elements_(elements), cells_(cells_of_particles(elements)) {}

  Index num_particles() const { return elements_.num_particles; }

  void visit(Index particle, auto&& sink) const {
    for (const Index number : cells_.row(particle)) {
      const std::span<const Index> cell = elements_.cells.cell(number);
      const Gradients<Dim> gradients = gradients_of<Dim>(elements_, number);
      const auto own = std::find(cell.begin(), cell.end(), particle) - cell.begin();
      const auto g_i = gradients.row(own);
      const double lambda = elements_.volumes[number] * elements_.lambda[number];
      const double mu = elements_.volumes[number] * elements_.mu[number];
      for (int v = 0; v <= Dim; ++v) {
        const auto g_j = gradients.row(v);
        sink(cell[v], [&](int row, int col) {
          return lambda * g_j[row] * g_i[col] + mu * g_i[row] * g_j[col];
        });
        sink(cell[v], [&](int row, int col) { return row == col ? mu * g_i.dot(g_j) : 0.0; });
      }
    }
  }

 private:
  const LinearElements& elements_;
  Csr cells_;
};

/// Adds the forces [force] and the energy [force length] of the cells.
/// \param displacement  shape (particles, width); the first Dim components are translations
/// \param forces        the same shape as `displacement`
template <int Dim, class Real>
void add_cells(const LinearElements& elements, std::span<const Real> displacement, int width,
               std::vector<Real>& forces, Real& energy) {
  using Tensor = std::array<std::array<Real, Dim>, Dim>;
  for (Index number = 0; number < elements.cells.size(); ++number) {
    const Gradients<Dim> gradients = gradients_of<Dim>(elements, number);
    const std::span<const Index> cell = elements.cells.cell(number);
    Tensor gradient{}, stress{};
    for (int v = 0; v <= Dim; ++v) {
      const Real* u = displacement.data() + static_cast<std::size_t>(cell[v]) * width;
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b < Dim; ++b) gradient[a][b] += u[a] * gradients(v, b);
      }
    }
    Real trace = 0.0, density = 0.0;
    for (int a = 0; a < Dim; ++a) trace += gradient[a][a];
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) {
        stress[a][b] = elements.mu[number] * (gradient[a][b] + gradient[b][a]) +
                       (a == b ? elements.lambda[number] * trace : Real());
        density += stress[a][b] * gradient[a][b];
      }
    }
    const Real volume = elements.volumes[number];
    energy += 0.5 * volume * density;
    for (int v = 0; v <= Dim; ++v) {
      Real* force = forces.data() + static_cast<std::size_t>(cell[v]) * width;
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b < Dim; ++b) force[a] += volume * stress[a][b] * gradients(v, b);
      }
    }
  }
}

}  // namespace perilink
