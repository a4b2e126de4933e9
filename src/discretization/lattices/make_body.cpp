#include "discretization/lattices/make_body.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

void check_input(const LatticeInput& input) {
  if (!(input.spacing > 0.0)) throw std::invalid_argument("the spacing must be positive");
  if (!(input.thickness > 0.0)) throw std::invalid_argument("the thickness must be positive");
  if (input.solid.size() != input.material.size()) {
    throw std::invalid_argument("every box of the body needs a material");
  }
  if (input.surface == Surface::ghost && !(input.horizon > 0.0)) {
    throw std::invalid_argument("a ghost layer needs a positive horizon");
  }
}

}  // namespace

Body make_body(const LatticeInput& input) {
  check_input(input);
  const int dim = dimension_of(input.pattern);
  const Outline outline = make_outline(input.solid, dim, input.boundary_tolerance * input.spacing);
  if (input.surface == Surface::ghost) return make_ghost_body(input, outline);

  Body body;
  body.lattice = conforming_lattice(input, outline.bounds, input.spacing);
  check_fit(input, body.lattice, outline);
  if (input.pattern == Pattern::hexagonal) {
    Simplices triangles;
    body.particles = fill_conforming_hexagonal(input, body.lattice, outline, triangles);
    body.facets = facets_of(triangles, body.particles.positions, input.thickness);
  } else {
    body.particles = fill_conforming_grid(input, body.lattice, outline);
    body.facets = grid_facets(input, body.lattice, outline, body.particles);
  }
  const double exact = volume(outline) * (dim == 2 ? input.thickness : 1.0);
  const double sum =
      std::accumulate(body.particles.volumes.begin(), body.particles.volumes.end(), 0.0);
  if (std::abs(sum - exact) > 1e-6 * exact) {
    throw std::invalid_argument("the particles fill a volume of " + std::to_string(sum) +
                                " instead of " + std::to_string(exact) +
                                ": the outline of the body misses the lattice");
  }
  return body;
}

}  // namespace perilink
