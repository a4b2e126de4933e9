#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "discretization/particles.hpp"
#include "discretization/points/point_field.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Reads the field of the file of a table of [[graded]].
/// \param entry  index of the table, whose `file` is given
/// \throws InputError with the place in the case or in the file
std::shared_ptr<const PointField> read_field_file(const CaseFile& input, std::size_t entry);

/// Returns a note on the points of a file, the range of their values and how far particles lie
/// outside of the points.
/// \throws InputError where no solid particle lies among the points
std::string field_file_note(const CaseFile& input, std::size_t entry, const PointField& field,
                            const Particles& particles);

}  // namespace perilink
