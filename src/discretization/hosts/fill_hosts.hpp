#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "discretization/hosts/hosts.hpp"

namespace perilink {

/// Returns nonzero for each cell with particles and without points of `faces` inside its border.
template <class Cells>
std::vector<std::uint8_t> usable_cells(const Cells& cells, const Particles& particles,
                                       std::span<const double> faces) {
  std::vector<std::uint8_t> usable(static_cast<std::size_t>(cells.size()), 0);
  const auto mark = [&](std::span<const double> point, std::uint8_t value) {
    cells.for_each_around(point, [&](Index cell) {
      if (cells.is_within(cell, point)) usable[cell] = value;
    });
  };
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::solid) mark(particles.position(i), 1);
  }
  const auto dim = static_cast<std::size_t>(particles.dim);
  for (std::size_t at = 0; at < faces.size(); at += dim) mark(faces.subspan(at, dim), 0);
  return usable;
}

/// Adds the host elements of the usable cells, with their nodes, corners and bounds.
/// \return element of each cell; no_index for unusable cells
template <class Cells>
std::vector<Index> add_elements(const Cells& cells, const std::vector<std::uint8_t>& usable,
                                Hosts& hosts) {
  std::vector<Index> node_of(static_cast<std::size_t>(cells.num_nodes()), no_index);
  std::vector<Index> element_of(usable.size(), no_index);
  const auto dim = static_cast<std::size_t>(cells.dim());
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (usable[cell] == 0) continue;
    element_of[cell] = hosts.size();
    for (int local = 0; local < cells.nodes_per_cell(); ++local) {
      Index& node = node_of[cells.node(cell, local)];
      if (node == no_index) {
        node = hosts.num_nodes();
        for (int a = 0; a < cells.dim(); ++a) {
          hosts.nodes.push_back(cells.coordinate(cell, local, a));
        }
      }
      hosts.nodes_of.values.push_back(node);
    }
    const std::size_t first = hosts.lower.size();
    for (int k = 0; k < cells.num_corners(); ++k) {
      const Index node = node_of[cells.node(cell, cells.corner(k))];
      hosts.corners_of.values.push_back(node);
      const double* at = hosts.nodes.data() + static_cast<std::size_t>(node) * dim;
      if (k == 0) {
        hosts.lower.insert(hosts.lower.end(), at, at + dim);
        hosts.upper.insert(hosts.upper.end(), at, at + dim);
      }
      for (std::size_t a = 0; a < dim; ++a) {
        hosts.lower[first + a] = std::min(hosts.lower[first + a], at[a]);
        hosts.upper[first + a] = std::max(hosts.upper[first + a], at[a]);
      }
    }
    for (Csr* rows : {&hosts.nodes_of, &hosts.corners_of}) {
      rows->offsets.push_back(static_cast<Index>(rows->values.size()));
    }
  }
  return element_of;
}

/// Returns host elements on the cells of a grid or a mesh, with the particles inside them.
template <class Cells>
Hosts fill_hosts(const Particles& particles, std::span<const double> faces, const Cells& cells) {
  Hosts hosts;
  hosts.dim = particles.dim;
  const std::vector<Index> element_of =
      add_elements(cells, usable_cells(cells, particles, faces), hosts);
  hosts.inside = sorted_into_rows(hosts.size(), [&](const auto& add) {
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] != ParticleKind::solid) continue;
      cells.for_each_around(particles.position(i), [&](Index cell) {
        if (element_of[cell] != no_index) add(element_of[cell], i);
      });
    }
  });
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (element_of[cell] == no_index) continue;
    hosts.first_weight.push_back(hosts.weights.size());
    for (const Index i : hosts.inside.row(element_of[cell])) {
      for (int local = 0; local < cells.nodes_per_cell(); ++local) {
        const double weight = cells.weight(cell, local, particles.position(i));
        // Weights of nodes that a border does not touch are exactly zero there.
        hosts.weights.push_back(std::abs(weight) < 1e-12 ? 0.0 : weight);
      }
    }
  }
  return hosts;
}

}  // namespace perilink
