#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "io/case/binding/key_binding.hpp"

/// \file The tables of case_schema(), and rows and reasons of refusal that several of them share.

namespace perilink {

TableSchema top_table();
TableSchema body_table();
TableSchema region_table();
TableSchema material_table();
TableSchema support_table();
TableSchema displacement_table();
TableSchema velocity_table();
TableSchema load_table();
TableSchema traction_table();
TableSchema point_load_table();
TableSchema symmetry_table();
TableSchema spring_table();
TableSchema crack_table();
TableSchema interface_table();
TableSchema random_table();
TableSchema graded_table();
TableSchema rebar_table();
TableSchema element_table();
TableSchema gauge_table();
TableSchema analysis_table();
TableSchema stop_table();
TableSchema stage_table();
TableSchema output_table();

namespace shared {

using namespace kinds;
using namespace allowed;
using Kind = Values::Kind;
using Without = std::vector<NotFor>;

inline constexpr std::string_view delete_it = "delete it";
inline constexpr std::string_view no_bonds = "is given, but linear elements have no bonds";
inline constexpr std::string_view bonds_instead =
    "delete it, or the line method = \"linear_elements\"";
inline constexpr std::string_view another_model = "delete it, or choose another model in [body]";
inline constexpr std::string_view no_such_table =
    "is given, but a body with model = \"{model}\" cannot have it";
inline constexpr std::string_view flat_instead = "delete it, or choose another problem in [body]";
inline constexpr std::string_view no_beam = "is given, but beams have none";

inline constexpr Kinds bonds = bond_based | micropolar;
inline constexpr Kinds states = lattice | particles;
inline constexpr Kinds still = damage | elastic | relaxation;

/// Keys without a meaning for beams.
inline const NotFor of_beams{
    beam, "is given, but a beam is a row of particles whose bonds share its section", delete_it};
inline const Without in_beams = {of_beams};

/// Returns the exceptions of a key that these analyses do not use.
inline Without set_aside(Kinds analyses) { return {{analyses, {}, {}}}; }

inline const Without of_events = set_aside(explicit_ | relaxation);
inline const Without of_damage = set_aside(elastic | explicit_ | relaxation);
inline const Without of_relaxation = set_aside(damage | elastic | explicit_);
inline const Without of_time = set_aside(still);

inline constexpr int largest = std::numeric_limits<int>::max();
inline const Values positive_number(Kind::number, positive);

/// Returns the rows of several lists in one.
std::vector<KeySchema> joined_keys(std::initializer_list<std::vector<KeySchema>> lists);

/// Returns the rows of the curve of softening, which are read by hand.
/// \param knees  exceptions of the knee's rows
std::vector<KeySchema> softening_keys(const Without& without = {}, const Without& knees = {});

/// Returns the rows of a file of a mesh. \tparam Section  derived from MeshSource
template <class Section>
std::vector<KeySchema> mesh_keys() {
  return {KeySchema("mesh", Kind::text, in_beams)
              .written_by(+[](TomlWriter& out, const Section& section, Kinds) {
                out.write("mesh", section.mesh);
              }),
          key<Section>("mesh_size", &MeshSource::mesh_size, positive, in_beams).beside("mesh"),
          key<Section>("mesh_scale", &MeshSource::mesh_scale, from(1e-12, 1e12), in_beams)
              .beside("mesh")
              .hinted("give the factor from the unit of the mesh to that of the case: 0.001 from "
                      "millimetres to metres")};
}

}  // namespace shared
}  // namespace perilink
