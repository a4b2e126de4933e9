#include "network/builder/tied_cells.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "discretization/lattices/triangulate.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "network/builder/graded_stiffness.hpp"
#include "network/element_columns.hpp"

namespace perilink {
namespace {

using Corners = std::array<Index, 3>;

/// Returns the corners of a facet, ascending, in the numbers of the whole body.
Corners corners_of(const Facets& facets, Index facet, const std::vector<Index>& whole_of) {
  Corners corners = {no_index, no_index, no_index};
  const auto row = facets.corners.row(facet);
  for (std::size_t c = 0; c < row.size(); ++c) {
    corners[c] = whole_of.empty() ? row[c] : whole_of[row[c]];
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::map<Corners, Index> facets_by_corners(const Facets& facets) {
  std::map<Corners, Index> number;
  for (Index f = 0; f < facets.size(); ++f) number[corners_of(facets, f, {})] = f;
  return number;
}

LinearElements elements_of(Simplices cells, const Particles& particles, const NetworkInput& input) {
  std::vector<IsotropicMaterial> materials;
  for (const SolidMaterial& material : input.materials) {
    const bool own = input.model == BondModel::micropolar;
    materials.push_back({material.youngs_modulus,
                         own ? material.poissons_ratio : bond_poissons_ratio(input.problem)});
  }
  return make_linear_elements(std::move(cells), particles.positions, input.thickness, input.problem,
                              materials);
}

/// Copies the nodal area fractions that the bonds balance; surface tractions act by them.
void copy_shares(const Facets& from, const std::vector<Index>& whole_of, Facets& to) {
  const std::map<Corners, Index> number = facets_by_corners(to);
  for (Index f = 0; f < from.size(); ++f) {
    const auto found = number.find(corners_of(from, f, whole_of));
    if (found == number.end()) continue;
    const auto own = to.corners.row(found->second);
    const Index first = to.corners.offsets[found->second];
    for (Index c = from.corners.offsets[f]; c < from.corners.offsets[f + 1]; ++c) {
      const auto at = std::find(own.begin(), own.end(), whole_of[from.corners.values[c]]);
      to.shares[first + (at - own.begin())] = from.shares[c];
    }
  }
}

/// Appends the edges of cells as bonds without stiffness.
void append_edges(const Bonds& edges, bool elastic, Network& network) {
  for (Index e = 0; e < edges.size(); ++e) {
    network.bonds.append(network.particles, edges.first[e], edges.second[e]);
  }
  const std::size_t count = network.bonds.first.size();
  network.stiffness.resize(count, 0.0);
  if (!elastic) network.critical_stretch.resize(count, infinity);
  complete_columns(network);
}

}  // namespace

BondedPart bonded_part(const Body& whole, double thickness) {
  BondedPart part;
  Body& body = part.body;
  body.cells = cells_of(whole, false);
  body.lattice = whole.lattice;
  part.whole_of = body.cells.vertices;
  std::sort(part.whole_of.begin(), part.whole_of.end());
  part.whole_of.erase(std::unique(part.whole_of.begin(), part.whole_of.end()), part.whole_of.end());
  std::vector<Index> number(static_cast<std::size_t>(whole.particles.size()), no_index);
  body.particles.dim = whole.particles.dim;
  for (std::size_t i = 0; i < part.whole_of.size(); ++i) {
    number[part.whole_of[i]] = static_cast<Index>(i);
    const auto x = whole.particles.position(part.whole_of[i]);
    body.particles.positions.insert(body.particles.positions.end(), x.begin(), x.end());
  }
  for (Index& vertex : body.cells.vertices) vertex = number[vertex];
  body.particles.volumes = shape_integrals(body.cells, body.particles.positions, thickness);
  body.particles.kind.assign(part.whole_of.size(), ParticleKind::solid);
  body.particles.material.assign(part.whole_of.size(), no_index);
  for (Index k = 0; k < body.cells.size(); ++k) {
    for (const Index i : body.cells.cell(k)) {
      body.particles.material[i] = std::max(body.particles.material[i], body.cells.material[k]);
    }
  }
  body.facets = facets_of(body.cells, body.particles.positions, thickness);
  const std::map<Corners, Index> outer = facets_by_corners(whole.facets);
  for (Index f = 0; f < body.facets.size(); ++f) {
    const auto found = outer.find(corners_of(body.facets, f, part.whole_of));
    const bool free = found != outer.end() && whole.facets.on_surface(found->second);
    body.facets.tied.push_back(body.facets.on_surface(f) && !free ? 1 : 0);
  }
  return part;
}

void join_cells(const Body& whole, const BondedPart& part, const NetworkInput& input,
                Network& network) {
  for (std::vector<Index>* ends : {&network.bonds.first, &network.bonds.second}) {
    for (Index& i : *ends) i = part.whole_of[i];
  }
  network.particles = whole.particles;
  Facets facets = whole.facets;
  copy_shares(network.facets, part.whole_of, facets);
  network.facets = std::move(facets);
  LinearElements cells = elements_of(cells_of(whole, true), whole.particles, input);
  scale_stiffness(input.fields, whole.particles.positions, cells);
  const Bonds edges = edges_of(cells.cells, whole.particles);
  cells.num_edges = edges.size();
  append_edges(edges, input.elastic, network);
  network.cells = std::move(cells);
}

std::vector<std::uint8_t> vertices_of_cells(const Network& network) {
  std::vector<std::uint8_t> marked;
  if (!network.cells) return marked;
  marked.assign(static_cast<std::size_t>(network.particles.size()), 0);
  for (const Index i : network.cells->cells.vertices) marked[i] = 1;
  return marked;
}

}  // namespace perilink
