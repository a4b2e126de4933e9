#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/csv.hpp"

namespace perilink {

/// Most rows of a history in a report: four for each of 2500 columns of pixels.
inline constexpr std::size_t most_report_rows = 10000;

/// Returns the rows that show a curve, in their order: all up to `most`, else of each of most / 4
/// equal parts the first, the last and those of the smallest and largest load.
std::vector<std::size_t> shown_rows(const std::vector<double>& loads, std::size_t most);

/// Returns the header and some rows of a table as they are in the file.
/// \param text  whole file
/// \param rows  ascending, from 0 behind the header; those that the text lacks are left out
std::string text_of_rows(std::string_view text, const std::vector<std::size_t>& rows);

}  // namespace perilink
