#include "model/body/mesh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "discretization/meshes/mesh_conformity.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/mesh/gmsh_mesher.hpp"
#include "io/mesh/mesh_file.hpp"
#include "io/text/toml_tree.hpp"
#include "model/body/groups/drawn_groups.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

fs::path seen_from_case(const CaseFile& input, const std::string& file) {
  return fs::path(input.source.path).parent_path() / file;
}

fs::path mesh_path(const CaseFile& input) { return seen_from_case(input, *input.body.mesh); }

/// Returns the group with a name, of the highest dimension where several share it.
const MeshGroup* find_group(const Mesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.groups.rbegin(), mesh.groups.rend(),
                                  [&](const MeshGroup& group) { return group.name == name; });
  return found != mesh.groups.rend() ? &*found : nullptr;
}

const char* elements_of(const MeshGroup& group) {
  constexpr const char* elements[] = {"points", "lines", "triangles", "tetrahedra"};
  return elements[group.dim];
}

std::string suggest_group(const Mesh& mesh, const std::string& name) {
  if (mesh.groups.empty()) {
    return fmt::format(
        "the mesh has no group at all; write Physical {}(\"{}\") = {{...}}; in the geometry of "
        "gmsh, or a set in Abaqus",
        mesh.dim == 2 ? "Surface" : "Volume", name);
  }
  std::vector<std::string_view> names;
  for (const MeshGroup& group : mesh.groups) {
    if (std::ranges::find(names, group.name) == names.end()) names.emplace_back(group.name);
  }
  return suggest(name, names);
}

void refuse_unknown_groups(const CaseFile& input, const Mesh& mesh) {
  for (std::size_t i = 0; i < input.regions.size(); ++i) {
    const std::string& name = input.regions[i].group;
    if (name.empty() || find_group(mesh, name) != nullptr) continue;
    throw InputError(
        input.where(item_key("regions", i, "group")),
        fmt::format("is {}, but {} has no such group", quoted(name), mesh_path(input).string()),
        suggest_group(mesh, name));
  }
}

/// Refuses named groups of lines that leave the plane of a two-dimensional mesh.
void refuse_groups_off_plane(const CaseFile& input, const Mesh& mesh) {
  for (const auto& [key, name] : named_groups(input)) {
    const bool off_plane = std::ranges::any_of(
        mesh.groups, [&](const MeshGroup& group) { return group.name == name && group.off_plane; });
    if (!off_plane) continue;
    throw InputError(
        input.where(key),
        fmt::format("is {}, a group with lines outside the plane of the body", quoted(name)),
        "draw two-dimensional bodies in the plane of x and y");
  }
}

/// Adds notes on names shared by several groups and on the unit of a geometry file.
void add_notes(const CaseFile& input, MeshInput& read) {
  read.notes = read.mesh.notes;
  for (const Region& region : input.regions) {
    const auto named = [&](const MeshGroup& group) { return group.name == region.group; };
    if (std::count_if(read.mesh.groups.begin(), read.mesh.groups.end(), named) < 2) continue;
    read.notes.push_back(fmt::format(
        "the region {} is the group {} of {}; groups of lower dimension have the same name and are "
        "not used",
        quoted(region.name), quoted(region.group),
        elements_of(*find_group(read.mesh, region.group))));
  }
  const fs::path path = mesh_path(input);
  if (!is_geometry(path.string()) || is_gmsh_script(path.string())) return;
  const std::vector<double>& positions = read.mesh.positions;
  std::vector<double> lower(positions.begin(), positions.begin() + read.mesh.dim), upper = lower;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const std::size_t axis = k % lower.size();
    lower[axis] = std::min(lower[axis], positions[k]);
    upper[axis] = std::max(upper[axis], positions[k]);
  }
  const bool step = std::string_view("sS").find(path.extension().string()[1]) != std::string::npos;
  read.notes.push_back(fmt::format(
      "{}: {}{}; the mesh goes from ({}) to ({})", path.string(),
      step ? "lengths are in millimetres, to which gmsh converts STEP files from any unit"
           : "BREP files state no unit, so lengths are taken as they stand in the file",
      input.body.mesh_scale ? fmt::format(", times {}", *input.body.mesh_scale) : "", joined(lower),
      joined(upper)));
}

