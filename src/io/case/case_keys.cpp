#include "io/case/case_keys.hpp"

#include <algorithm>

namespace perilink {
namespace {

using namespace kinds;
using Without = std::vector<NotFor>;

constexpr std::string_view delete_it = "delete it";
constexpr std::string_view no_bonds = "is given, but linear elements have no bonds";
constexpr std::string_view bonds_instead = "delete it, or the line method = \"linear_elements\"";
constexpr std::string_view another_model = "delete it, or choose another model in [body]";
constexpr std::string_view lattice_instead = "delete it, or set model = \"lattice\" in [body]";
constexpr std::string_view whole_body = "model the whole body";
constexpr std::string_view no_such_table =
    "is given, but a body with model = \"{model}\" cannot have it";
constexpr std::string_view only_lattices =
    "is given, but only bodies with model = \"lattice\" have it";

constexpr std::string_view flat_instead = "delete it, or choose another problem in [body]";
constexpr std::string_view damage_instead = "delete it, or set type = \"damage\" in [analysis]";

constexpr Kinds bonds = bond_based | micropolar;
constexpr Kinds still = damage | elastic | relaxation;

const NotFor on_lattice{
    lattice,
    "is given, but particles with model = \"lattice\" have their nearest neighbours on a lattice "
    "of a given spacing",
    "delete it; `pattern`, `spacing`, `rotation` and `offset` say where they are"};

/// Keys without a meaning for beams.
const NotFor of_beams{
    beam, "is given, but a beam is a row of particles whose bonds share its section", delete_it};
constexpr std::string_view no_beam = "is given, but beams have none";
const Without in_beams = {of_beams};

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

/// Methods, models and types of analysis that a kind of body excludes.
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
const Without types = {
    {elements | explicit_, "is \"explicit\", but linear elements have no masses",
     "set method = \"bonds\" in [body], or type = \"elastic\""},
    {shell | beam | explicit_ | relaxation,
     "is \"{type}\", but shells and beams have no masses: they need a quasistatic analysis",
     "set type = \"elastic\" or \"damage\""}};

const Without softening = {{elements, no_bonds, bonds_instead}};
const Without bond_softening = {
    {elements, no_bonds, bonds_instead},
    {lattice | particles, "is given, but state-based particles do not have it",
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

const Without third_axis = {{plane, "is an axis that a two-dimensional body does not have",
                             "delete it, or set problem = \"three_dimensional\" in [body]"}};
constexpr Kinds unturned = bond_based | lattice | particles | elements;
const NotFor resting{unturned, "is given, but {resting}", "delete it, or {turning}"};
const Without turn_in_plane = {
    resting,
    {space | shell, "is no rotation of a body in three dimensions", "Allowed: rx, ry, rz"}};
const Without turn_in_space = {
    resting, {plane, "is no rotation of a body in two dimensions", "Allowed: rotation"}};
const Without moments = {
    {unturned, "is given, but {resting}", "apply a couple of forces, or {turning}"}};
std::vector<KeySchema> motions(bool in_stages) {
  std::vector<KeySchema> keys = {"region",
                                 "x",
                                 "y",
                                 {"z", third_axis},
                                 {"rotation", turn_in_plane},
                                 {"rx", turn_in_space},
                                 {"ry", turn_in_space},
                                 {"rz", turn_in_space}};
  if (in_stages) keys.emplace_back("stage");
  return keys;
}
const Without velocities = {
    {still, "is given, but analysis.type is \"{type}\", and velocities need type = \"explicit\"",
     "give [[displacements]], or set type = \"explicit\""},
    {lattice, "is given, but only bodies of bonds have prescribed velocities",
     "give [[displacements]], which follow the smooth load factor"}};

const Without tractions = {
    {beam, "is given, but a beam has no faces to act on",
     "give [[loads]] with `force` or `body_force`, or [[point_loads]]"},
    {lattice, "is given, but a body with model = \"lattice\" has no facets on its surface",
     "give a total over a region, [[loads]] with `force`"}};
const Without symmetry = {
    {particles,
     "is given, but a body with model = \"particles\" has no mirror image: particles on a plane "
     "would lack half of their neighbours",
     whole_body},
    {lattice,
     "is given, but a body with model = \"lattice\" has no mirror image: particles on a plane "
     "would lack half of their bonds",
     whole_body}};
const Without springs = {
    {lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[springs]], which need bonds",
     "delete one of the two", "body.method"}};
const Without spring_stiffness = {
    {beam, "is given per area, but a beam has no faces", "give `total`"}};
const Without outside_of_mid_surfaces = {
    {plane, "is an axis that a two-dimensional body does not have",
     "delete it, or set problem = \"three_dimensional\" in [body]"},
    {shell, "is given, but positions in a shell have two coordinates, x and y", delete_it}};
const Without cracks = {
    {beam, no_beam, flat_instead},
    {particles | lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[cracks]], which cut bonds",
     "delete one of the two, or leave the crack out of the mesh", "body.method"}};
const Without interfaces = {
    {beam, no_beam, flat_instead},
    {shell, "is given, but shells cannot have interfaces", flat_instead},
    {particles | lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[interfaces]], which need bonds",
     "delete one of the two", "body.method"},
    {elastic, {}, {}}};
const Without random_tables = {{particles | lattice, no_such_table, another_model},
                               {elements, no_bonds, bonds_instead},
                               {elastic, {}, {}}};
const Without rebar = {
    {beam, no_beam, flat_instead},
    {shell, "is given, but shells cannot have rebar", flat_instead},
    {particles | lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[rebar]], which needs bonds",
     "delete one of the two", "body.method"}};

