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
#include "material/strain.hpp"
#include "network/network.hpp"

namespace perilink {

/// Meaning of a cell of a field file (cell data "element").
enum class FieldElement {
  particle = 0,
  broken_bond = 1,
  rebar_segment = 2,
  cell = 3,
  host = 4,  ///< finite element that constrains particles
  body = 5,  ///< between neighbouring particles
};

/// State of a run in a field file.
struct FieldMoment {
  Index step = 0;
  Index broken_bonds = 0;
  double load_factor = 0.0;
  double load = 0.0;                     ///< [force]
  double spacing = 0.0;                  ///< between particles [length]
  std::optional<double> time = {};       ///< time-dependent runs [time]
  std::optional<double> thickness = {};  ///< in the plane [length]
  Strain strain = Strain::small;         ///< measure of strains and energies
};

/// Returns the state of a body as a grid. Points are the particles at their reference positions (z
/// = 0 in two dimensions). Cells: a vertex for each particle, then a line for each broken bond in
/// the order of breaking, for each bond that a pre-crack cuts, and for each bar element. Fields:
///   points  displacement, damage, region (number of the material, -1 none), kind (0 solid, 1
///           ghost, 2 rebar), volume, strain_energy_density, principal_strain (largest first); with
///           micropolar bonds rotation (one number in two dimensions, three in three)
///   cells   element (FieldElement), broken_at (number of the break in the run, from 1; 0: none, as
///           for bonds that a pre-crack cuts)
///   file    dimension and the values of FieldMoment
/// \param secants                   one per element, shape (elements) [-]
/// \param motion                    motion of that state, shape (particles, width) [length]
/// \param broken_elements_in_order  broken bonds and bond-slip springs, in order of breaking
/// \param neighbourhoods            bonds of each particle (bonds_of_particles)
VtuGrid make_field_grid(const Network& network, Secants secants, std::span<const double> motion,
                        const FieldMoment& moment, std::span<const Index> broken_elements_in_order,
                        const Csr& neighbourhoods);

/// Adds bar results as cell fields, zero except for bar elements: axial_strain, axial_force,
/// axial_stress, slip and bond_stress (BarState). Must be called before other cell fields are
/// added.
void add_bars(VtuGrid& grid, const BarState& bars);

/// Adds stresses as point fields: stress, principal_stress (largest first; two or three values) and
/// the unit vectors first_principal_direction and last_principal_direction.
/// \param stresses  particle_stresses()
void add_stresses(VtuGrid& grid, std::vector<double> stresses, int dim);

/// Adds the section forces of a beam as point fields.
void add_section_forces(VtuGrid& grid, SectionForces forces);

/// Adds crack_opening: per particle the largest opening of its damaged bonds, as a point field; per
/// broken bond its opening, as a cell field. Must be called before other cell fields are added.
/// \param broken_elements_in_order  as given to make_field_grid()
void add_openings(VtuGrid& grid, const Network& network, const CrackOpenings& openings,
                  std::span<const Index> broken_elements_in_order);

/// Adds host elements as cells between the particles nearest to their corners: lines along beams,
/// quadrilaterals in the plane, hexahedra in space.
/// \param whole  per element, whether it is an active host
void add_hosts(VtuGrid& grid, const Particles& particles, const Hosts& hosts,
               std::span<const std::uint8_t> whole);

/// Adds the cells between neighbouring particles, for views of surfaces and contours.
/// \param corners  body_cells()
void add_body_cells(VtuGrid& grid, const Csr& corners, int dim);

/// Sets `broken_at` of the vertices of cracked particles, in runs without bond breaking.
/// \param cracked  particles, in order of cracking
void number_cracks(VtuGrid& grid, std::span<const Index> cracked);

/// Returns the state of linear elements as a grid. Cells: a vertex for each particle, then the
/// triangles or tetrahedra. Fields are those of make_field_grid(); particles have the mean of
/// adjacent cells, and cells also have
///   strain_energy_density, principal_strain and principal_stress (largest first; two or three
///   values; zero for vertices)
/// \param motion  motion of that state, shape (particles, dim) [length]
VtuGrid make_element_grid(const LinearElements& elements, const Particles& particles,
                          std::span<const double> motion, const FieldMoment& moment);

}  // namespace perilink
