// [[random]] of a case.

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

bool has_property(const MaterialSection& material, RandomProperty property) {
  if (has_stretches(material.softening)) return false;
  return std::isfinite(property == RandomProperty::tensile_strength
                           ? material.softening.tensile_strength
                           : material.fracture_energy);
}

bool is_named(const RandomSection& section, const MaterialSection& material) {
  return std::ranges::find(section.materials, material.name) != section.materials.end();
}

/// Refuses names that are no material, and materials without the property.
void check_names(const CaseFile& input, const RandomSection& section, const std::string& table) {
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
                     section.property == RandomProperty::tensile_strength
                         ? "brittle bonds have property = \"fracture_energy\"; others need "
                           "`tensile_strength` and `fracture_energy` in [[materials]]"
                         : "leave the material out, or give it `fracture_energy`");
  }
  if (std::ranges::any_of(materials_that_scatter(input, section), [](int s) { return s != 0; }))
    return;
  throw InputError(input.where(table + ".property"),
                   fmt::format("is {}, but no material has a finite one", quoted(property)),
                   "brittle materials have `fracture_energy`, softening ones also "
                   "`tensile_strength`; laws by `softening_stretches` have neither");
}

}  // namespace

RandomSection read_random(const CaseTable& table, Kinds kind) {
  const auto section = read_section<RandomSection>("random", table, kind);
  if (table.has("materials") && section.materials.empty()) {
    table.refuse("materials", "is empty", "name materials, or delete the line for all of them");
  }
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

std::vector<std::uint8_t> materials_that_scatter(const CaseFile& input,
                                                 const RandomSection& section) {
  std::vector<std::uint8_t> scatters;
  for (const MaterialSection& material : input.materials) {
    scatters.push_back(section.materials.empty() ? has_property(material, section.property)
                                                 : is_named(section, material));
  }
  return scatters;
}

void check_random(const CaseFile& input) {
  if (input.analysis.type == AnalysisType::elastic) return;
  for (std::size_t k = 0; k < input.random.size(); ++k) {
    const RandomSection& section = input.random[k];
    check_names(input, section, item_key("random", k));
    const std::vector<std::uint8_t> own = materials_that_scatter(input, section);
    for (std::size_t other = 0; other < k; ++other) {
      if (input.random[other].property != section.property) continue;
      const std::vector<std::uint8_t> its = materials_that_scatter(input, input.random[other]);
      for (std::size_t m = 0; m < own.size(); ++m) {
        if (own[m] == 0 || its[m] == 0) continue;
        throw InputError(input.where(item_key("random", k, "property")),
                         fmt::format("is {}, which random[{}] varies in {} already",
                                     quoted(std::string(word_of(section.property))), other + 1,
                                     quoted(input.materials[m].name)),
                         "delete one of the two, or name different `materials`");
      }
    }
  }
}

}  // namespace perilink
