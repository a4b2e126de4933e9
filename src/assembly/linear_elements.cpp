#include "assembly/linear_elements.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "assembly/lower_triangle.hpp"
#include "base/csr.hpp"

namespace perilink {
namespace {

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;

/// Gradients of a cell's shape functions, one row for each vertex.
template <int Dim>
using Gradients = Eigen::Map<const Eigen::Matrix<double, Dim + 1, Dim, Eigen::RowMajor>>;

template <int Dim>
Gradients<Dim> gradients_of(const LinearElements& elements, Index cell) {
  return Gradients<Dim>(elements.gradients.data() +
                        static_cast<std::size_t>(cell) * (Dim + 1) * Dim);
}

template <int Dim>
Eigen::Map<const Eigen::Matrix<double, Dim, 1>> vector_at(std::span<const double> values, Index i) {
  return Eigen::Map<const Eigen::Matrix<double, Dim, 1>>(values.data() +
                                                         static_cast<std::size_t>(i) * Dim);
}

/// With x = x_0 + J xi the gradients of the last Dim shape functions xi are the rows of J^-1, and
/// all sum to zero.
template <int Dim>
void fill_geometry(std::span<const double> positions, double thickness, LinearElements& elements) {
  for (Index number = 0; number < elements.cells.size(); ++number) {
    const std::span<const Index> cell = elements.cells.cell(number);
    Eigen::Matrix<double, Dim, Dim> jacobian;
    for (int v = 0; v < Dim; ++v) {
      jacobian.col(v) = vector_at<Dim>(positions, cell[v + 1]) - vector_at<Dim>(positions, cell[0]);
    }
    const double determinant = jacobian.determinant();
    if (!(determinant > 0.0)) {
      throw std::invalid_argument("cell " + std::to_string(number + 1) +
                                  " of the mesh is turned inside out or has no volume");
    }
    elements.volumes.push_back(determinant * (Dim == 2 ? 0.5 * thickness : 1.0 / 6.0));
    Eigen::Matrix<double, Dim + 1, Dim, Eigen::RowMajor> gradients;
    gradients.template bottomRows<Dim>() = jacobian.inverse();
    gradients.row(0) = -gradients.template bottomRows<Dim>().colwise().sum();
    elements.gradients.insert(elements.gradients.end(), gradients.data(),
                              gradients.data() + gradients.size());
  }
}

void fill_moduli(Problem problem, std::span<const IsotropicMaterial> materials,
                 LinearElements& elements) {
  for (const Index m : elements.cells.material) {
    const HookeConstants constants =
        hooke_constants(problem, materials[m].youngs_modulus, materials[m].poissons_ratio);
    elements.mu.push_back(constants.mu);
    elements.lambda.push_back(constants.lambda);
  }
}

Csr cells_of_particles(const LinearElements& elements) {
  return sorted_into_rows(elements.num_particles, [&](auto&& act) {
    for (Index number = 0; number < elements.cells.size(); ++number) {
      for (const Index i : elements.cells.cell(number)) act(i, number);
    }
  });
}

/// Blocks of cells, see LowerTriangle: V (lambda g_j g_i' + mu g_i g_j' + mu (g_i g_j) 1).
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

template <int Dim>
Tensor<Dim> strain_of(const LinearElements& elements, Index number,
                      std::span<const double> displacement) {
  const std::span<const Index> cell = elements.cells.cell(number);
  const Gradients<Dim> gradients = gradients_of<Dim>(elements, number);
  Tensor<Dim> gradient = Tensor<Dim>::Zero();
  for (int v = 0; v <= Dim; ++v) {
    gradient += vector_at<Dim>(displacement, cell[v]) * gradients.row(v);
  }
  return 0.5 * (gradient + gradient.transpose());
}

template <int Dim>
Tensor<Dim> stress_of(const LinearElements& elements, Index number, const Tensor<Dim>& strain) {
  return elements.lambda[number] * strain.trace() * Tensor<Dim>::Identity() +
         2.0 * elements.mu[number] * strain;
}

template <int Dim>
void add_cells(const LinearElements& elements, std::span<const double> displacement,
               InternalForce& result) {
  for (Index number = 0; number < elements.cells.size(); ++number) {
    const Tensor<Dim> strain = strain_of<Dim>(elements, number, displacement);
    const Tensor<Dim> stress = stress_of<Dim>(elements, number, strain);
    const double volume = elements.volumes[number];
    result.energy += 0.5 * volume * stress.cwiseProduct(strain).sum();
    const Gradients<Dim> gradients = gradients_of<Dim>(elements, number);
    const std::span<const Index> cell = elements.cells.cell(number);
    for (int v = 0; v <= Dim; ++v) {
      Eigen::Map<Eigen::Matrix<double, Dim, 1>>(result.forces.data() +
                                                static_cast<std::size_t>(cell[v]) * Dim) +=
          volume * stress * gradients.row(v).transpose();
    }
  }
}

template <int Dim, class TensorOf>
std::vector<double> tensors_of_cells(const LinearElements& elements, TensorOf tensor_of) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(elements.cells.size()) * Dim * Dim);
  for (Index number = 0; number < elements.cells.size(); ++number) {
    const Tensor<Dim> tensor = tensor_of(number);
    values.insert(values.end(), tensor.data(), tensor.data() + Dim * Dim);
  }
  return values;
}

