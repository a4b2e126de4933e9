#include "io/case/sections/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/case/case_schema.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_bond_dynamics.hpp"
#include "io/case/sections/case_elements.hpp"
#include "io/case/sections/case_gauges.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"
#include "io/case/sections/case_rebar.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/case/sections/laws/case_interfaces.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Returns the names of all regions, and refuses names that occur twice.
std::set<std::string> check_region_names(const CaseFile& input) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < input.regions.size(); ++i) {
    const std::string& name = input.regions[i].name;
    if (name == surface_region || name == body_region) {
      throw InputError(input.where(item_key("regions", i, "name")),
                       fmt::format("is {}, a name that stands for {} in every case", quoted(name),
                                   name == body_region ? "the whole body" : "its whole surface"),
                       "choose another name");
    }
    const auto [at, is_new] = first.emplace(name, i);
    if (is_new) continue;
    const int line = input.where(item_key("regions", at->second, "name")).line;
    throw InputError(input.where(item_key("regions", i, "name")),
                     fmt::format("is {}, the name of another region{}", quoted(name),
                                 line > 0 ? fmt::format(" at line {}", line) : ""),
                     "give every region a different name");
  }
  std::set<std::string> names;
  for (const auto& [name, index] : first) names.insert(name);
  return names;
}

void check_stiffness_ratio(const CaseFile& input) {
  const auto softer = [](const MaterialSection& a, const MaterialSection& b) {
    return a.youngs_modulus < b.youngs_modulus;
  };
  const auto [soft, stiff] =
      std::minmax_element(input.materials.begin(), input.materials.end(), softer);
  const double ratio = stiff->youngs_modulus / soft->youngs_modulus;
  if (ratio <= largest_stiffness_ratio) return;
  const auto m = static_cast<std::size_t>(stiff - input.materials.begin());
  throw InputError(
      input.where(item_key("materials", m, "youngs_modulus")),
      fmt::format(
          "is {:.6g}, {:.2g} times that of {}, {:.6g}: double precision cannot resolve both",
          stiff->youngs_modulus, ratio, quoted(soft->name), soft->youngs_modulus),
      fmt::format("at most {:.0e} times is possible; a ratio of a thousand is nearly rigid",
                  largest_stiffness_ratio));
}

/// Bonds between two materials use the mean of both laws, so both must have the same kind of law.
void check_stretches(const CaseFile& input) {
  const auto given = [](const MaterialSection& material) {
    return has_stretches(material.softening);
  };
  const auto without = [&](const MaterialSection& material) {
    return !given(material) && !std::isinf(material.fracture_energy);
  };
  const auto with = std::find_if(input.materials.begin(), input.materials.end(), given);
  const auto other = std::find_if(input.materials.begin(), input.materials.end(), without);
  if (with == input.materials.end() || other == input.materials.end()) return;
  const auto m = static_cast<std::size_t>(with - input.materials.begin());
  throw InputError(input.where(item_key("materials", m, "softening_stretches")),
                   fmt::format("is given, but {} breaks by its fracture_energy: bonds between the "
                               "two have no law",
                               quoted(other->name)),
                   "give softening_stretches to every material that can break, or to none");
}

/// Only damage analyses of micropolar bodies support the law of concrete with its compressive
/// branch.
void check_concrete(const CaseFile& input) {
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    if (input.materials[m].softening.shape.kind != Softening::concrete) continue;
    const SourceLocation where = input.where(item_key("materials", m, "softening"));
    if (input.body.model != BodyModel::micropolar) {
      throw InputError(where, "is \"concrete\", a law of micropolar bonds",
                       "set model = \"micropolar\" in [body], or choose another softening");
    }
    const AnalysisType type = input.analysis.type;
    if (type != AnalysisType::damage && type != AnalysisType::elastic) {
      throw InputError(where, "is \"concrete\", which bonds that move in time do not have",
                       "set type = \"damage\" in [analysis], or choose another softening");
    }
    if (!input.stages.empty()) {
      throw InputError(where, "is \"concrete\", a law that [[stages]] cannot have",
                       "delete the [[stages]], or choose another softening");
    }
    for (const MaterialSection& other : input.materials) {
      if (other.softening.shape.kind == Softening::concrete) continue;
      if (std::isinf(other.fracture_energy)) continue;
      throw InputError(where,
                       fmt::format("is \"concrete\", but {} breaks by another law: bonds between "
                                   "the two have none",
                                   quoted(other.name)),
                       "give all materials that can break this softening, or none");
    }
  }
}

