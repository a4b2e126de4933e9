#pragma once

#include <span>
#include <vector>

#include "discretization/simplices.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// A mesh of linear finite elements, ready for assembly.
struct LinearElements {
  Simplices cells;
  std::vector<double> volumes;  ///< per cell [length^3]
  /// Gradients of the shape functions, shape (cells, dim + 1, dim) [1/length].
  std::vector<double> gradients;
  std::vector<double> lambda;  ///< Lame's first constant per cell [force/length^2]; in plane stress
                               ///< the value for which stress = lambda trace(strain) + 2 mu strain
                               ///< in the plane
  std::vector<double> mu;      ///< shear modulus per cell [force/length^2]
  Index num_particles = 0;
  Index num_edges = 0;  ///< edges among the bonds of a network, see Network::cells

  int dim() const { return cells.dim; }
};

/// Builds linear elements from cells and their vertices.
/// \param positions  shape (particles, dim) [length]
/// \param thickness  thickness of two-dimensional bodies [length]
/// \param materials  by the numbers in `cells.material`
/// \throws std::invalid_argument if a cell is turned inside out or has no volume
LinearElements make_linear_elements(Simplices cells, std::span<const double> positions,
                                    double thickness, Problem problem,
                                    std::span<const IsotropicMaterial> materials);

}  // namespace perilink
