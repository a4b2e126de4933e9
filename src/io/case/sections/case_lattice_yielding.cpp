#include <fmt/format.h>

#include <limits>

#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"

namespace perilink {
void read_lattice_yielding(const CaseTable& table, const BodySection& body,
                           LatticeMaterialSection& section) {
  section.yield_strength = table.positive("yield_strength");
  for (const char* key : {"ultimate_strength", "ultimate_plastic_strain", "crushing_energy"}) {
    if (section.yield_strength || !table.has(key)) continue;
    table.refuse(key, "is given, but the material does not yield",
                 "delete it, or give `yield_strength`");
  }
  if (!section.yield_strength) return;
  if (dimension_of(body) == 3 && body.variant == LatticeRules::least_2018) {
    table.refuse("yield_strength", "is given, but the rules of 2018 have no yielding in space",
                 "choose another variant in [body], or a body in the plane");
  }
  section.ultimate_strength = table.need(
      "ultimate_strength", table.positive("ultimate_strength"),
      "the yield stress where hardening ends; equal to `yield_strength` without hardening");
  if (*section.ultimate_strength < *section.yield_strength) {
    table.refuse("ultimate_strength",
                 fmt::format("is {}, less than the yield strength {}", *section.ultimate_strength,
                             *section.yield_strength),
                 "give at least the yield strength");
  }
  section.ultimate_plastic_strain =
      table.need("ultimate_plastic_strain", table.positive("ultimate_plastic_strain"),
                 "the plastic strain at the ultimate strength");
  if (body.variant == LatticeRules::consistent) {
    section.crushing_energy = read_energy(
        table, "crushing_energy",
        "the energy per area that crushing takes, or \"infinite\" for a material that keeps its "
        "ultimate strength");
  } else if (table.has("crushing_energy")) {
    table.refuse("crushing_energy",
                 fmt::format("is given, but the rules of {} have their own softening",
                             word_of(body.variant)),
                 "delete it, or set variant = \"consistent\" in [body]");
  }
}

void write_lattice_yielding(TomlWriter& out, const LatticeMaterialSection& section) {
  if (!section.yield_strength) return;
  out.write("yield_strength", section.yield_strength);
  out.write("ultimate_strength", section.ultimate_strength);
  out.write("ultimate_plastic_strain", section.ultimate_plastic_strain);
  if (!section.crushing_energy) return;
  if (*section.crushing_energy == std::numeric_limits<double>::infinity()) {
    out.write("crushing_energy", infinite_energy);
  } else {
    out.write("crushing_energy", section.crushing_energy);
  }
}

}  // namespace perilink
