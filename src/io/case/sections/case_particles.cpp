#include "io/case/sections/case_particles.hpp"

#include <fmt/format.h>

#include <string>

#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"

namespace perilink {
namespace {

void refuse_table(const CaseFile& input, const std::string& table, bool given,
                  const std::string& why, const std::string& suggestion) {
  if (!given) return;
  throw InputError(input.where(item_key(table, 0)),
                   "is given, but a body with model = \"particles\" " + why, suggestion);
}

}  // namespace

void refuse_horizon_keys(const CaseTable& table) {
  for (const char* key : {"surface", "horizon", "horizon_level", "horizon_ratio", "micromodulus",
                          "critical_stretch"}) {
    if (!table.has(key)) continue;
    table.refuse(key,
                 "is given, but particles with model = \"particles\" have their nearest "
                 "neighbours, six in the plane and eighteen in space",
                 "delete it");
  }
}

void read_particle_material(const CaseTable& table, const BodySection& body,
                            MaterialSection& material) {
  for (const char* key :
       {"boundary_factor", "internal_damping", "external_damping", "fundamental_period",
        "yield_strength", "ultimate_strength", "ultimate_plastic_strain", "crushing_energy"}) {
    if (!table.has(key)) continue;
    table.refuse(key, "is given, but only bodies with model = \"lattice\" have it",
                 std::string(key).ends_with("damping")
                     ? "delete it; analysis.damping_rate damps the motion of these particles"
                     : "delete it, or set model = \"lattice\" in [body]");
  }
  read_state_material(table, body, material);
  material.density = material.lattice->density;
}

void write_particle_material(TomlWriter& out, const MaterialSection& material) {
  write_softening(out, *material.lattice);
}

void check_particles(const CaseFile& input) {
  if (!is_particles(input.body)) return;
  const std::string& type = input.analysis.type;
  if (type == "damage" || type == "relaxation") {
    throw InputError(input.where("body.model"),
                     fmt::format("is \"particles\", but analysis.type is \"{}\"", type),
                     "set type = \"explicit\" or \"elastic\" in [analysis], or take another model");
  }
  const std::string other = "delete it, or take another model in [body]";
  refuse_table(input, "cracks", !input.cracks.empty(), "knows none", other);
  refuse_table(input, "rebar", !input.rebar.empty(), "knows none", other);
  refuse_table(input, "symmetry", !input.symmetry.empty(),
               "has no mirror image: particles on a plane would lack half of their neighbours",
               "take the whole body");
}

}  // namespace perilink
