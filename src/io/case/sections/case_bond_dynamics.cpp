#include "io/case/sections/case_bond_dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

void check_strain(const CaseFile& input) {
  if (input.analysis.strain != Strain::green) return;
  const SourceLocation where = input.where("analysis.strain");
  if (const auto crack = first_closing_crack(input)) {
    throw InputError(where,
                     fmt::format("is \"green\", but the closed faces of {} do not turn with the "
                                 "body",
                                 item_key("cracks", *crack)),
                     "set closing = false in [[cracks]] for a notch that stays open, or strain = "
                     "\"small\"");
  }
  if (input.body.model == BodyModel::bond_based) return;
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

std::optional<std::size_t> first_closing_crack(const CaseFile& input) {
  const bool closes = std::ranges::any_of(
      input.materials, [](const MaterialSection& m) { return m.softening.closes; });
  for (std::size_t k = 0; k < input.cracks.size(); ++k) {
    if (input.cracks[k].closing.value_or(closes)) return k;
  }
  return std::nullopt;
}

void check_moving_bonds(const CaseFile& input) {
  check_strain(input);
  check_velocities(input);
}

}  // namespace perilink
