#include "io/case/sections/case_elements.hpp"

#include <fmt/format.h>

#include "io/case/binding/key_binding.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

std::optional<ElementsSection> read_elements(const CaseTable& table, Kinds kind) {
  if (!table.exists()) return std::nullopt;
  auto elements = read_section<ElementsSection>("elements", table, kind);
  read_mesh_file(table, elements);
  if (elements.tied.empty() || elements.mesh || elements.mesh_size) {
    table.need_one_of({"spacings", "size", "mesh"});
  }
  return elements;
}

namespace {

/// Refuses tied finite elements where they are not supported.
void check_tied(const CaseFile& input) {
  if (input.elements->tied.empty()) return;
  const auto refuse = [&](const char* why, const char* hint) {
    throw InputError(input.where("elements.glued"), why, hint);
  };
  if (!input.body.mesh) {
    refuse("is for bodies of a mesh, whose cells become the elements",
           "give `mesh` in [body], or spacings = 8 here: elements that constrain particles");
  }
  if (input.analysis.type == AnalysisType::explicit_ ||
      input.analysis.type == AnalysisType::relaxation) {
    refuse(
        "is for elastic and damage analyses: explicit runs and relaxation have no finite elements",
        "delete the key, and mesh the whole body at one size");
  }
  if (!input.rebar.empty()) {
    refuse("is given together with [[rebar]], which needs particles", "delete the key");
  }
}

}  // namespace

void check_elements(const CaseFile& input) {
  if (!input.elements) return;
  check_tied(input);
  const ElementsSection& section = *input.elements;
  if (input.analysis.solver == LinearSolver::iterative &&
      (section.spacings || section.size || section.mesh)) {
    throw InputError(
        input.where("analysis.solver"),
        "is \"iterative\", but [elements] constrain particles, which needs the direct solver",
        "delete one of the two, or set solver = \"direct\"");
  }
  if (input.body.surface != Surface::calibrated) {
    throw InputError(
        input.where("body.surface"),
        fmt::format("is {}, but [elements] need calibrated bonds, which balance every uniform "
                    "strain as elements do",
                    quoted(std::string(word_of(input.body.surface)))),
        "delete the line, or the table [elements]");
  }
  if (input.elements->release_strain && !input.stages.empty()) {
    throw InputError(input.where("elements.alert_strain"),
                     "is given, but the case has [[stages]], under which strains do not grow in "
                     "proportion",
                     "give `alert` instead");
  }
}

}  // namespace perilink
