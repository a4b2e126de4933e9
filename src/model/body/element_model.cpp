#include "model/body/element_model.hpp"

#include <vector>

#include "discretization/lattices/triangulate.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// Returns a network of the cell edges as unbreakable bonds.
Network edge_network(const Body& body) {
  Network network;
  network.particles = body.particles;
  network.bonds = edges_of(body.cells, body.particles);
  network.stiffness.assign(static_cast<std::size_t>(network.bonds.size()), 1.0);
  network.first_slip_spring = network.first_bar_element = network.bonds.size();
  return network;
}

}  // namespace

void build_elements(const CaseFile& input, Body& body, Model& model) {
  const double thickness = body.particles.dim == 2 ? input.body.thickness : 1.0;
  std::vector<IsotropicMaterial> materials;
  for (const MaterialSection& material : input.materials) {
    materials.push_back({material.youngs_modulus,
                         material.poissons_ratio.value_or(bond_poissons_ratio(model.problem))});
  }
  const std::span<const double> positions = body.particles.positions;
  if (!has_cells(input.body)) {
    body.facets = facets_of(body.cells, positions, thickness);
    body.particles.volumes = shape_integrals(body.cells, positions, thickness);
  }
  model.elements = make_linear_elements(body.cells, positions, thickness, model.problem, materials);
  model.network = edge_network(body);
}

}  // namespace perilink
