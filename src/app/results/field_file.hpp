#pragma once

#include <optional>
#include <span>

#include "assembly/bar_state.hpp"
#include "assembly/linear_elements.hpp"
#include "assembly/results/crack_state.hpp"
#include "assembly/results/section_forces.hpp"
#include "base/csr.hpp"
#include "discretization/hosts/hosts.hpp"
#include "io/fields/vtu.hpp"
#include "network/network.hpp"

namespace perilink {

/// What a cell of a field file stands for (cell data "element").
enum class FieldElement {
  particle = 0,
  broken_bond = 1,
  rebar_segment = 2,
  cell = 3,
  host = 4,  ///< finite element that carries particles
};

/// The moment of a run that a field file shows.
struct FieldMoment {
  Index step = 0;
  Index broken_bonds = 0;
  double load_factor = 0.0;
  double load = 0.0;                     ///< [force]
  double spacing = 0.0;                  ///< between particles [length]
  std::optional<double> time = {};       ///< in runs over time [time]
  std::optional<double> thickness = {};  ///< in the plane [length]
};

/// The state of a body as a grid to look at. Points are the particles at their reference positions
/// (z = 0 in two dimensions). Cells: a vertex for each particle, then a line for each broken bond
/// in the order of breaking, then a line for each bar segment. Fields:
///   points  displacement, damage, region (number of the material, -1 none), kind (0 solid, 1
///           ghost, 2 rebar), volume, strain_energy_density, principal_strain (largest first); with
///           micropolar bonds rotation (one number in two dimensions, three in three)
///   cells   element (FieldElement), broken_at (which break of the run it was, from 1; 0: none)
///   file    dimension and the moment
/// \param secants                   one per element, shape (elements) [-]
/// \param motion                    at that moment, shape (particles, width) [length]
/// \param broken_elements_in_order  bonds and ties that broke, first one first
/// \param families                  bonds of each particle (bonds_of_particles)
VtuGrid make_field_grid(const Network& network, Secants secants, std::span<const double> motion,
                        const FieldMoment& moment, std::span<const Index> broken_elements_in_order,
                        const Csr& neighbourhoods);

/// Adds what bars bear as fields of cells, zero but for their segments: axial_strain, axial_force,
/// axial_stress, slip and bond_stress (BarState). Before anything else is added to the cells.
void add_bars(VtuGrid& grid, const BarState& bars);

/// Adds stresses as fields of points: stress, principal_stress (largest first; in the plane or in
/// space) and the unit vectors first_principal_direction and last_principal_direction.
/// \param stresses  particle_stresses()
void add_stresses(VtuGrid& grid, std::vector<double> stresses, int dim);

/// Adds what the sections of a beam bear, as fields of points.
void add_section_forces(VtuGrid& grid, SectionForces forces);

/// Adds crack_opening: of each particle the largest of its damaged bonds, as a field of points; of
/// each broken bond its own, as a field of cells. Before anything else is added to the cells.
/// \param broken_elements_in_order  as the grid was made with
void add_openings(VtuGrid& grid, const Network& network, const CrackOpenings& openings,
                  std::span<const Index> broken_elements_in_order);

/// Adds the finite elements that carry particles, between those nearest to their corners:
/// lines along beams, quadrilaterals in the plane, hexahedra in space.
/// \param whole  per element, whether it carries
void add_hosts(VtuGrid& grid, const Particles& particles, const Hosts& hosts,
               std::span<const std::uint8_t> whole);

/// Numbers the vertices of particles that crack, where no bonds break, in `broken_at`.
/// \param cracked  particles, first one first
void number_cracks(VtuGrid& grid, std::span<const Index> cracked);

/// The state of linear elements. Cells: a vertex for each particle, then the triangles or
/// tetrahedra. Fields as above; particles have the mean of the cells around them, and cells further
///   strain_energy_density, principal_strain and principal_stress (largest first; in the plane or
///   in space; zero for vertices)
/// \param motion  at that moment, shape (particles, dim) [length]
VtuGrid make_element_grid(const LinearElements& elements, const Particles& particles,
                          std::span<const double> motion, const FieldMoment& moment);

}  // namespace perilink
