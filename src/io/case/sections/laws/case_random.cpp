// [[random]] and [[graded]] of a case.

#include "io/case/sections/laws/case_random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {
namespace {

bool has_property(const MaterialSection& material, VaryingProperty property) {
  if (property == VaryingProperty::youngs_modulus) return true;
  if (has_stretches(material.softening)) return false;
  return std::isfinite(property == VaryingProperty::tensile_strength
                           ? material.softening.tensile_strength
                           : material.fracture_energy);
}

bool is_named(const VaryingSection& section, const MaterialSection& material) {
  return std::ranges::find(section.materials, material.name) != section.materials.end();
}

/// Refuses names that are no material, and materials without the property.
void check_names(const CaseFile& input, const VaryingSection& section, const std::string& table) {
  std::vector<std::string_view> names;
  for (const MaterialSection& material : input.materials) names.push_back(material.name);
  const std::string property(word_of(section.property));
  for (const std::string& name : section.materials) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw InputError(input.where(table + ".materials"),
                       fmt::format("holds {}, but no [[materials]] has that name", quoted(name)),
                       suggest(name, names));
    }
    if (has_property(input.materials[static_cast<std::size_t>(found - names.begin())],
                     section.property)) {
      continue;
    }
    throw InputError(input.where(table + ".materials"),
                     fmt::format("holds {}, which has no finite {}", quoted(name), property),
                     section.property == VaryingProperty::tensile_strength
                         ? "brittle bonds have property = \"fracture_energy\"; others need "
                           "`tensile_strength` and `fracture_energy` in [[materials]]"
                         : "leave the material out, or give it `fracture_energy`");
  }
  if (std::ranges::any_of(materials_that_vary(input, section), [](int m) { return m != 0; }))
    return;
  throw InputError(input.where(table + ".property"),
                   fmt::format("is {}, but no material has a finite one", quoted(property)),
                   "brittle materials have `fracture_energy`, softening ones also "
                   "`tensile_strength`; laws by `softening_stretches` have neither");
}

/// Refuses strength of bodies without bonds. Refuses Young's modulus of some materials, since
/// joints are calibrated by the moduli of the materials, and beside springs with that stiffness.
void check_property(const CaseFile& input, const VaryingSection& section,
                    const std::string& table) {
  if (section.property != VaryingProperty::youngs_modulus) {
    if (input.body.method == BodyMethod::bonds) return;
    throw InputError(input.where(table), "is given, but linear elements have no bonds",
                     "delete it, or the line method = \"linear_elements\"");
  }
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    if (input.rebar[k].bond.type != RebarBond::concrete) continue;
    throw InputError(input.where(item_key("rebar", k, "bond")),
                     fmt::format("is \"concrete\", whose springs have one stiffness, but {} varies "
                                 "Young's modulus",
                                 table),
                     "choose another bond: \"perfect\", \"linear\", \"model_code\", \"curve\"");
  }
  if (section.materials.empty()) return;
  throw InputError(input.where(table + ".materials"),
                   "is given, but Young's modulus varies by one factor in the whole body",
                   "delete the line; where a part keeps its modulus, give [[graded]] a formula "
                   "that is 1 there: factor = \"x < 100 ? 1 : 2\"");
}

template <class Section>
void check_list(const CaseFile& input, const std::string& name,
                const std::vector<Section>& sections) {
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const Section& section = sections[k];
    check_property(input, section, item_key(name, k));
    if (!is_used(input, section)) continue;
    check_names(input, section, item_key(name, k));
    const std::vector<std::uint8_t> own = materials_that_vary(input, section);
    for (std::size_t other = 0; other < k; ++other) {
      if (sections[other].property != section.property) continue;
      const std::vector<std::uint8_t> its = materials_that_vary(input, sections[other]);
      for (std::size_t m = 0; m < own.size(); ++m) {
        if (own[m] == 0 || its[m] == 0) continue;
        throw InputError(input.where(item_key(name, k, "property")),
                         fmt::format("is {}, which {}[{}] varies in {} already",
                                     quoted(std::string(word_of(section.property))), name,
                                     other + 1, quoted(input.materials[m].name)),
                         "delete one of the two, or name different `materials`");
      }
    }
  }
}

void refuse_no_materials(const CaseTable& table, const VaryingSection& section) {
  if (table.has("materials") && section.materials.empty()) {
    table.refuse("materials", "is empty", "name materials, or delete the line for all of them");
  }
}

}  // namespace

RandomSection read_random(const CaseTable& table, Kinds kind) {
  const auto section = read_section<RandomSection>("random", table, kind);
  refuse_no_materials(table, section);
  const double variation = section.field.variation;
  if (section.field.distribution == Distribution::normal && variation > most_normal_variation) {
    table.refuse(
        "variation", fmt::format("is {:g}", variation),
        fmt::format("give 0.001 to {:g}; \"lognormal\" and \"weibull\" values stay positive "
                    "with more",
                    most_normal_variation));
  }
  return section;
}

GradedSection read_graded(const CaseTable& table, Kinds kind) {
  auto section = read_section<GradedSection>("graded", table, kind);
  refuse_no_materials(table, section);
  section.file = table.path("file");
  if (section.file && section.file->empty()) {
    table.refuse("file", "is empty", "name a file of points: file = \"strength.csv\"");
  }
  return section;
}

bool is_used(const CaseFile& input, const VaryingSection& section) {
  return input.analysis.type != AnalysisType::elastic ||
         section.property == VaryingProperty::youngs_modulus;
}

std::vector<std::string> unused_fields(const CaseFile& input) {
  std::vector<std::string> keys;
  const auto look = [&](const char* name, const auto& sections) {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      if (!is_used(input, sections[k])) keys.push_back(item_key(name, k));
    }
  };
  look("random", input.fields.random);
  look("graded", input.fields.graded);
  return keys;
}

std::vector<std::uint8_t> materials_that_vary(const CaseFile& input,
                                              const VaryingSection& section) {
  std::vector<std::uint8_t> varies;
  for (const MaterialSection& material : input.materials) {
    varies.push_back(section.materials.empty() ? has_property(material, section.property)
                                               : is_named(section, material));
  }
  return varies;
}

void check_fields(const CaseFile& input) {
  check_list(input, "random", input.fields.random);
  check_list(input, "graded", input.fields.graded);
}

}  // namespace perilink
