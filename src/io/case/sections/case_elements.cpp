#include "io/case/sections/case_elements.hpp"

#include <fmt/format.h>

#include "io/case/case_schema.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

std::optional<ElementsSection> read_elements(const CaseTable& table) {
  constexpr int most_spacings = 1000;
  if (!table.exists()) return std::nullopt;
  ElementsSection elements;
  elements.spacings = table.integer("spacings", 2, most_spacings);
  elements.size = table.positive("size");
  read_mesh_file(table, elements.mesh, elements.mesh_size);
  table.need_one_of({"spacings", "size", "mesh"});
  assign(elements.order, table.integer("order", 1, 2));
  assign(elements.regions, table.texts("regions"));
  assign(elements.particles, table.texts("particles"));
  assign(elements.alert, table.fraction("alert"));
  elements.halo = table.positive("halo");
  return elements;
}

void check_elements(const CaseFile& input) {
  if (!input.elements) return;
  if (input.body.surface != Surface::calibrated) {
    throw InputError(
        input.where("body.surface"),
        fmt::format("is {}, but [elements] need calibrated bonds, which balance every uniform "
                    "strain as elements do",
                    quoted(std::string(word_of(input.body.surface)))),
        "delete the line, or the table [elements]");
  }
}

void write_elements(TomlWriter& out, const ElementsSection& elements) {
  out.header("[elements]");
  out.write("spacings", elements.spacings);
  out.write("size", elements.size);
  out.write("mesh", elements.mesh);
  out.write("mesh_size", elements.mesh_size);
  out.write("order", elements.order);
  if (!elements.regions.empty()) out.write("regions", elements.regions);
  if (!elements.particles.empty()) out.write("particles", elements.particles);
  out.write("alert", elements.alert);
  out.write("halo", elements.halo);
}

}  // namespace perilink
