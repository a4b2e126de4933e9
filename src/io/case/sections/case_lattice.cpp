#include "io/case/sections/case_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

/// Keys of [[materials]] that unbreakable materials cannot have.
constexpr std::array softening_keys = {"tensile_strength",      "knee_stress_ratio",
                                       "knee_opening_ratio",    "compression_ratio",
                                       "compression_threshold", "boundary_factor"};
/// Checks the yield strength and the keys of hardening.
void check_lattice_yielding(const CaseTable& table, const BodySection& body,
                            const LatticeMaterialSection& section) {
  if (!section.yield_strength) return;
  if (dimension_of(body) == 3 && body.variant == LatticeRules::least_2018) {
    table.refuse("yield_strength", "is given, but the rules of 2018 have no yielding in space",
                 "choose another variant in [body], or a body in the plane");
  }
  if (*section.ultimate_strength < *section.yield_strength) {
    table.refuse("ultimate_strength",
                 fmt::format("is {}, less than the yield strength {}", *section.ultimate_strength,
                             *section.yield_strength),
                 "give at least the yield strength");
  }
  if (body.variant == LatticeRules::consistent) {
    if (!section.crushing_energy) {
      table.refuse_missing("crushing_energy",
                           "the energy per area that crushing takes, or \"infinite\" for a "
                           "material that keeps its ultimate strength");
    }
  } else if (section.crushing_energy) {
    table.refuse("crushing_energy",
                 fmt::format("is given, but the rules of {} have their own softening",
                             word_of(body.variant)),
                 "delete it, or set variant = \"consistent\" in [body]");
  }
}

void check_times(const CaseFile& input) {
  for (const double time : input.output.fields_times) {
    if (time <= input.analysis.duration) continue;
    throw InputError(
        input.where("output.fields_times"),
        fmt::format("holds {}, later than the duration {}", time, input.analysis.duration),
        "give times from 0 to analysis.duration");
  }
}

void need_densities(const CaseFile& input) {
  for (std::size_t i = 0; i < input.materials.size(); ++i) {
    if (input.materials[i].density) continue;
    throw InputError(input.where(item_key("materials", i)),
                     "has no density, which an explicit analysis needs",
                     "give `density`, mass per volume");
  }
}

template <class Section>
void refuse_surfaces(const CaseFile& input, const std::string& table,
                     const std::vector<Section>& sections) {
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i].region != surface_region) continue;
    throw InputError(
        input.where(item_key(table, i, "region")),
        "is \"surface\", but the lattice of a body with model = \"lattice\" does not end "
        "on the surface",
        "name a region of the case");
  }
}

}  // namespace

void check_lattice_body(const CaseTable& table, const BodySection& body, Pattern only) {
  if (body.pattern != only) {
    table.refuse(
        "pattern",
        fmt::format("is \"{}\", but lattice particles in {} need another", word_of(body.pattern),
                    dimension_of(body) == 2 ? "the plane" : "space"),
        fmt::format("Allowed here: {}", word_of(only)));
  }
  if (!body.spacing) table.refuse_missing("spacing", "the distance of neighbouring particles");
}

LatticeMaterialSection usual_state_material(LatticeRules rules) {
  LatticeMaterialSection section;
  section.compression_threshold = rules == LatticeRules::least_2018 ? 0.8 : 1.0 / 3.0;
  section.boundary_factor = rules == LatticeRules::consistent ? 1.0 : 0.2;
  return section;
}

void check_state_material(const CaseTable& table, const CaseFile& input,
                          MaterialSection& material) {
  const BodySection& body = input.body;
  if (!material.poissons_ratio) table.refuse_missing("poissons_ratio", "Poisson's ratio");
  if (const double ratio = *material.poissons_ratio; !(ratio > -1.0 && ratio < 0.5)) {
    table.refuse("poissons_ratio",
                 fmt::format("is {}, but {} particles have ratios above -1 and below 1/2", ratio,
                             is_lattice(body) ? "lattice" : "state-based"),
                 "0.2 is usual for concrete");
  }
  if (!material.density) table.refuse_missing("density", "mass per volume");
  LatticeMaterialSection& section = *material.lattice;
  section.critical_opening = table.number("critical_opening");
  const bool given = table.has("fracture_energy") || section.critical_opening;
  if (given || input.analysis.type != AnalysisType::elastic) {
    table.need_one_of({"fracture_energy", "critical_opening"});
  }
  if (!section.critical_opening) need_fracture_energy(table, input.analysis.type, material);
  const bool breakable = !std::isinf(material.fracture_energy);
  if (breakable && dimension_of(body) == 3 && body.variant == LatticeRules::least_2018) {
    table.refuse(table.has("fracture_energy") ? "fracture_energy" : "critical_opening",
                 "is finite, but the rules of 2018 have no damage in space",
                 "write fracture_energy = \"infinite\", or choose another variant in [body]");
  }
  if (breakable) {
    section.tensile_strength = table.need("tensile_strength", table.number("tensile_strength"),
                                          "the tensile strength at which damage begins");
    assign(section.knee_stress_ratio, table.number("knee_stress_ratio"));
    assign(section.knee_opening_ratio, table.number("knee_opening_ratio"));
  }
  for (const char* key : softening_keys) {
    if (breakable || !given || !table.has(key)) continue;
    table.refuse(key, "is given, but the material is unbreakable",
                 "delete it, or give a finite fracture_energy");
  }
  check_lattice_yielding(table, body, section);
}

void write_state_law(TomlWriter& out, const LatticeMaterialSection& section) {
  if (!section.tensile_strength) return;
  out.write("tensile_strength", section.tensile_strength);
  out.write("critical_opening", section.critical_opening);
  out.write("knee_stress_ratio", section.knee_stress_ratio);
  out.write("knee_opening_ratio", section.knee_opening_ratio);
}

void check_lattice(const CaseFile& input) {
  check_times(input);
  if (!is_lattice(input.body)) {
    if (input.analysis.type == AnalysisType::explicit_) need_densities(input);
    return;
  }
  if (input.materials.size() > 1) {
    throw InputError(input.where("materials[2]"),
                     "is a second material, but a body with model = \"lattice\" has one",
                     "delete it, or name its regions in the first");
  }
  refuse_surfaces(input, "supports", input.supports);
  refuse_surfaces(input, "displacements", input.displacements);
  refuse_surfaces(input, "loads", input.loads);
  refuse_surfaces(input, "gauges", input.gauges);
}

}  // namespace perilink
