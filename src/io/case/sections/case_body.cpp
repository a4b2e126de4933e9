// [body] and [[materials]]: the solid itself.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {
namespace {

void check_pattern(const CaseTable& table, const BodySection& body) {
  const bool flat = is_flat(body.pattern);
  if (has_cells(body) || flat == (dimension_of(body) == 2)) return;
  table.refuse("pattern",
               fmt::format("is \"{}\", a {}-dimensional pattern, but problem is \"{}\"",
                           word_of(body.pattern), flat ? "two" : "three", word_of(body.problem)),
               flat ? "Allowed here: cubic, face_centred, unstructured"
                    : "Allowed here: rectangular, hexagonal, unstructured");
}

/// Reads keys of bodies whose particles are the vertices of cells.
void read_cells(const CaseTable& table, BodySection& body) {
  body.pattern = Pattern::irregular;
  if (!table.has("micromodulus")) body.micromodulus = Constants::continuum;
  const auto name = [&](const char* mesh, const char* set) {
    return table.has("mesh") ? mesh : set;
  };
  if (body.surface == Surface::ghost) {
    table.refuse(
        "surface", "is \"ghost\", but the ghost layer belongs to a lattice",
        name("delete it, or fill the body with a lattice", "delete it, or choose another pattern"));
  }
  if (table.has("horizon_level")) {
    table.refuse("horizon_level",
                 name("is given, but a mesh has no levels",
                      "is given, but the pattern \"unstructured\" has no levels"),
                 "give `horizon` or `horizon_ratio`");
  }
}

void check_lattice_of_bonds(const CaseTable& table, BodySection& body) {
  check_pattern(table, body);
  if (has_cells(body)) {
    read_cells(table, body);
  } else if (table.has("seed")) {
    table.refuse(
        "seed", fmt::format("is given, but the pattern \"{}\" is a lattice", word_of(body.pattern)),
        "delete it, or set pattern = \"unstructured\"");
  }
  if (body.surface == Surface::ghost && dimension_of(body) == 3) {
    table.refuse("surface", "is \"ghost\", but the ghost layer is for two-dimensional bodies",
                 "Allowed in three dimensions: calibrated, energy, none");
  }
}

/// Refuses the constants of a lattice where there is none.
void check_constants(const CaseTable& table, const BodySection& body) {
  if (!has_cells(body)) return;
  const auto refuse_lattice = [&](const char* key, bool counts) {
    if (!counts) return;
    table.refuse(key,
                 fmt::format("is \"lattice\", but {} no lattice to count bonds on",
                             body.mesh ? "a mesh has" : "unstructured particles have"),
                 "delete it, or write \"continuum\"");
  };
  refuse_lattice("micromodulus", body.micromodulus == Constants::lattice);
  refuse_lattice("critical_stretch", body.critical_stretch == CriticalStretch::lattice);
}

void check_horizon(const CaseTable& table, const BodySection& body) {
  if (body.horizon && body.spacing && *body.horizon < *body.spacing) {
    table.refuse("horizon",
                 fmt::format("is {}, less than the spacing {}: no particle would have a neighbour",
                             *body.horizon, *body.spacing),
                 "two to four spacings are usual");
  }
  if (table.has("horizon_level") && !is_flat(body.pattern)) {
    table.refuse(
        "horizon_level",
        fmt::format("is given, but the pattern \"{}\" has no levels", word_of(body.pattern)),
        "give `horizon` or `horizon_ratio`");
  }
}

/// On a lattice, calibration replaces the micromodulus. On a mesh, calibration starts from the
/// continuum's formula.
void refuse_unused_micromodulus(const CaseTable& table, const BodySection& body) {
  if (body.surface != Surface::calibrated || has_cells(body) ||
      body.micromodulus != Constants::continuum)
    return;
  table.refuse("micromodulus", "is \"continuum\", but calibrated bonds have other stiffnesses",
               "delete it, or set surface = \"none\"");
}

void check_element_ratio(const CaseTable& table, double given) {
  if (given > -1.0 && given < 0.5) return;
  table.refuse("poissons_ratio",
               fmt::format("is {}, but an elastic solid has ratios above -1 and below 1/2", given),
               "incompressible solids are not available");
}

/// Suggests linear elements for Poisson's ratios that bonds cannot have.
std::string other_model(double given) {
  if (!(given > -1.0 && given < 0.5)) return "";
  return "; where no bond is to break, method = \"linear_elements\" in [body] with "
         "analysis.type = \"elastic\" has ratios up to 1/2";
}

/// Returns bond_poissons_ratio() as messages write it.
const char* ratio_word(Problem problem) {
  return bond_poissons_ratio(problem) > 0.3 ? "1/3" : "1/4";
}

void check_bond_based_ratio(const CaseTable& table, const BodySection& body, double given) {
  constexpr double tolerance = 1e-3;  // users write 0.333
  const double only = bond_poissons_ratio(body.problem);
  if (std::abs(given - only) <= tolerance) return;
  const char* word = ratio_word(body.problem);
  table.refuse(
      "poissons_ratio",
      fmt::format("is {}, but a bond-based solid in {} has the Poisson's ratio {}", given,
                  word_of(body.problem), word),
      given > -1.0 && given < only
          ? std::string("leave the key out, or set model = \"micropolar\" in [body], whose bonds "
                        "bend and have this ratio")
          : fmt::format("leave the key out; model = \"micropolar\" in [body] has ratios above -1 "
                        "and up to {} only{}",
                        word, other_model(given)));
}

void check_micropolar_ratio(const CaseTable& table, const BodySection& body, double given) {
  if (given > -1.0 && given <= bond_poissons_ratio(body.problem)) return;
  table.refuse("poissons_ratio",
               fmt::format("is {}, but micropolar bonds in {} have ratios above -1 and up to {}",
                           given, word_of(body.problem), ratio_word(body.problem)),
               "no bonds of this version have other ratios" + other_model(given));
}

void check_poissons_ratio(const CaseTable& table, const BodySection& body,
                          const std::optional<double>& given) {
  if (body.method == BodyMethod::linear_elements) {
    if (given) check_element_ratio(table, *given);
  } else if (body.model == BodyModel::micropolar) {
    if (is_beam(body)) return;
    if (!given) {
      table.refuse_missing("poissons_ratio", "Poisson's ratio, which micropolar bonds need");
    }
    check_micropolar_ratio(table, body, *given);
  } else if (given) {
    check_bond_based_ratio(table, body, *given);
  }
}

/// Bonds of shells and beams extend through the thickness. In bending, one side of a crack is in
/// compression while the other opens, so these bonds cannot close.
void settle_thick_softening(const CaseTable& table, SofteningMaterial& softening) {
  if (softening.shape.kind == Softening::concrete) {
    table.refuse("softening", "is \"concrete\", a law that bonds of shells and beams do not have",
                 "Allowed here: brittle, linear, bilinear, exponential");
  }
  if (table.has("closing") && softening.closes) {
    table.refuse("closing", "is true, but bonds of shells and beams break through the thickness",
                 "delete it");
  }
  softening.closes = false;
}

void read_material_regions(const CaseTable& table, std::vector<std::string>& names) {
  if (const auto single = table.text("region")) names = {*single};
  if (names.empty()) {
    table.refuse("regions", "names no region", "name at least one region, or delete the material");
  }
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    table.refuse("regions", fmt::format("names {} twice", quoted(*twice)), "name it once");
  }
}

