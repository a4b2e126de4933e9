// Keys of [body], [[regions]] and [[materials]].

#include "io/case/keys/key_tables.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {
namespace {

using namespace shared;
using Material = MaterialSection;

constexpr std::string_view lattice_instead = "delete it, or set model = \"lattice\" in [body]";
constexpr std::string_view only_lattices =
    "is given, but only bodies with model = \"lattice\" have it";

const NotFor on_lattice{
    lattice,
    "is given, but particles with model = \"lattice\" have their nearest neighbours on a lattice "
    "of a given spacing",
    "delete it; `pattern`, `spacing`, `rotation` and `offset` say where they are"};

/// Keys of bonds within a horizon.
const Without horizons = {
    {elements, no_bonds, bonds_instead},
    on_lattice,
    {particles,
     "is given, but particles with model = \"particles\" have their nearest neighbours, six in the "
     "plane and eighteen in space",
     delete_it},
};
/// Keys of bonds within a horizon that beams do not have.
const Without neighbourhoods = [] {
  Without keys = horizons;
  keys.push_back(of_beams);
  return keys;
}();
constexpr std::string_view no_torsion =
    "delete it; three-dimensional bodies with model = \"micropolar\" have it";
const Without torsion = {
    {shell, "is given, but torsion of bonds of a shell follows from its Poisson's ratio",
     delete_it},
    {elements, no_bonds, bonds_instead},
    on_lattice,
    {micropolar | plane, "is given, but bonds of a two-dimensional body do not twist", no_torsion},
    {bond_based | particles, "is given, but bonds of a bond-based solid do not twist", no_torsion},
};
const Without lattices = {{bonds | particles | elements, "is given, but model is \"{model}\"",
                           "delete it, or set model = \"lattice\""}};

/// Methods and models that a kind of body excludes.
const Without methods = {
    {elements | shell | beam, "is \"linear_elements\", but shells and beams are made of bonds",
     "delete the line, or choose another problem"},
    {elements | damage | relaxation, "is \"linear_elements\", which cannot break",
     "set analysis.type = \"elastic\", or delete the line"}};
constexpr std::string_view other_type =
    "set type = \"explicit\" or \"elastic\" in [analysis], or choose another model";
const Without models = {
    {elements, no_bonds, bonds_instead},
    {bond_based | lattice | particles | shell | beam,
     "is \"{model}\", but the bonds of shells and beams bend: model = \"micropolar\"",
     "delete the line, or choose another problem"},
    {lattice | particles | damage | relaxation, "is \"{model}\", but analysis.type is \"{type}\"",
     other_type},
};
const Without thick = {{space, "is given, but a three-dimensional body has none",
                        "delete it; the regions' z intervals say how thick the body is"}};
const Without shells = {{plane | space, "is given, but only shells lie on cylinders",
                         "delete it, or set problem = \"shell\""}};
const Without outside_of_mid_surfaces = {
    {plane, "is an axis that a two-dimensional body does not have",
     "delete it, or set problem = \"three_dimensional\" in [body]"},
    {shell, "is given, but positions in a shell have two coordinates, x and y", delete_it}};

const Without softening = {{elements, no_bonds, bonds_instead}};
const Without bond_softening = {
    {elements, no_bonds, bonds_instead},
    {states, "is given, but state-based particles do not have it",
     "delete it; `critical_opening` and the knee give the law of these particles"}};
const Without crack_opening = {
    {bonds | elements,
     "is given, but only bodies with model = \"lattice\" or \"particles\" have it",
     "delete it (bonds break by fracture_energy, tensile_strength and softening), or set another "
     "model in [body]"}};
const Without lattice_material = {{bonds | elements | particles, only_lattices, lattice_instead}};
const Without material_damping = {
    {particles, only_lattices,
     "delete it; analysis.damping_rate damps the motion of these particles"},
    {bonds | elements, only_lattices, lattice_instead}};

/// Returns a key of the law of state-based particles.
template <class T>
KeySchema state_key(const char* name, T LatticeMaterialSection::*member, const Values& values,
                    const Without& without) {
  return key<Material>(
      name, [member](Material& material) -> T& { return (*material.lattice).*member; }, values,
      without);
}
/// Returns a key of state-based particles that break.
template <class T>
KeySchema damage_key(const char* name, T LatticeMaterialSection::*member, const Values& values,
                     const Without& without) {
  return state_key(name, member, values, without).written_if(+[](const Material& material) {
    return material.lattice->tensile_strength.has_value();
  });
}
/// Returns a key of state-based particles that flow.
template <class T>
KeySchema flow_key(const char* name, T LatticeMaterialSection::*member,
                   const Values& values = positive) {
  return state_key(name, member, values, lattice_material).beside("yield_strength");
}

void write_law(TomlWriter& out, const Material& material, Kinds) {
  if (material.lattice) return write_state_law(out, *material.lattice);
  write_softening(out, material.softening);
}

}  // namespace

