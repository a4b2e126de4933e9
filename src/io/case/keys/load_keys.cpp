// Keys of supports and loads.

#include "io/case/keys/key_tables.hpp"

namespace perilink {
namespace {

using namespace shared;

constexpr std::string_view whole_body = "model the whole body";
constexpr Kinds unturned = bond_based | lattice | particles | elements;
const NotFor resting{unturned, "is given, but {resting}", "delete it, or {turning}"};
const Without turn_in_plane = {
    resting,
    {space | shell, "is no rotation of a body in three dimensions", "Allowed: rx, ry, rz"}};
const Without turn_in_space = {
    resting, {plane, "is no rotation of a body in two dimensions", "Allowed: rotation"}};
const Without third_axis = {{plane, "is an axis that a two-dimensional body does not have",
                             "delete it, or set problem = \"three_dimensional\" in [body]"}};
const Without moments = {
    {unturned, "is given, but {resting}", "apply a couple of forces, or {turning}"}};
const Without no_velocities = {
    {still, "is given, but analysis.type is \"{type}\", and velocities need type = \"explicit\"",
     "give [[displacements]], or set type = \"explicit\""},
    {lattice, "is given, but only bodies of bonds have prescribed velocities",
     "give [[displacements]], which follow the smooth load factor"}};
const Without no_tractions = {
    {beam, "is given, but a beam has no faces to act on",
     "give [[loads]] with `force` or `body_force`, or [[point_loads]]"},
    {lattice, "is given, but a body with model = \"lattice\" has no facets on its surface",
     "give a total over a region, [[loads]] with `force`"}};
const Without no_symmetry = {
    {particles,
     "is given, but a body with model = \"particles\" has no mirror image: particles on a plane "
     "would lack half of their neighbours",
     whole_body},
    {lattice,
     "is given, but a body with model = \"lattice\" has no mirror image: particles on a plane "
     "would lack half of their bonds",
     whole_body}};
const Without no_springs = {
    {lattice, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[springs]], which need bonds",
     "delete one of the two", "body.method"}};
const Without spring_stiffness = {
    {beam, "is given per area, but a beam has no faces", "give `total`"}};

/// Returns the region of a table. \param use  purpose of the region: "that is held"
template <class Section>
KeySchema region(std::string_view use) {
  return key("region", &Section::region).needed(use);
}

/// Returns the key of a motion along or about an axis, 0 to 5.
KeySchema motion(const char* name, std::size_t component, const Without& without = {}) {
  return key<DisplacementSection>(
      name,
      [component](DisplacementSection & section) -> auto& { return section.value[component]; }, {},
      without);
}

std::vector<KeySchema> motions() {
  return {region<DisplacementSection>("the name of the region whose motion is prescribed"),
          motion("x", 0),
          motion("y", 1),
          motion("z", 2, third_axis),
          motion("rotation", 5, turn_in_plane),
          motion("rx", 3, turn_in_space),
          motion("ry", 4, turn_in_space),
          motion("rz", 5, turn_in_space)};
}

}  // namespace

TableSchema support_table() {
  return {"supports",
          true,
          {region<SupportSection>("the name of the region that is held"),
           KeySchema("fix", Values(Kind::text).as_list())
               .needed("the axes that are held, fix = [\"x\", \"y\"]")}};
}

TableSchema displacement_table() {
  std::vector<KeySchema> keys = motions();
  keys.push_back(key("stage", &DisplacementSection::stage));
  return {"displacements", true, keys};
}

TableSchema velocity_table() { return {"velocities", true, motions(), no_velocities}; }

TableSchema load_table() {
  return {"loads",
          true,
          {region<LoadSection>("the name of the region that is loaded"),
           key("force", &LoadSection::force), key("body_force", &LoadSection::body_force),
           key("stage", &LoadSection::stage)},
          {},
          {{"force", "body_force"}}};
}

TableSchema traction_table() {
  return {"tractions",
          true,
          {region<TractionSection>("the name of the region whose surface is loaded"),
           key("traction", &TractionSection::traction), key("pressure", &TractionSection::pressure),
           key("stage", &TractionSection::stage)},
          no_tractions,
          {{"traction", "pressure"}}};
}

TableSchema point_load_table() {
  return {"point_loads",
          true,
          {key("at", &PointLoadSection::at, Kind::position).needed("the point that is loaded"),
           key("force", &PointLoadSection::force).derived(), key("stage", &PointLoadSection::stage),
           KeySchema("moment", Kind::moment, moments)
               .written_by(+[](TomlWriter& out, const PointLoadSection& load, Kinds kind) {
                 if (load.moment == Vector3{}) return;
                 if (axes_of(kind) == 2) return out.write("moment", load.moment[2]);
                 out.write("moment", load.moment, 3);
               })}};
}

TableSchema symmetry_table() {
  return {"symmetry",
          true,
          {key("axis", &SymmetrySection::axis, Kind::normal)
               .needed("the axis normal to the plane of symmetry"),
           key("at", &SymmetrySection::at), key("region", &SymmetrySection::region)},
          no_symmetry,
          {{"at", "region"}}};
}

TableSchema spring_table() {
  return {"springs",
          true,
          {region<SpringSection>("the name of the region that is held elastically"),
           key("stiffness", &SpringSection::stiffness, not_negative, spring_stiffness),
           key("total", &SpringSection::total, not_negative)},
          no_springs,
          {{"stiffness", "total"}}};
}

}  // namespace perilink
