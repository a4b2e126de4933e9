#pragma once

#include <string>
#include <vector>

#include "analysis/quasistatic/ranks/team.hpp"
#include "app/results/field_file.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// What fields of pieces need beside the parts of the ranks.
struct PieceInput {
  FieldMoment moment;
  Problem problem = Problem::three_dimensional;
  std::vector<HookeConstants> hooke;  ///< per material
};

/// Fields of an elastic body whose parts ranks have made, at the motion of the last
/// Team::internal(): each rank writes STEM_RANK.vtu with what it owns, the first one STEM.pvtu.
/// \throws SolverError where one of them cannot, FileError where the latter is not written
void write_pieces(const Team& team, const std::string& stem, const PieceInput& input);

/// Stresses at all particles at that motion, shape (particles, 6).
/// \param particles  that the body has
std::vector<double> stresses_of_parts(const Team& team, Index particles, const PieceInput& input);

/// What the other ranks do meanwhile.
/// \param order  its Service read
void show_fields_along(Ranks& ranks, const PartSolver& own, Parcel& order);

}  // namespace perilink