const Without hosts = {
    {shell, "is given, but elements cannot constrain particles of shells", flat_instead},
    {particles | lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [elements], which constrain particles",
     "delete one of the two", "body.method"},
    {explicit_ | relaxation, {}, {}}};

/// Returns the exceptions of a key that these analyses do not use.
Without set_aside(Kinds analyses) { return {{analyses, {}, {}}}; }

const Without of_events = set_aside(explicit_ | relaxation);
const Without of_damage = set_aside(elastic | explicit_ | relaxation);
const Without of_relaxation = set_aside(damage | elastic | explicit_);
const Without of_time = set_aside(still);
const NotFor no_lattice_key{lattice | explicit_, "is given, but lattice particles do not have it",
                            "delete it; [[materials]] set the damping of lattices"};
const Without of_bonds_in_time = {{still, {}, {}}, no_lattice_key};
const Without strains = {
    {damage | elastic, {}, {}},
    {lattice, "is given, but lattice particles always use true lengths", delete_it}};

const Without stages = {
    {shell | beam, "is given, but all loads of shells and beams grow together", delete_it},
    {elastic | explicit_ | relaxation,
     "is given, but type = \"{type}\" makes all loads grow together", damage_instead}};

const Without release_strains = {
    {elastic, {}, {}},
    {beam, "is given, but the mean strain of a bent beam leaves out the strain at its faces",
     "give `alert`"}};

const std::vector<KeySchema> body_keys = {
    "problem",
    {"method", methods},
    {"model", models},
    {"torsion", torsion},
    {"thickness",
     {{space, "is given, but a three-dimensional body has none",
       "delete it; the regions' z intervals say how thick the body is"}}},
    {"radius",
     {{plane | space, "is given, but only shells lie on cylinders",
       "delete it, or set problem = \"shell\""}}},
    {"mesh", in_beams},
    {"mesh_size", in_beams},
    {"mesh_scale", in_beams},
    {"pattern", in_beams},
    {"seed", {of_beams, on_lattice}},
    {"surface", neighbourhoods},
    {"columns", {on_lattice}},
    "spacing",
    {"horizon", horizons},
    {"horizon_level", neighbourhoods},
    {"horizon_ratio", horizons},
    {"micromodulus", neighbourhoods},
    {"critical_stretch", neighbourhoods},
    {"rotation", lattices},
    {"offset", lattices},
    {"variant", lattices}};

const std::vector<KeySchema> material_keys = {"name",
                                              "region",
                                              "regions",
                                              {"holes", in_beams},
                                              "youngs_modulus",
                                              {"poissons_ratio", in_beams},
                                              "fracture_energy",
                                              "density",
                                              {"tensile_strength", softening},
                                              {"softening", bond_softening},
                                              {"softening_error", bond_softening},
                                              {"softening_points", bond_softening},
                                              {"softening_stretches", bond_softening},
                                              {"closing", bond_softening},
                                              {"tension_limit", bond_softening},
                                              {"tension_factor", bond_softening},
                                              {"compression_limit", bond_softening},
                                              {"compression_factor", bond_softening},
                                              {"shear_softening", bond_softening},
                                              {"critical_opening", crack_opening},
                                              {"knee_stress_ratio", softening},
                                              {"knee_opening_ratio", softening},
                                              {"compression_ratio", crack_opening},
                                              {"compression_threshold", crack_opening},
                                              {"boundary_factor", lattice_material},
                                              {"yield_strength", lattice_material},
                                              {"ultimate_strength", lattice_material},
                                              {"ultimate_plastic_strain", lattice_material},
                                              {"crushing_energy", lattice_material},
                                              {"internal_damping", material_damping},
                                              {"external_damping", material_damping},
                                              {"fundamental_period", lattice_material}};

const std::vector<KeySchema> analysis_keys = {{"type", types},
                                              {"control", of_damage},
                                              {"load_factors", set_aside(elastic | explicit_)},
                                              {"rigid_body_modes", {no_lattice_key}},
                                              {"factor", of_damage},
                                              {"solver", of_events},
                                              {"coarse_box", of_events},
                                              {"event_tolerance", of_damage},
                                              {"duration", of_time},
                                              {"ramp_time", of_time},
                                              {"time_step", of_time},
                                              {"safety", of_time},
                                              {"rows", of_time},
                                              {"damping_rate", of_bonds_in_time},
                                              {"masses", of_bonds_in_time},
                                              {"strain", strains},
                                              {"tolerance", set_aside(damage | explicit_)},
                                              {"iterations", of_relaxation}};