/// Predefined regions are allowed in supports and loads, not in materials.
enum class Reserved { allowed, refused };

void check_reference(const CaseFile& input, const std::set<std::string>& names,
                     const std::string& key, const std::string& region, Reserved reserved) {
  if (names.count(region) > 0) return;
  if (reserved == Reserved::allowed) {
    if (region == body_region) return;
    if (region == surface_region) {
      if (input.body.surface != Surface::ghost) return;
      throw InputError(input.where(key),
                       "is \"surface\", but a body with surface = \"ghost\" has no particles on it",
                       "name a region of the case, or set surface = \"none\" in [body]");
    }
  }
  std::vector<std::string_view> allowed;
  for (const Region& known : input.regions) allowed.push_back(known.name);
  if (reserved == Reserved::allowed) allowed.insert(allowed.end(), {surface_region, body_region});
  throw InputError(input.where(key),
                   fmt::format("is {}, but no [[regions]] has that name", quoted(region)),
                   suggest(region, allowed));
}

void check_groups(const CaseFile& input) {
  if (input.body.mesh) return;
  for (const auto& [key, name] : named_groups(input)) {
    throw InputError(
        input.where(key),
        fmt::format("is {}, a physical group of a mesh, but the body has no mesh", quoted(name)),
        fmt::format("give `mesh` in [body]{}, or the place by coordinates here",
                    is_lattice(input.body) ? "" : " instead of `spacing` or `columns`"));
  }
}

template <class Section>
void check_references(const CaseFile& input, const std::set<std::string>& names,
                      const std::string& table, const std::vector<Section>& sections) {
  for (std::size_t i = 0; i < sections.size(); ++i) {
    check_reference(input, names, item_key(table, i, "region"), sections[i].region,
                    Reserved::allowed);
  }
}

void check_between(const CaseFile& input, const std::set<std::string>& names) {
  for (std::size_t i = 0; i < input.interfaces.size(); ++i) {
    for (const std::string& region : input.interfaces[i].between) {
      check_reference(input, names, item_key("interfaces", i, "between"), region,
                      Reserved::refused);
    }
  }
}

/// Refuses regions without volume, and round regions of bodies of bonds, whose lattices fit boxes
/// only.
void check_shape(const CaseFile& input, const std::string& key, const std::string& name) {
  for (const Region& region : input.regions) {
    if (region.name != name || !region.group.empty()) continue;
    if (region.round && !is_lattice(input.body) && !has_cells(input.body)) {
      throw InputError(
          input.where(key),
          fmt::format("is {}, which is round, but a lattice of bonds fills boxes", quoted(name)),
          "set pattern = \"unstructured\" in [body], or give the shape as a `mesh` there; round "
          "regions of this body are for supports, displacements and loads");
    }
    for (int axis = 0; axis < dimension_of(input.body); ++axis) {
      if (region.box.lower[axis] < region.box.upper[axis]) continue;
      throw InputError(
          input.where(key),
          fmt::format("is {}, which has no extent along {}", quoted(name), "xyz"[axis]),
          "regions of materials need a lower end less than the upper one; lines and points are for "
          "supports, displacements and loads");
    }
  }
}