/// Regions of the materials with the material of each, in order of precedence.
struct Patches {
  std::vector<Region> regions;
  std::vector<Index> material;
};

Patches patches_of(const CaseFile& input, const Mesh& mesh) {
  Patches patches;
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    for (const std::string& name : input.materials[m].regions) {
      const auto region = std::find_if(input.regions.begin(), input.regions.end(),
                                       [&](const Region& r) { return r.name == name; });
      if (!region->group.empty()) {
        group_of_cells(input, mesh, *region, item_key("materials", m), "material");
      }
      patches.regions.push_back(*region);
      patches.material.push_back(static_cast<Index>(m));
    }
  }
  return patches;
}

}  // namespace

Mesh read_mesh(const CaseFile& input, const std::string& key, const MeshSource& source, int dim) {
  try {
    const std::string path = seen_from_case(input, *source.mesh).string();
    const double scale = source.mesh_scale.value_or(1.0);
    const auto size = source.mesh_size ? std::optional(*source.mesh_size / scale) : std::nullopt;
    Mesh mesh = is_geometry(path) ? mesh_geometry(path, dim, size, input.trust_geometry)
                                  : load_mesh(path, dim);
    for (double& x : mesh.positions) x *= scale;
    return mesh;
  } catch (const CellSizeError& error) {
    throw InputError(input.where(key + "_size"), error.what(),
                     "give a larger size; mesh_size is a length of the case");
  } catch (const FileError& error) {
    throw InputError(input.where(key), error.what(),
                     "give the path relative to the folder of the case");
  } catch (const InputError& error) {
    if (key == "body.mesh") throw;
    throw InputError(input.where(key), fmt::format("cannot be used: {}", error.what()), "");
  }
}

const MeshGroup& group_of_cells(const CaseFile& input, const Mesh& mesh, const Region& region,
                                const std::string& key, const std::string& contents) {
  const MeshGroup* group = find_group(mesh, region.group);
  if (group->dim == mesh.dim) return *group;
  throw InputError(
      input.where(key),
      fmt::format("the region {} is a group of {}, which contain no {}", quoted(region.name),
                  elements_of(*group), contents),
      fmt::format("name a physical {}, or give a box", mesh.dim == 2 ? "surface" : "volume"));
}

MeshInput read_mesh_input(const CaseFile& input, int dim) {
  MeshInput read;
  read.mesh = read_mesh(input, "body.mesh", input.body, dim);
  refuse_unknown_groups(input, read.mesh);
  refuse_groups_off_plane(input, read.mesh);
  add_notes(input, read);
  const Patches patches = patches_of(input, read.mesh);
  read.material = materials_of_cells(read.mesh, patches.regions, patches.material);
  return read;
}

