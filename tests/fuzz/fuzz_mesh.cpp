// Feeds arbitrary bytes to the readers of meshes, of Abaqus if they begin with a star, and what
// they accept to make_mesh_body().
// They may refuse it with their own errors and nothing else.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "base/error.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "io/mesh/mesh_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const int dim : {2, 3}) {
    try {
      const char* const name = bytes.starts_with('*') ? "fuzz.inp" : "fuzz.msh";
      const perilink::Mesh mesh = perilink::parse_mesh(bytes, name, dim);
      const std::vector<perilink::Index> material(static_cast<std::size_t>(mesh.num_cells()), 0);
      perilink::make_mesh_body(mesh, material, 1.0);
    } catch (const perilink::InputError&) {
    } catch (const std::invalid_argument&) {
    }
  }
  return 0;
}
