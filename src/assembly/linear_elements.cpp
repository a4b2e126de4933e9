#include "assembly/linear_elements.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "assembly/cell_terms.hpp"
#include "assembly/lower_triangle.hpp"
#include "base/dense/decompositions.hpp"
#include "discretization/vector_at.hpp"

namespace perilink {
namespace {

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;

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
    const Eigen::Vector<double, Dim> ascending =
        eigenvalues(Eigen::Matrix<double, Dim, Dim>(tensor));
    values.insert(values.end(), ascending.data(), ascending.data() + Dim);
    std::reverse(values.end() - Dim, values.end());
  }
  return values;
}

}  // namespace

SparseMatrix assemble_stiffness(const LinearElements& elements, const Unknowns& unknowns) {
  expect_nothing_embedded(unknowns);
  return elements.dim() == 2 ? LowerTriangle(CellBlocks<2>(elements), unknowns).build()
                             : LowerTriangle(CellBlocks<3>(elements), unknowns).build();
}

InternalForce internal_force(const LinearElements& elements, std::span<const double> displacement) {
  InternalForce result;
  result.forces.assign(displacement.size(), 0.0);
  elements.dim() == 2 ? add_cells<2>(elements, displacement, 2, result.forces, result.energy)
                      : add_cells<3>(elements, displacement, 3, result.forces, result.energy);
  return result;
}

namespace {

template <int Dim>
std::pair<double, double> work_in_cells(const LinearElements& elements, int width,
                                        std::span<const double> displacement,
                                        std::span<const double> other) {
  double work = 0.0, sizes = 0.0;
  for (Index number = 0; number < elements.cells.size(); ++number) {
    const std::span<const Index> cell = elements.cells.cell(number);
    const Gradients<Dim> gradients = gradients_of<Dim>(elements, number);
    Tensor<Dim> first = Tensor<Dim>::Zero(), second = first, size = first, other_size = first;
    for (int v = 0; v <= Dim; ++v) {
      const std::size_t slot = static_cast<std::size_t>(cell[v]) * width;
      for (int a = 0; a < Dim; ++a) {
        first.row(a) += displacement[slot + a] * gradients.row(v);
        second.row(a) += other[slot + a] * gradients.row(v);
        size.row(a) += std::abs(displacement[slot + a]) * gradients.row(v).cwiseAbs();
        other_size.row(a) += std::abs(other[slot + a]) * gradients.row(v).cwiseAbs();
      }
    }
    if (second.isZero(0.0)) continue;
    const Tensor<Dim> strain = 0.5 * (first + first.transpose());
    work += elements.volumes[number] *
            stress_of<Dim>(elements, number, strain).cwiseProduct(second).sum();
    sizes += elements.volumes[number] * elements.mu[number] * size.cwiseProduct(other_size).sum();
  }
  return {work, sizes};
}

}  // namespace

std::pair<double, double> work_between(const LinearElements& elements, int width,
                                       std::span<const double> displacement,
                                       std::span<const double> other) {
  return elements.dim() == 2 ? work_in_cells<2>(elements, width, displacement, other)
                             : work_in_cells<3>(elements, width, displacement, other);
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
