#include <fmt/format.h>

#include "io/mesh/gmsh_mesher.hpp"
#include "patch.hpp"

namespace perilink::verification {

std::vector<PatchBody> patch_bodies() {
  std::vector<PatchBody> bodies;
  const auto lattice = [&](const char* name, const char* pattern, double spacing, int ratio,
                           int dim) {
    bodies.push_back({fmt::format("{}_{}", name, ratio),
                      fmt::format("pattern = \"{}\"\nspacing = {}\nhorizon_ratio = {}\n", pattern,
                                  spacing, ratio),
                      dim});
  };
  for (const int ratio : {2, 3, 4}) lattice("rectangular", "rectangular", 0.05, ratio, 2);
  for (const int ratio : {2, 3, 4}) lattice("hexagonal", "hexagonal", 0.05, ratio, 2);
  for (const int ratio : {2, 3}) lattice("cubic", "cubic", 0.125, ratio, 3);
  for (const int ratio : {2, 3}) lattice("face_centred", "face_centred", 0.15, ratio, 3);
  const auto mesh = [&](const char* name, const char* group, int dim) {
    bodies.push_back(
        {name, fmt::format("mesh = \"{}.msh\"\nhorizon_ratio = 3\n", name), dim, group});
  };
  mesh("plate_with_hole", "plate", 2);
  mesh("disc", "disc", 2);
  mesh("l_shape", "body", 2);
  mesh("block_with_hole", "body", 3);
  mesh("cylinder", "body", 3);
  mesh("l_block", "body", 3);
  mesh("l_block_coarse", "body", 3);
  if (has_gmsh()) {
    lattice("unstructured", "unstructured", 0.05, 3, 2);
    lattice("unstructured_space", "unstructured", 0.15, 3, 3);
  }
  const std::size_t count = bodies.size();
  for (std::size_t k = 0; k < count; ++k) {
    PatchBody body = bodies[k];
    body.name += "_micropolar";
    body.micropolar = true;
    bodies.push_back(body);
  }
  return bodies;
}

}  // namespace perilink::verification
