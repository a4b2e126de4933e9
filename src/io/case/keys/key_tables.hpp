#pragma once

#include <string_view>
#include <vector>

#include "io/case/case_schema.hpp"

/// \file The tables of case_schema(), and reasons of refusal that several of them share.

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
TableSchema rebar_table();
TableSchema element_table();
TableSchema gauge_table();
TableSchema analysis_table();
TableSchema stop_table();
TableSchema stage_table();
TableSchema output_table();

namespace reasons {

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

inline constexpr Kinds bonds = kinds::bond_based | kinds::micropolar;
inline constexpr Kinds states = kinds::lattice | kinds::particles;
inline constexpr Kinds still = kinds::damage | kinds::elastic | kinds::relaxation;

/// Keys without a meaning for beams.
inline const NotFor of_beams{
    kinds::beam, "is given, but a beam is a row of particles whose bonds share its section",
    delete_it};
inline const Without in_beams = {of_beams};

/// Returns the exceptions of a key that these analyses do not use.
inline Without set_aside(Kinds analyses) { return {{analyses, {}, {}}}; }

inline const Without of_events = set_aside(kinds::explicit_ | kinds::relaxation);
inline const Without of_damage = set_aside(kinds::elastic | kinds::explicit_ | kinds::relaxation);
inline const Without of_relaxation = set_aside(kinds::damage | kinds::elastic | kinds::explicit_);
inline const Without of_time = set_aside(still);

}  // namespace reasons
}  // namespace perilink
