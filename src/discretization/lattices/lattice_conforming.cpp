#include <vector>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

/// Divides the volume of every cell inside the body equally among its corners (bilinear and
/// trilinear shape functions). In a face-centred lattice only corners with an even sum of numbers
/// exist, four per half cube.
/// \return volumes of the grid's points, x fastest
std::vector<double> share_cells(const LatticeInput& input, const Lattice& lattice,
                                const Box& bounds, const std::array<Index, 3>& steps) {
  const bool alternate = lattice.pattern == Pattern::face_centred;
  const Index nx = steps[0] + 1;
  const Index ny = steps[1] + 1;
  const Index nz = steps[2] + 1;
  const Index layers = lattice.dim == 3 ? steps[2] : 1;
  const int corner_layers = lattice.dim == 3 ? 2 : 1;
  const double share = lattice.cell_volume / (alternate ? 8.0 : 4.0 * corner_layers);
  std::vector<double> volumes(static_cast<std::size_t>(nx) * ny * nz, 0.0);
  for (Index k = 0; k < layers; ++k) {
    for (Index j = 0; j < steps[1]; ++j) {
      for (Index i = 0; i < steps[0]; ++i) {
        if (cell_material(input, lattice, bounds, {i, j, k}) == no_index) continue;
        for (int corner = 0; corner < 4 * corner_layers; ++corner) {
          const Index a = i + (corner & 1);
          const Index b = j + ((corner >> 1) & 1);
          const Index c = k + (corner >> 2);
          if (alternate && (a + b + c) % 2 != 0) continue;
          volumes[a + static_cast<std::size_t>(nx) * (b + static_cast<std::size_t>(ny) * c)] +=
              share;
        }
      }
    }
  }
  return volumes;
}

}  // namespace

Particles fill_conforming_grid(const LatticeInput& input, const Lattice& lattice,
                               const Outline& outline) {
  const Box& bounds = outline.bounds;
  const auto steps = count_steps(lattice, bounds);
  const std::vector<double> volumes = share_cells(input, lattice, bounds, steps);
  Particles particles;
  particles.dim = lattice.dim;
  std::size_t point = 0;
  for (Index k = 0; k <= steps[2]; ++k) {
    for (Index j = 0; j <= steps[1]; ++j) {
      for (Index i = 0; i <= steps[0]; ++i, ++point) {
        if (volumes[point] == 0.0) continue;
        const Vector3 position = {plane(bounds, lattice, 0, i, steps[0]),
                                  plane(bounds, lattice, 1, j, steps[1]),
                                  plane(bounds, lattice, 2, k, steps[2])};
        const Index material =
            material_at(input, {position.data(), static_cast<std::size_t>(lattice.dim)});
        add_particle(particles, position, volumes[point], material, ParticleKind::solid);
      }
    }
  }
  return particles;
}

}  // namespace perilink
