#pragma once

#include <span>
#include <vector>

#include "discretization/simplices.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// A mesh ready for assembly.
struct LinearElements {
  Simplices cells;
  std::vector<double> volumes;  ///< per cell [length^3]
  /// Gradients of the shape functions, shape (cells, dim + 1, dim) [1/length].
  std::vector<double> gradients;
  std::vector<double> lambda;  ///< Lame's first constant per cell; in plane stress that for which
                               ///< stress = lambda trace(strain) + 2 mu strain holds in the plane
                               ///< [force/length^2]
  std::vector<double> mu;      ///< shear modulus per cell [force/length^2]
  Index num_particles = 0;
  Index num_edges = 0;  ///< edges that stand among the bonds of a network, see Network::cells

  int dim() const { return cells.dim; }
};

/// \param positions  shape (particles, dim) [length]
/// \param thickness  two-dimensional bodies only [length]
/// \param materials  by the numbers in `cells.material`
/// \throws std::invalid_argument for a cell that is turned inside out or has no volume
LinearElements make_linear_elements(Simplices cells, std::span<const double> positions,
                                    double thickness, Problem problem,
                                    std::span<const IsotropicMaterial> materials);

}  // namespace perilink