/// Refuses two materials of one region: the first would have no effect. Different regions may
/// overlap (a weak patch within a body).
void check_materials(const CaseFile& input, const std::set<std::string>& names) {
  std::map<std::string, std::size_t> owner;
  for (std::size_t i = 0; i < input.materials.size(); ++i) {
    const std::string list = item_key("materials", i, "regions");
    const std::string key =
        input.source.lines.count(list) > 0 ? list : item_key("materials", i, "region");
    for (const std::string& region : input.materials[i].regions) {
      check_reference(input, names, key, region, Reserved::refused);
      check_shape(input, key, region);
      const auto [at, is_new] = owner.emplace(region, i);
      if (is_new) continue;
      throw InputError(input.where(key),
                       fmt::format("is {}, which has a material already: {}", quoted(region),
                                   quoted(input.materials[at->second].name)),
                       "give every region one material at most; a patch of another material is a "
                       "region of its own, and the later material counts");
    }
    for (const std::string& hole : input.materials[i].holes) {
      const std::string where = item_key("materials", i, "holes");
      check_reference(input, names, where, hole, Reserved::refused);
      if (!is_lattice(input.body)) check_shape(input, where, hole);
      refuse_hole_outside(input, input.materials[i], where, hole);
      if (owner.count(hole) == 0) continue;
      throw InputError(input.where(where),
                       fmt::format("is {}, a region of the material", quoted(hole)),
                       "a region is filled or cut out; delete one of the two");
    }
  }
}

std::string shown(const Expression& value) {
  return value.is_constant() ? fmt::format("{}", value.number) : quoted(value.formula);
}

using Held = std::set<std::pair<std::string, int>>;

void check_prescribed_once(const CaseFile& input, const Held& held, const std::string& table,
                           const std::vector<DisplacementSection>& sections) {
  std::map<std::pair<std::string, int>, Expression> prescribed;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const DisplacementSection& section = sections[i];
    for (int axis = 0; axis < 6; ++axis) {
      if (!section.value[axis]) continue;
      const Expression& value = *section.value[axis];
      const std::string name = motion_name(axes_of(input.body), axis);
      const SourceLocation where = input.where(item_key(table, i, name));
      if (!value.is_zero() && held.count({section.region, axis}) > 0) {
        throw InputError(where,
                         fmt::format("moves region {} by {}, but [[supports]] hold it in {}",
                                     quoted(section.region), shown(value), name),
                         "delete one of the two");
      }
      const auto [at, is_new] = prescribed.emplace(std::pair(section.region, axis), value);
      if (!is_new && !(at->second == value)) {
        throw InputError(where,
                         fmt::format("moves region {} by {}, but another table moves it by {}",
                                     quoted(section.region), shown(value), shown(at->second)),
                         "delete one of the two");
      }
    }
  }
}

/// Refuses displacements that are prescribed twice, or both prescribed and clamped.
void check_contradictions(const CaseFile& input) {
  Held held;
  for (const SupportSection& support : input.supports) {
    for (int axis = 0; axis < 6; ++axis) {
      if (support.fix[axis]) held.emplace(support.region, axis);
    }
  }
  check_prescribed_once(input, held, "displacements", input.displacements);
  check_prescribed_once(input, held, "velocities", input.velocities);
}

void check_loaded(const CaseFile& input) {
  bool loaded = !input.loads.empty() || !input.tractions.empty() || !input.point_loads.empty();
  for (const auto* sections : {&input.displacements, &input.velocities}) {
    for (const DisplacementSection& section : *sections) {
      for (const auto& value : section.value) loaded = loaded || (value && !value->is_zero());
    }
  }
  for (const RebarSection& bar : input.rebar) loaded = loaded || bar.prestrain != 0.0;
  if (loaded) return;
  throw InputError(
      input.where("loads"), "the case has no load",
      "add [[loads]], [[tractions]], [[point_loads]], or [[displacements]] that are not zero");
}

void refuse_on_ghosts(const CaseFile& input, const std::string& key) {
  if (input.body.surface != Surface::ghost) return;
  throw InputError(input.where(key),
                   "acts on particles of the surface, but with surface = \"ghost\" particles are "
                   "in the middle of their cells",
                   "share a total over a region ([[loads]].force, [[springs]].total), or set "
                   "surface = \"none\" in [body]");
}