TableSchema top_table() {
  return {"",
          false,
          {key("title", &CaseFile::title).written_empty(),
           key("units", &CaseFile::units).written_empty()}};
}

TableSchema body_table() {
  using Body = BodySection;
  return {"body",
          false,
          joined_keys(
              {{key("problem", &Body::problem), key("method", &Body::method, {}, methods),
                key("model", &Body::model, {}, models),
                key("torsion", &Body::torsion, positive, torsion),
                key("thickness", &Body::thickness, positive, thick).derived(),
                key("radius", &Body::radius, positive, shells)},
               mesh_keys<Body>(),
               {key("pattern", &Body::pattern, {}, in_beams)
                    .derived()
                    .written_if(+[](const Body& body) { return !body.mesh || is_lattice(body); }),
                key("seed", &Body::seed, from(0, largest), {of_beams, on_lattice})
                    .instead_of("mesh")
                    .written_if(+[](const Body& body) { return !body.mesh && has_cells(body); }),
                key("surface", &Body::surface, {}, neighbourhoods),
                key("columns", &Body::columns, from(2, 100000), {on_lattice}),
                key("spacing", &Body::spacing, positive),
                key("horizon", &Body::horizon, positive, horizons),
                key("horizon_level", &Body::horizon_level, from(0, 8), neighbourhoods),
                key("horizon_ratio", &Body::horizon_ratio, Range{1.0}, horizons)
                    .hinted("2 to 4 is usual: below 1 no particle would have a neighbour"),
                key("micromodulus", &Body::micromodulus, {}, neighbourhoods).derived(),
                key("critical_stretch", &Body::critical_stretch, {}, neighbourhoods),
                key("rotation", &Body::rotation, from(-360, 360), lattices),
                key("offset", &Body::offset, Kind::position, lattices).derived(),
                key("variant", &Body::variant, {}, lattices)}}),
          {},
          {{"horizon", "horizon_level", "horizon_ratio"}}};
}

TableSchema region_table() {
  const Values interval = Values(Kind::number).as_list();
  return {"regions",
          true,
          {{"name", Kind::text},
           {"group", Kind::text},
           {"x", interval},
           {"y", interval},
           {"z", interval, outside_of_mid_surfaces},
           {"center", interval},
           {"radius", {Kind::number, positive}}}};
}

TableSchema material_table() {
  using State = LatticeMaterialSection;
  const auto factor = [](const char* name) {
    return KeySchema(name, {Kind::number, Range{1.0, 1e10, true}}, bond_softening)
        .hinted(
            "the force is constant up to there; 2 in tension and 3 in compression are the "
            "values of the paper");
  };
  return {
      "materials",
      true,
      joined_keys(
          {{key("name", &Material::name),
            {"region", Kind::text},
            key("regions", &Material::regions),
            key("holes", &Material::holes, {}, in_beams),
            key("youngs_modulus", &Material::youngs_modulus, positive).needed("Young's modulus"),
            key("poissons_ratio", &Material::poissons_ratio, {}, in_beams),
            key("fracture_energy", &Material::fracture_energy, {Kind::energy, positive})
                .written_if(
                    +[](const Material& material) { return material.fracture_energy > 0.0; }),
            key("density", &Material::density, positive),
            KeySchema("tensile_strength", positive_number, softening).written_by(write_law),
            {"softening", binding::values_of<Softening>({}), bond_softening}},
           softening_keys(bond_softening, softening),
           {{"tension_limit", positive_number, bond_softening},
            factor("tension_factor"),
            {"compression_limit", positive_number, bond_softening},
            factor("compression_factor"),
            {"shear_softening", Kind::boolean, bond_softening},
            {"critical_opening", positive_number, crack_opening},
            damage_key("compression_ratio", &State::compression_ratio, positive, crack_opening),
            damage_key("compression_threshold", &State::compression_threshold, fraction,
                       crack_opening)
                .derived(),
            damage_key("boundary_factor", &State::boundary_factor, positive, lattice_material)
                .derived(),
            state_key("yield_strength", &State::yield_strength, positive, lattice_material),
            flow_key("ultimate_strength", &State::ultimate_strength)
                .needed("the yield stress where hardening ends; equal to `yield_strength` without "
                        "hardening"),
            flow_key("ultimate_plastic_strain", &State::ultimate_plastic_strain)
                .needed("the plastic strain at the ultimate strength"),
            flow_key("crushing_energy", &State::crushing_energy, {Kind::energy, positive}),
            state_key("internal_damping", &State::internal_damping, not_negative, material_damping),
            state_key("external_damping", &State::external_damping, not_negative, material_damping),
            state_key("fundamental_period", &State::fundamental_period, positive,
                      lattice_material)}}),
      {},
      {{"region", "regions"}}};
}

}  // namespace perilink
