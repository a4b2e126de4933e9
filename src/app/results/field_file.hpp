#pragma once

#include <span>

#include "analysis/quasistatic/observer.hpp"
#include "assembly/linear_elements.hpp"
#include "base/csr.hpp"
#include "io/fields/vtu.hpp"

namespace perilink {

/// What a cell of a field file stands for (cell data "element").
enum class FieldElement { particle = 0, broken_bond = 1, rebar_segment = 2, cell = 3 };

/// The state of a body at the load factor of `record` as a grid to look at. Points are the
/// particles at their reference positions (z = 0 in two dimensions). Cells: a vertex for each
/// particle, then a line for each broken bond in the order of breaking, then a line for each bar
/// segment. Fields:
///   points  displacement, damage, region (number of the material, -1 none), kind (0 solid, 1
///           ghost, 2 rebar), volume, strain_energy_density, principal_strain (largest first); with
///           micropolar bonds rotation (one number in two dimensions, three in three)
///   cells   element (FieldElement), broken_at (which break of the run it was, from 1; 0: none)
///   file    step, broken_bonds, load_factor, load, dimension, spacing
/// \param broken_elements_in_order  bonds and ties that broke, first one first
/// \param families                  bonds of each particle (bonds_of_particles)
/// \param spacing                   between particles [length]
VtuGrid make_field_grid(const Network& network, const StepState& state, const StepRecord& record,
                        std::span<const Index> broken_elements_in_order, const Csr& families,
                        double spacing);

/// Numbers the vertices of particles that crack, where no bonds break, in `broken_at`.
/// \param cracked  particles, first one first
void number_cracks(VtuGrid& grid, std::span<const Index> cracked);

/// The state of linear elements. Cells: a vertex for each particle, then the triangles or
/// tetrahedra. Fields as above; particles have the mean of the cells around them, and cells further
///   strain_energy_density, principal_strain and principal_stress (largest first; in the plane or
///   in space; zero for vertices)
/// \param displacement  at load factor 1, shape (particles, dim) [length]
VtuGrid make_element_grid(const LinearElements& elements, const Particles& particles,
                          std::span<const double> displacement, const StepRecord& record,
                          double spacing);

}  // namespace perilink
