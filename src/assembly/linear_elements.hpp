#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <utility>
#include <vector>

#include "assembly/internal_force.hpp"
#include "network/cells/linear_elements.hpp"
#include "network/unknowns.hpp"

/// \file
/// Linear finite elements on the particles: constant-strain triangles and tetrahedra. The yardstick
/// of the error studies; nothing breaks here.

namespace perilink {

/// Lower triangle of K = sum over cells of V B' C B between the unknowns.
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(
    const LinearElements& elements, const Unknowns& unknowns);

/// K u for given displacements of all particles, and the energy.
InternalForce internal_force(const LinearElements& elements, std::span<const double> displacement);

/// Work of the cells' stresses under one motion on the strains of another, summed over cells at
/// which the other moves, and the same sum over the sizes of its terms [force length].
/// \param width  components of both motions, shape (particles, width)
std::pair<double, double> work_between(const LinearElements& elements, int width,
                                       std::span<const double> displacement,
                                       std::span<const double> other);

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
