#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <ostream>
#include <vector>

#include "discretization/lattices/make_body.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "network/builder/network_builder.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink::test {

inline constexpr double height_of_joint = 0.5;

struct JointCase {
  const char* name;
  Pattern pattern;
  int dim;
  double contrast;  ///< modulus above over modulus below
  double ratio;     ///< horizon over spacing
  /// Poisson's ratios of micropolar bonds below and above; empty: bonds without moments.
  std::optional<std::array<double, 2>> poisson = std::nullopt;
};

/// Prints the name; otherwise CTest would list the bytes of a case.
inline void PrintTo(const JointCase& tested, std::ostream* stream) { *stream << tested.name; }

/// Unit box with the second material above the joint along the last axis.
struct JointBody {
  Body body;
  NetworkInput input;
  Network network;

  JointBody(const JointCase& tested, int count) {
    const int last = tested.dim - 1;
    if (tested.pattern == Pattern::irregular) {
      Mesh mesh = box_mesh(tested.dim, count);
      for (Index i = 0; i < mesh.num_points(); ++i) {  // back onto the joint
        double& x = mesh.positions[i * tested.dim + last];
        if (std::abs(x - height_of_joint) < 0.2 / count) x = height_of_joint;
      }
      std::vector<Index> material;
      for (Index e = 0; e < mesh.num_cells(); ++e) {
        double middle = 0.0;
        for (int c = 0; c <= tested.dim; ++c) {
          middle += mesh.positions[mesh.cells[e * (tested.dim + 1) + c] * tested.dim + last];
        }
        material.push_back(middle > height_of_joint * (tested.dim + 1) ? 1 : 0);
      }
      body = make_mesh_body(mesh, material, 1.0);
      body.lattice.surface = Surface::calibrated;
      input.horizon = tested.ratio * body.lattice.spacing;
      input.critical_stretch = Constants::continuum;  // as for meshes in case files
    } else {
      LatticeInput lattice;
      lattice.pattern = tested.pattern;
      lattice.surface = Surface::calibrated;
      lattice.spacing = 1.0 / count;
      Box below{{0, 0, 0}, {1, 1, 1}}, above = below;
      below.upper[last] = above.lower[last] = height_of_joint;
      lattice.solid = {below, above};
      lattice.material = {0, 1};
      lattice.unlike_materials = true;
      lattice.horizon = tested.ratio * lattice.spacing;
      body = make_body(lattice);
      input.solid = lattice.solid;
      input.horizon = lattice.horizon;
    }
    input.problem = tested.dim == 2 ? Problem::plane_stress : Problem::three_dimensional;
    input.materials = {{3.0}, {3.0 * tested.contrast}};
    if (tested.poisson) {
      input.model = BondModel::micropolar;
      for (int side = 0; side < 2; ++side) {
        input.materials[side].poissons_ratio = (*tested.poisson)[side];
      }
    }
    network = build_network(body, input);
  }
};

}  // namespace perilink::test