void check_holes(const CaseTable& table, const std::vector<std::string>& holes,
                 const BodySection& body) {
  if (!table.has("holes")) return;
  if (holes.empty()) table.refuse("holes", "names no region", "name one, or delete the key");
  if (body.mesh && !is_lattice(body)) {
    table.refuse("holes", "is given, but the mesh is the body",
                 "leave the hole out of the geometry");
  }
}

}  // namespace

BodySection read_body(const CaseTable& table, BodySection body, Kinds kind) {
  if ((is_shell(body) || is_beam(body)) && !table.has("thickness")) {
    table.refuse_missing("thickness", is_beam(body) ? "the width of the beam, across the plane"
                                                    : "the thickness of the shell");
  }
  const bool flat = dimension_of(body) == 2;
  if (is_lattice(body)) {
    body.pattern = flat ? Pattern::hexagonal : Pattern::face_centred;
  } else if (!flat) {
    body.pattern = Pattern::cubic;
  }
  const Pattern usual = body.pattern;
  body = read_section("body", table, kind, body);
  read_mesh_file(table, body);
  if (has_state_based_particles(body)) body.surface = Surface::none;
  if (is_lattice(body)) {
    check_lattice_body(table, body, usual);
    return body;
  }
  table.need_one_of({"columns", "spacing", "mesh"});
  if (body.mesh) {
    if (table.has("pattern")) {
      table.refuse("pattern", "is given together with `mesh`",
                   "delete it: the mesh places the particles");
    }
    read_cells(table, body);
  } else {
    check_lattice_of_bonds(table, body);
  }
  if (is_particles(body)) return body;
  if (body.method == BodyMethod::bonds) check_horizon(table, body);
  check_constants(table, body);
  refuse_unused_micromodulus(table, body);
  if (is_shell(body) && body.surface == Surface::ghost) {
    table.refuse("surface", "is \"ghost\", but the ghost layer is for bodies in a plane",
                 "Allowed here: calibrated, energy, none");
  }
  return body;
}

MaterialSection read_material(const CaseTable& table, const CaseFile& input, std::size_t index) {
  const BodySection& body = input.body;
  MaterialSection material;
  material.name = fmt::format("material {}", index + 1);
  if (has_state_based_particles(body)) material.lattice = usual_state_material(body.variant);
  material = read_section("materials", table, kinds_of(input), std::move(material));
  if (material.name.empty()) {
    table.refuse("name", "is empty", "name the material, or delete the key");
  }
  read_material_regions(table, material.regions);
  check_holes(table, material.holes, body);
  if (material.lattice) {
    check_state_material(table, input, material);
    return material;
  }
  check_poissons_ratio(table, body, material.poissons_ratio);
  material.softening = read_softening(table);
  if (is_shell(body) || is_beam(body)) settle_thick_softening(table, material.softening);
  if (!has_stretches(material.softening))
    need_fracture_energy(table, input.analysis.type, material);
  if (std::isinf(material.fracture_energy) && table.has("fracture_energy")) refuse_softening(table);
  return material;
}

void refuse_hole_outside(const CaseFile& input, const MaterialSection& material,
                         const std::string& key, const std::string& hole) {
  const auto meets = [&](const std::string& name) {
    const Region& cut = *std::ranges::find(input.regions, hole, &Region::name);
    const Region& region = *std::ranges::find(input.regions, name, &Region::name);
    bool meet = true;
    for (int a = 0; a < dimension_of(input.body); ++a) {
      const double lower = std::max(cut.box.lower[a], region.box.lower[a]);
      const double upper = std::min(cut.box.upper[a], region.box.upper[a]);
      const bool flat = cut.box.lower[a] == cut.box.upper[a];  // a row of particles of a lattice
      meet = meet && (lower < upper || (flat && lower == upper));
    }
    return meet || !region.group.empty() || !cut.group.empty();
  };
  if (std::ranges::any_of(material.regions, meets)) return;
  throw InputError(input.where(key), fmt::format("is {}, outside of the material", quoted(hole)),
                   "move the hole, or delete it");
}

}  // namespace perilink
