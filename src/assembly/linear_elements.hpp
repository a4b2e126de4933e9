#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <utility>
#include <vector>

#include "assembly/internal_force.hpp"
#include "network/cells/linear_elements.hpp"
#include "network/unknowns.hpp"

/// \file
/// Linear finite elements on the particles: constant-strain triangles and tetrahedra. They are the
/// reference of the error studies and do not break.

namespace perilink {

/// Returns the lower triangle of K = sum over cells of V B' C B between the unknowns.
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(
    const LinearElements& elements, const Unknowns& unknowns);

/// Returns K u and the energy for given displacements of all particles.
InternalForce internal_force(const LinearElements& elements, std::span<const double> displacement);

/// Returns the work of the cells' stresses under one motion on the strains of another
/// [force length]. The second value is the same sum over the magnitudes of its terms. Cells at
/// which `other` does not move are skipped.
/// \param width  components of both motions, shape (particles, width)
std::pair<double, double> work_between(const LinearElements& elements, int width,
                                       std::span<const double> displacement,
                                       std::span<const double> other);

/// Returns the strain of every cell, shape (cells, dim, dim) [-].
std::vector<double> cell_strains(const LinearElements& elements,
                                 std::span<const double> displacement);

/// Returns the stress of every cell in the plane or in space, shape (cells, dim, dim)
/// [force/length^2].
std::vector<double> cell_stresses(const LinearElements& elements, std::span<const double> strains);

/// Returns the eigenvalues of symmetric tensors, largest first.
/// \param tensors  shape (n, dim, dim)
/// \return shape (n, dim)
std::vector<double> principal_values(std::span<const double> tensors, int dim);

/// Returns the mean of the cells' values around every particle, weighted with the cells' volumes.
/// \param values  shape (cells, width)
/// \return shape (particles, width)
std::vector<double> averaged_at_particles(const LinearElements& elements,
                                          std::span<const double> values, std::size_t width);

}  // namespace perilink
