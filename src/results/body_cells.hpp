#pragma once

#include "base/csr.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/simplices.hpp"
#include "network/network.hpp"

namespace perilink {

/// Returns the corners of the cells between neighbouring particles of a body, in VTK's order: the
/// triangles or tetrahedra of a mesh, quadrilaterals of a square lattice, triangles of a hexagonal
/// and hexahedra of a cubic one. Cells with an edge that is a broken bond or one cut by a pre-crack
/// are left out. None for beams and other lattices.
/// \param mesh            cells of the body; empty without a mesh
/// \param neighbourhoods  bonds of each particle (bonds_of_particles)
Csr body_cells(const Network& network, const Lattice& lattice, const Simplices& mesh,
               const Csr& neighbourhoods, Secants secants);

}  // namespace perilink