template <int Dim>
std::vector<double> stresses_of(const LinearElements& elements, std::span<const double> strains) {
  return tensors_of_cells<Dim>(elements, [&](Index number) {
    return stress_of<Dim>(elements, number,
                          Eigen::Map<const Tensor<Dim>>(
                              strains.data() + static_cast<std::size_t>(number) * Dim * Dim));
  });
}

template <int Dim>
std::vector<double> eigenvalues_of(std::span<const double> tensors) {
  std::vector<double> values;
  for (std::size_t at = 0; at < tensors.size(); at += Dim * Dim) {
    const Tensor<Dim> tensor = Eigen::Map<const Tensor<Dim>>(tensors.data() + at);
    const Eigen::Matrix<double, Dim, 1> ascending =
        Eigen::SelfAdjointEigenSolver<Tensor<Dim>>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
    values.insert(values.end(), ascending.data(), ascending.data() + Dim);
    std::reverse(values.end() - Dim, values.end());
  }
  return values;
}

}  // namespace

LinearElements make_linear_elements(Simplices cells, std::span<const double> positions,
                                    double thickness, Problem problem,
                                    std::span<const IsotropicMaterial> materials) {
  LinearElements elements;
  elements.cells = std::move(cells);
  elements.num_particles =
      static_cast<Index>(positions.size() / static_cast<std::size_t>(elements.dim()));
  elements.dim() == 2 ? fill_geometry<2>(positions, thickness, elements)
                      : fill_geometry<3>(positions, thickness, elements);
  fill_moduli(problem, materials, elements);
  return elements;
}

SparseMatrix assemble_stiffness(const LinearElements& elements, const Unknowns& unknowns) {
  expect_nothing_carried(unknowns);
  return elements.dim() == 2 ? LowerTriangle(CellBlocks<2>(elements), unknowns).build()
                             : LowerTriangle(CellBlocks<3>(elements), unknowns).build();
}

InternalForce internal_force(const LinearElements& elements, std::span<const double> displacement) {
  InternalForce result;
  result.forces.assign(displacement.size(), 0.0);
  elements.dim() == 2 ? add_cells<2>(elements, displacement, result)
                      : add_cells<3>(elements, displacement, result);
  return result;
}

std::vector<double> cell_strains(const LinearElements& elements,
                                 std::span<const double> displacement) {
  if (elements.dim() == 2) {
    return tensors_of_cells<2>(elements,
                               [&](Index n) { return strain_of<2>(elements, n, displacement); });
  }
  return tensors_of_cells<3>(elements,
                             [&](Index n) { return strain_of<3>(elements, n, displacement); });
}

std::vector<double> cell_stresses(const LinearElements& elements, std::span<const double> strains) {
  return elements.dim() == 2 ? stresses_of<2>(elements, strains)
                             : stresses_of<3>(elements, strains);
}

std::vector<double> principal_values(std::span<const double> tensors, int dim) {
  return dim == 2 ? eigenvalues_of<2>(tensors) : eigenvalues_of<3>(tensors);
}

std::vector<double> averaged_at_particles(const LinearElements& elements,
                                          std::span<const double> values, std::size_t width) {
  std::vector<double> sums(static_cast<std::size_t>(elements.num_particles) * width, 0.0);
  std::vector<double> volumes(static_cast<std::size_t>(elements.num_particles), 0.0);
  for (Index number = 0; number < elements.cells.size(); ++number) {
    for (const Index i : elements.cells.cell(number)) {
      volumes[i] += elements.volumes[number];
      for (std::size_t c = 0; c < width; ++c) {
        sums[i * width + c] +=
            elements.volumes[number] * values[static_cast<std::size_t>(number) * width + c];
      }
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= volumes[k / width];
  return sums;
}

}  // namespace perilink
