#pragma once

#include <span>
#include <string>

#include "assembly/results/crack_list.hpp"

namespace perilink {

/// Returns the text of cracks_STEP.csv: a row for each crack, the widest first. Columns: crack
/// (from 1), bonds, x, y, z, length, normal_x, normal_y, normal_z, mean_opening, largest_opening,
/// widest_x, widest_y, widest_z, face_opening, bar (from 1), bar_opening (GrownCrack); the last
/// three are empty where the crack reaches no face or bar.
/// \param dim  2: without the columns of z
std::string crack_table(std::span<const GrownCrack> cracks, int dim);

}  // namespace perilink
