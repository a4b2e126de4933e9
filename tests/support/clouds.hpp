#pragma once

#include <vector>

#include "discretization/meshes/mesh_body.hpp"
#include "network/builder/network_builder.hpp"
#include "support/simplex_meshes.hpp"

/// \file
/// Bodies of unstructured particles with calibrated bonds.

namespace perilink::test {

/// Returns a unit square with `count` steps across, in upright strips of one material each.
inline Body make_unstructured(int num_materials, int count) {
  const Mesh mesh = box_mesh(2, count);
  std::vector<Index> material;
  for (Index c = 0; c < mesh.num_cells(); ++c) {
    double middle = 0.0;
    for (int k = 0; k < 3; ++k) middle += mesh.positions[2 * mesh.cells[3 * c + k]] / 3.0;
    material.push_back(static_cast<Index>(middle * num_materials));
  }
  Body body = make_mesh_body(mesh, material, 1.0);
  body.lattice.surface = Surface::calibrated;
  return body;
}

/// Returns input with one micropolar material and a horizon of three steps.
inline NetworkInput unstructured_micropolar_input(int count) {
  NetworkInput input;
  input.model = BondModel::micropolar;
  input.horizon = 3.0 / count;
  input.micromodulus = input.critical_stretch = Constants::continuum;
  input.materials = {{30.0, 0.02, 0.2}};
  return input;
}

}  // namespace perilink::test
