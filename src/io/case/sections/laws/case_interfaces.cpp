// [[interfaces]] of a case.

#include "io/case/sections/laws/case_interfaces.hpp"
#include "base/plain_text.hpp"

#include <fmt/format.h>

#include "io/case/case_words.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {

InterfaceSection read_interface(const CaseTable& table, int dim) {
  const std::string key = dim == 2 ? "points" : "corners";
  InterfaceSection section;
  table.need_one_of({"between", key, "group"});
  assign(section.between, table.texts("between"));
  if (table.has("between") && section.between.size() != 2) {
    table.refuse("between", "names " + counted(section.between.size(), "region"),
                 "name the two on either side of the face: [\"plate\", \"patch\"]");
  }
  if (section.between.size() == 2 && section.between[0] == section.between[1]) {
    table.refuse("between", fmt::format("names {} twice", quoted(section.between[0])),
                 "name the two on either side of the face; a face inside one region is given by "
                 "its " +
                     quoted(key));
  }
  assign(section.points, table.vectors(key, dim));
  if (table.has(key) && section.points.size() < static_cast<std::size_t>(dim)) {
    table.refuse(key, fmt::format("has {}", section.points.size()),
                 dim == 2 ? "a line needs two points or more" : "a plane needs three corners");
  }
  assign(section.group, table.text("group"));
  if (table.has("group") && section.group.empty()) {
    table.refuse("group", "is empty", "name physical curves of the mesh, in space surfaces");
  }
  if (table.choice<Softening>("softening") == Softening::concrete) {
    table.refuse("softening", "is \"concrete\", a law with crushing, which interfaces do not have",
                 "set \"brittle\", \"linear\", \"bilinear\" or \"exponential\"");
  }
  section.softening = read_softening(table);
  if (!has_stretches(section.softening)) {
    section.fracture_energy = table.need("fracture_energy", table.positive("fracture_energy"),
                                         "the energy that the face takes per area");
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
  for (std::size_t k = 0; k < input.interfaces.size(); ++k) {
    if (input.interfaces[k].group.empty() || input.body.mesh) continue;
    throw InputError(input.where(item_key("interfaces", k, "group")),
                     fmt::format("is {}, a physical group of a mesh, but the body has no mesh",
                                 quoted(input.interfaces[k].group)),
                     "give `between`, or the place of the face");
  }
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    if (input.materials[m].softening.shape.kind != Softening::concrete) continue;
    throw InputError(
        input.where(item_key("materials", m, "softening")),
        "is \"concrete\", whose bonds crush near damaged bonds, but the case has [[interfaces]]",
        "set \"linear\", \"bilinear\", \"exponential\" or \"brittle\", or delete the interfaces");
  }
}

void write_interface(TomlWriter& out, const InterfaceSection& section, int dim) {
  out.header("[[interfaces]]");
  if (!section.between.empty()) {
    out.write("between", section.between);
  } else if (!section.group.empty()) {
    out.write("group", section.group);
  } else {
    std::vector<std::vector<double>> points;
    for (const Vector3& x : section.points) points.emplace_back(x.begin(), x.begin() + dim);
    out.write(dim == 2 ? "points" : "corners", points);
  }
  if (!has_stretches(section.softening)) out.write("fracture_energy", section.fracture_energy);
  write_softening(out, section.softening);
}

}  // namespace perilink