/// Round-off makes conjugate gradients fail in a beam that is nearly cut through.
void check_iterative_solver(const CaseFile& input) {
  if (input.analysis.solver != LinearSolver::iterative) return;
  if (is_beam(input.body) && input.analysis.type == AnalysisType::damage) {
    throw InputError(input.where("analysis.solver"),
                     "is \"iterative\", but a beam that cracks needs the direct solver",
                     "allowed with problem = \"beam\" and type = \"damage\": \"auto\", \"direct\"");
  }
  if (const auto crack = first_closing_crack(input)) {
    throw InputError(input.where("analysis.solver"),
                     fmt::format("is \"iterative\", but the closed faces of {} need the direct "
                                 "solver",
                                 item_key("cracks", *crack)),
                     "use \"auto\" or \"direct\", or set closing = false in [[cracks]] for a "
                     "notch that stays open");
  }
  if (input.body.method != BodyMethod::linear_elements) return;
  throw InputError(input.where("analysis.solver"),
                   "is \"iterative\", but linear elements need the direct solver",
                   "allowed with method = \"linear_elements\": \"auto\", \"direct\"");
}

void check_gauge_regions(const CaseFile& input, const std::set<std::string>& names) {
  for (std::size_t i = 0; i < input.gauges.size(); ++i) {
    const GaugeSection& gauge = input.gauges[i];
    const std::pair<const char*, const std::string&> places[] = {
        {"region", gauge.region}, {"reaction", gauge.reaction}, {"cracks", gauge.cracks}};
    for (const auto& [key, region] : places) {
      if (region.empty()) continue;
      check_reference(input, names, item_key("gauges", i, key), region, Reserved::allowed);
    }
  }
}

}  // namespace

void check_rules(const CaseFile& input) {
  check_moving_bonds(input);
  check_lattice(input);
  const std::set<std::string> names = check_region_names(input);
  check_groups(input);
  check_materials(input, names);
  check_stiffness_ratio(input);
  check_concrete(input);
  check_stretches(input);
  check_references(input, names, "supports", input.supports);
  check_references(input, names, "displacements", input.displacements);
  check_references(input, names, "velocities", input.velocities);
  check_references(input, names, "loads", input.loads);
  if (!input.tractions.empty()) refuse_on_ghosts(input, "tractions[1]");
  check_references(input, names, "tractions", input.tractions);
  for (std::size_t i = 0; i < input.springs.size(); ++i) {
    if (input.springs[i].stiffness) refuse_on_ghosts(input, item_key("springs", i, "stiffness"));
  }
  check_references(input, names, "springs", input.springs);
  for (std::size_t i = 0; i < input.symmetry.size(); ++i) {
    if (input.symmetry[i].at) continue;
    check_reference(input, names, item_key("symmetry", i, "region"), input.symmetry[i].region,
                    Reserved::refused);
  }
  check_gauge_regions(input, names);
  check_gauges(input);
  for (std::size_t k = 0; k < input.rebar.size(); ++k) {
    const auto& layout = input.rebar[k].layout;
    if (layout) {
      check_reference(input, names, item_key("rebar", k, "inside"), layout->region,
                      Reserved::refused);
    }
  }
  check_rebar(input);
  check_between(input, names);
  check_interfaces(input);
  check_fields(input);
  if (input.elements) {
    for (const std::string& region : input.elements->regions) {
      check_reference(input, names, "elements.regions", region, Reserved::allowed);
    }
    for (const std::string& region : input.elements->particles) {
      check_reference(input, names, "elements.particles", region, Reserved::allowed);
    }
    for (const std::string& region : input.elements->tied) {
      check_reference(input, names, "elements.glued", region, Reserved::refused);
    }
    check_elements(input);
  }
  check_contradictions(input);
  check_iterative_solver(input);
  check_loaded(input);
}

}  // namespace perilink
