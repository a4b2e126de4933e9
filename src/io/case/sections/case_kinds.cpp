#include "io/case/sections/case_kinds.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "base/types.hpp"
#include "io/case/case_words.hpp"

namespace perilink {

Kinds kinds_of(const CaseFile& input) {
  const auto bit = [](Kinds first, auto value) { return first << static_cast<Kinds>(value); };
  const BodySection& body = input.body;
  return (body.method == BodyMethod::bonds ? bit(kinds::bond_based, body.model) : kinds::elements) |
         (is_shell(body)            ? kinds::shell
          : is_beam(body)           ? kinds::beam | kinds::plane
          : dimension_of(body) == 2 ? kinds::plane
                                    : kinds::space) |
         bit(kinds::damage, input.analysis.type);
}

int dimension_of(const BodySection& body) { return dimension_of(body.problem); }

int axes_of(const BodySection& body) { return is_shell(body) ? 3 : dimension_of(body); }

bool is_shell(const BodySection& body) { return body.problem == Problem::shell; }

bool is_beam(const BodySection& body) { return body.problem == Problem::beam; }

bool is_lattice(const BodySection& body) { return body.model == BodyModel::lattice; }

bool is_particles(const BodySection& body) { return body.model == BodyModel::particles; }

bool has_state_based_particles(const BodySection& body) {
  return is_lattice(body) || is_particles(body);
}

double event_tolerance_of(const CaseFile& input) {
  // verification/studies/event_tolerance
  constexpr double usual = 0.01;
  const auto softens = [](const auto& section) {
    return section.softening.shape.kind != Softening::brittle;
  };
  const bool any = std::ranges::any_of(input.materials, softens) ||
                   std::ranges::any_of(input.interfaces, softens);
  return input.analysis.event_tolerance.value_or(any ? usual : 0.0);
}

std::string why_nothing_rotates(const BodySection& body) {
  if (body.method == BodyMethod::linear_elements)
    return "the corners of linear elements do not rotate";
  return fmt::format("the particles of a {} body do not rotate", is_lattice(body) ? "lattice"
                                                                 : has_state_based_particles(body)
                                                                     ? "state-based"
                                                                     : "bond-based");
}

std::string what_rotates(const BodySection& body) {
  return body.method == BodyMethod::linear_elements
             ? "set model = \"micropolar\" in [body] instead of method = \"linear_elements\""
             : "set model = \"micropolar\" in [body]";
}

void read_mesh_file(const CaseTable& table, MeshSource& source) {
  if (!table.has("mesh")) return;
  source.mesh = table.path("mesh");
  const std::string& mesh = *source.mesh;
  if (mesh.empty()) table.refuse("mesh", "is empty", "name the file of a mesh");
  if (source.mesh_size && !is_geometry(mesh)) {
    table.refuse("mesh_size", "is given, but `mesh` is meshed already",
                 "delete it, or name a geometry (.geo, .step, .stp, .brep) as `mesh`");
  }
  if (!source.mesh_size && is_geometry(mesh) && !is_gmsh_script(mesh)) {
    table.refuse_missing("mesh_size", "the size of the cells of this geometry");
  }
}

std::vector<NamedGroup> named_groups(const CaseFile& input) {
  std::vector<NamedGroup> groups;
  const auto add = [&](const char* table, const auto& sections) {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      if (!sections[k].group.empty()) {
        groups.push_back({item_key(table, k, "group"), sections[k].group});
      }
    }
  };
  add("regions", input.regions);
  add("cracks", input.cracks);
  add("interfaces", input.interfaces);
  add("rebar", input.rebar);
  return groups;
}

void need_fracture_energy(const CaseTable& table, AnalysisType type, MaterialSection& material) {
  if (table.has("fracture_energy")) return;
  if (type != AnalysisType::elastic) {
    table.refuse_missing("fracture_energy",
                         "the fracture energy, or \"infinite\" for a material that cannot break");
  }
  material.fracture_energy = infinity;
}

}  // namespace perilink
