#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "assembly/internal_force.hpp"
#include "discretization/simplices.hpp"
#include "material/elasticity.hpp"
#include "network/loaded_network.hpp"

/// \file
/// Linear finite elements on the particles: constant-strain triangles and tetrahedra. The yardstick
/// of the error studies; nothing breaks here.

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

  int dim() const { return cells.dim; }
};

/// \param positions  shape (particles, dim) [length]
/// \param thickness  two-dimensional bodies only [length]
/// \param materials  by the numbers in `cells.material`
/// \throws std::invalid_argument for a cell that is turned inside out or has no volume
LinearElements make_linear_elements(Simplices cells, std::span<const double> positions,
                                    double thickness, Problem problem,
                                    std::span<const IsotropicMaterial> materials);

/// Lower triangle of K = sum over cells of V B' C B between the unknowns.
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(
    const LinearElements& elements, const Unknowns& unknowns);

/// K u for given displacements of all particles, and the energy.
InternalForce internal_force(const LinearElements& elements, std::span<const double> displacement);

/// Strain of every cell, shape (cells, dim, dim) [-].
std::vector<double> cell_strains(const LinearElements& elements,
                                 std::span<const double> displacement);

/// Stress of every cell in the plane or in space, shape (cells, dim, dim) [force/length^2].
std::vector<double> cell_stresses(const LinearElements& elements, std::span<const double> strains);

/// Eigenvalues of symmetric tensors, largest first.
/// \param tensors  shape (n, dim, dim)
/// \return shape (n, dim)
std::vector<double> principal_values(std::span<const double> tensors, int dim);

/// Mean of the cells' values around every particle, weighted with their volumes.
/// \param values  shape (cells, width)
/// \return shape (particles, width)
std::vector<double> averaged_at_particles(const LinearElements& elements,
                                          std::span<const double> values, std::size_t width);

}  // namespace perilink
