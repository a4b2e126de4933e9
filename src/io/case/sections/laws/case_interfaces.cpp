// [[interfaces]] of a case.

#include "io/case/sections/laws/case_interfaces.hpp"
#include "base/plain_text.hpp"

#include <fmt/format.h>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {

void read_face(const CaseTable& table, int dim, std::vector<Vector3>& points, std::string& group) {
  const std::string key = dim == 2 ? "points" : "corners";
  assign(points, table.vectors(key, dim));
  if (table.has(key) && points.size() < static_cast<std::size_t>(dim)) {
    table.refuse(key, fmt::format("has {}", points.size()),
                 dim == 2 ? "a line needs two points or more" : "a plane needs three corners");
  }
  assign(group, table.text("group"));
  if (table.has("group") && group.empty()) {
    table.refuse("group", "is empty", "name physical curves of the mesh, in space surfaces");
  }
}

void write_face(TomlWriter& out, const std::vector<Vector3>& points, const std::string& group,
                int dim) {
  if (!group.empty()) return out.write("group", std::string_view(group));
  out.write(dim == 2 ? "points" : "corners", points, dim);
}

InterfaceSection read_interface(const CaseTable& table, Kinds kind) {
  auto section = read_section<InterfaceSection>("interfaces", table, kind);
  if (table.has("between") && section.between.size() != 2) {
    table.refuse("between", "names " + counted(section.between.size(), "region"),
                 "name the two on either side of the face: [\"plate\", \"patch\"]");
  }
  if (section.between.size() == 2 && section.between[0] == section.between[1]) {
    table.refuse("between", fmt::format("names {} twice", quoted(section.between[0])),
                 "name the two on either side of the face; a face inside one region is given by "
                 "its points, corners or group");
  }
  read_face(table, dimension_of(kind), section.points, section.group);
  section.softening = read_softening(table);
  if (!has_stretches(section.softening) && !table.has("fracture_energy")) {
    table.refuse_missing("fracture_energy", "the energy that the face takes per area");
  }
  return section;
}

void check_interfaces(const CaseFile& input) {
  if (input.interfaces.empty()) return;
  if (input.body.surface == Surface::ghost && input.analysis.type != AnalysisType::elastic) {
    throw InputError(input.where("body.surface"),
                     "is \"ghost\", but ghosts, which have no material, would bridge the ends of "
                     "[[interfaces]]",
                     "set surface = \"calibrated\" or \"none\", or delete the interfaces");
  }
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    if (input.materials[m].softening.shape.kind != Softening::concrete) continue;
    throw InputError(
        input.where(item_key("materials", m, "softening")),
        "is \"concrete\", whose bonds crush near damaged bonds, but the case has [[interfaces]]",
        "set \"linear\", \"bilinear\", \"exponential\" or \"brittle\", or delete the interfaces");
  }
}

}  // namespace perilink