/// Keys without exceptions, separated by spaces, and others.
std::vector<KeySchema> plain(std::string_view words, const std::vector<KeySchema>& others = {}) {
  std::vector<KeySchema> keys;
  while (!words.empty()) {
    const std::size_t length = std::min(words.find(' '), words.size());
    keys.emplace_back("").name = words.substr(0, length);
    words.remove_prefix(std::min(length + 1, words.size()));
  }
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

const std::vector<KeySchema> rebar_keys = plain(
    "from to points inside group along cover face number spacing copies steps across_gaps "
    "youngs_modulus area yield_strength yields stress_strain hardening_modulus rupture_strain "
    "bond bond_stiffness bond_strength bond_curve concrete_strength rib_spacing bond_failure "
    "bond_conditions megapascal millimetre ties_break perimeter hooks bends prestrain stage");
const std::vector<KeySchema> stage_keys =
    plain("name loads to to_load broken_bonds load_fraction displacement gauge above below");
const std::vector<KeySchema> stop_keys =
    plain("gauge above below",
          {{"broken_bonds", of_events}, {"load_fraction", of_events}, {"displacement", of_events}});
const std::vector<KeySchema> gauge_keys =
    plain("name between at region reaction about axis",
          {{"stress",
            {{shell | beam, "is given, but stresses of shells and beams are not computed",
              "give `axis`"}}}});
const std::vector<KeySchema> random_keys =
    plain("property materials distribution variation correlation_length seed");
constexpr const char* a_line = "give the `points` of a line: [[0, 1], [2, 1]]";
const std::vector<KeySchema> crack_keys = {
    {"points", {{space, "is given, but the body has 3 dimensions", "give `corners` of a polygon"}}},
    {"corners",
     {{plane, "is given, but the body has 2 dimensions", a_line},
      {shell, "is given, but cracks of a shell are lines on its mid-surface", a_line}}},
    "group",
    {"closing", {{shell, "is given, but cracks of a shell do not close", delete_it}}}};
const std::vector<KeySchema> interface_keys = {
    "between",           crack_keys[0],         crack_keys[1], crack_keys[2],
    "fracture_energy",   "tensile_strength",    "softening",   "softening_error",
    "softening_points",  "softening_stretches", "closing",     "knee_stress_ratio",
    "knee_opening_ratio"};

}  // namespace

const std::vector<TableSchema>& case_schema() {
  static const std::vector<TableSchema> schema = {
      {"", false, {"title", "units"}},
      {"body", false, body_keys},
      {"regions",
       true,
       {"name", "group", "x", "y", {"z", outside_of_mid_surfaces}, "center", "radius"}},
      {"materials", true, material_keys},
      {"supports", true, {"region", "fix"}},
      {"displacements", true, motions(true)},
      {"velocities", true, motions(false), velocities},
      {"loads", true, {"region", "force", "body_force", "stage"}},
      {"tractions", true, {"region", "traction", "pressure", "stage"}, tractions},
      {"point_loads", true, {"at", "force", {"moment", moments}, "stage"}},
      {"symmetry", true, {"axis", "at", "region"}, symmetry},
      {"springs", true, {"region", {"stiffness", spring_stiffness}, "total"}, springs},
      {"cracks", true, crack_keys, cracks},
      {"interfaces", true, interface_keys, interfaces},
      {"random", true, random_keys, random_tables},
      {"rebar", true, rebar_keys, rebar},
      {"elements",
       false,
       {"spacings",
        "size",
        {"mesh", in_beams},
        {"mesh_size", in_beams},
        {"mesh_scale", in_beams},
        "order",
        "regions",
        "particles",
        {"glued", in_beams},
        {"alert", set_aside(elastic)},
        {"alert_strain", release_strains},
        {"halo", set_aside(elastic)}},
       hosts},
      {"gauges", true, gauge_keys},
      {"analysis", false, analysis_keys},
      {"stop", false, stop_keys, set_aside(elastic)},
      {"stages", true, stage_keys, stages},
      {"output",
       false,
       {{"fields_at", of_damage},
        {"fields_every", of_damage},
        {"fields_every_rows", of_damage},
        {"fields_at_peak", of_damage},
        {"fields_times", of_time},
        {"checkpoint_every", set_aside(elastic)}}},
  };
  return schema;
}

std::vector<std::string_view> keys_of_bonds() {
  std::vector<std::string_view> keys;
  for (const KeySchema& key : body_keys) {
    if (!key.not_for.empty() && key.not_for.front().fault == no_bonds) keys.push_back(key.name);
  }
  return keys;
}

}  // namespace perilink
