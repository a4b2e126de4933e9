#include "io/case/sections/case_bond_dynamics.hpp"

#include <fmt/format.h>

#include <string>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

void check_strain(const CaseFile& input) {
  if (input.analysis.strain != Strain::green || input.body.model == BodyModel::bond_based) return;
  const SourceLocation where = input.where("analysis.strain");
  if (is_particles(input.body)) {
    throw InputError(where, "is \"green\", but state-based particles are for small strains only",
                     "delete it");
  }
  throw InputError(
      where,
      fmt::format("is \"green\", but model is \"{}\", whose moments are for small rotations only",
                  word_of(input.body.model)),
      "set model = \"bond_based\" in [body], or strain = \"small\"");
}

void check_velocities(const CaseFile& input) {
  if (input.velocities.empty()) return;
  const std::string key = item_key("velocities", 0);
  for (std::size_t k = 0; k < input.displacements.size(); ++k) {
    for (const auto& value : input.displacements[k].value) {
      if (!value || value->is_zero()) continue;
      throw InputError(
          input.where(key),
          fmt::format("is given together with [[displacements]] that move region \"{}\"",
                      input.displacements[k].region),
          "move all regions by one of the two");
    }
  }
}

}  // namespace

void check_moving_bonds(const CaseFile& input) {
  check_strain(input);
  check_velocities(input);
}

}  // namespace perilink