namespace {

/// Per cell of the mesh, nonzero where it is a tied finite element; empty: no such element.
std::vector<std::uint8_t> ordinary_elements(const CaseFile& input, const MeshInput& read) {
  std::vector<std::uint8_t> tied;
  if (!input.elements || input.elements->tied.empty()) return tied;
  const std::string key = "elements.glued";
  std::vector<Region> regions;
  for (const std::string& name : input.elements->tied) {
    regions.push_back(*std::find_if(input.regions.begin(), input.regions.end(),
                                    [&](const Region& region) { return region.name == name; }));
    if (!regions.back().group.empty()) {
      group_of_cells(input, read.mesh, regions.back(), key, "elements");
    }
  }
  const std::vector<Index> inside =
      materials_of_cells(read.mesh, regions, std::vector<Index>(regions.size(), 0));
  Index bonded = 0;
  for (std::size_t cell = 0; cell < inside.size(); ++cell) {
    tied.push_back(inside[cell] == no_index ? 0 : 1);
    bonded += inside[cell] == no_index && read.material[cell] != no_index;
  }
  if (std::count(tied.begin(), tied.end(), 1) == 0) {
    throw InputError(input.where(key), "contains no cell of the mesh",
                     "name regions that contain centres of cells");
  }
  if (bonded == 0) {
    throw InputError(input.where(key), "leaves no cell for bonds",
                     "leave a region where bonds can break, or set method = "
                     "\"linear_elements\" in [body] and delete the table");
  }
  return tied;
}

/// Refuses regions of lines outside the mesh, which contain no facet and hardly a particle.
void refuse_regions_of_curves(const CaseFile& input, const Body& body) {
  for (std::size_t i = 0; i < input.regions.size(); ++i) {
    const auto group =
        std::find_if(body.groups.rbegin(), body.groups.rend(),
                     [&](const Group& own) { return own.name == input.regions[i].group; });
    if (group == body.groups.rend()) continue;
    refuse_loose_group(input, item_key("regions", i, "group"), body, *group);
  }
}

}  // namespace

Body read_mesh_body(const CaseFile& input, int dim, std::vector<std::string>& notes) {
  MeshInput read = read_mesh_input(input, dim);
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  const bool takes_cracks = input.body.method == BodyMethod::bonds && !input.elements &&
                            input.body.model != BodyModel::particles;
  if (const Index sides = takes_cracks ? weld_slits(read.mesh) : 0; sides > 0) {
    notes.push_back(fmt::format("the mesh has slits of {}, treated as pre-cracks",
                                counted(sides, "cell side")));
  }
  const auto& [mesh, material, mesh_notes] = read;
  const auto left_out = std::count(material.begin(), material.end(), no_index);
  if (left_out > 0) {
    notes.push_back(fmt::format("left out: {} of the {} of the mesh, without material", left_out,
                                counted(material.size(), "cell")));
  }
  try {
    Body body = make_mesh_body(mesh, material, dim == 2 ? input.body.thickness : 1.0,
                               ordinary_elements(input, read));
    refuse_regions_of_curves(input, body);
    return body;
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where("body.mesh"),
                     fmt::format("names {}: {}", mesh_path(input).string(), error.what()), "");
  }
}

CaseFile seen_from(const CaseFile& input, const fs::path& directory) {
  CaseFile moved = input;
  const auto move = [&](std::optional<std::string>& file) {
    if (!file || fs::path(*file).is_absolute()) return;
    // Resolve links first: ".." after a link would lead elsewhere.
    const fs::path mesh = fs::weakly_canonical(seen_from_case(input, *file));
    file = mesh.lexically_relative(fs::weakly_canonical(directory)).string();
  };
  move(moved.body.mesh);
  if (moved.elements) move(moved.elements->mesh);
  for (GradedSection& graded : moved.fields.graded) move(graded.file);
  return moved;
}

std::string mesh_checksum(const CaseFile& input) {
  std::vector<std::string> contents;
  std::string sum;
  try {
    const auto read = [&](const std::optional<std::string>& file) {
      if (file) contents.push_back(read_regular_file(seen_from_case(input, *file).string()));
    };
    read(input.body.mesh);
    if (input.elements) read(input.elements->mesh);
    if (!contents.empty()) {
      contents.resize(2);
      sum = fingerprint(contents[0], contents[1]);
    }
    for (const GradedSection& graded : input.fields.graded) {
      contents.clear();
      if (is_used(input, graded)) read(graded.file);
      if (!contents.empty()) sum = fingerprint(sum, contents.front());
    }
  } catch (const FileError&) {  // the reader of the file reports it
    return "";
  }
  return sum;
}

}  // namespace perilink
