#include "network/cells/linear_elements.hpp"

#include <Eigen/Dense>
#include <stdexcept>
#include <string>
#include <utility>

#include "discretization/vector_at.hpp"

namespace perilink {
namespace {

/// With x = x_0 + J xi, the gradients of the last Dim shape functions are the rows of J^-1, and all
/// gradients sum to zero.
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

}  // namespace perilink
