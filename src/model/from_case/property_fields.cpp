#include "model/from_case/property_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_rules.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "model/conditions/formula_field.hpp"
#include "model/from_case/field_file.hpp"

namespace perilink {
namespace {

/// Returns the value of a formula at positions, which must be positive.
std::function<double(std::span<const double>)> positive_formula(const CaseFile& input,
                                                                const std::string& key,
                                                                const Expression& formula) {
  const auto field =
      std::make_shared<PositionField>(input, key, std::span<const Expression>(&formula, 1));
  return [&input, key, field](std::span<const double> position) {
    const double value = field->at(position)[0];
    if (value > 0.0) return value;
    throw InputError(input.where(key),
                     fmt::format("is {} at the position ({})", value, joined(position)),
                     "write a formula that is positive in the whole body");
  };
}

/// Returns the key path of the first table that varies Young's modulus, of [[graded]] if possible.
std::string table_of_modulus(const CaseFile& input) {
  const auto& [random, graded] = input.fields;
  const auto place = [](const auto& sections) {
    const auto found =
        std::ranges::find(sections, VaryingProperty::youngs_modulus, &VaryingSection::property);
    return static_cast<std::size_t>(found - sections.begin());
  };
  const std::size_t k = place(graded);
  return k < graded.size() ? item_key("graded", k) : item_key("random", place(random));
}

}  // namespace

std::vector<PropertyField> property_fields(const CaseFile& input, const Particles& particles,
                                           std::vector<std::string>& notes) {
  std::vector<PropertyField> fields;
  for (const RandomSection& random : input.fields.random) {
    if (!is_used(input, random)) continue;
    fields.push_back({random.property, random.field, materials_that_vary(input, random)});
  }
  for (std::size_t k = 0; k < input.fields.graded.size(); ++k) {
    const GradedSection& graded = input.fields.graded[k];
    if (!is_used(input, graded)) continue;
    fields.push_back({graded.property, {}, materials_that_vary(input, graded)});
    if (!graded.file) {
      fields.back().factor =
          positive_formula(input, item_key("graded", k, "factor"), graded.factor);
      continue;
    }
    const std::shared_ptr<const PointField> field = read_field_file(input, k);
    notes.push_back(field_file_note(input, k, *field, particles));
    fields.back().factor = [field](std::span<const double> position) {
      return field->at(position);
    };
  }
  return fields;
}

std::vector<double> modulus_of_particles(const CaseFile& input,
                                         std::span<const PropertyField> fields,
                                         const Network& network) {
  if (fields.empty()) return {};
  const Particles& places = network.places();
  std::vector<Index> solid;
  for (Index i = 0; i < places.size(); ++i) {
    if (places.kind[i] == ParticleKind::solid) solid.push_back(i);
  }
  const std::vector<double> factors =
      modulus_between(fields, places.positions, places.dim, solid, solid);
  if (factors.empty()) return {};
  std::vector<double> modulus(static_cast<std::size_t>(network.particles.size()), 1.0);
  double softest = infinity, stiffest = 0.0;
  for (std::size_t k = 0; k < solid.size(); ++k) {
    modulus[solid[k]] = factors[k];
    const double own = factors[k] * input.materials[places.material[solid[k]]].youngs_modulus;
    softest = std::min(softest, own);
    stiffest = std::max(stiffest, own);
  }
  if (stiffest <= largest_stiffness_ratio * softest) return modulus;
  throw InputError(
      input.where(table_of_modulus(input)),
      fmt::format("makes Young's modulus {:.6g} to {:.6g}: double precision cannot resolve both",
                  softest, stiffest),
      fmt::format("at most {:.0e} times is possible; a ratio of a thousand is nearly rigid",
                  largest_stiffness_ratio));
}

}  // namespace perilink
