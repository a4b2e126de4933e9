#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/report/report_streams.hpp"
#include "app/report/report_units.hpp"

namespace perilink {

/// Returns which of `count` field files a report shows: all up to `most`, else the first, the last,
/// `peak` and others at equal distances. Ascending, at least three.
std::vector<std::size_t> shown_files(std::size_t count, std::size_t most, std::size_t peak);

/// Returns the body of a run and its fields for the script of a report; null without field files.
/// Particles are written once and broken bonds with the numbers of their breaks, from the last
/// file. Every file shown is a stream of the fields in steps of a range (append_steps), and of the
/// corners of finite elements.
/// \param peak_time  row of the peak, or its time, as in fields.pvd
/// \param most       characters of base64 that the streams should not exceed; at least three files
///                   are shown
/// \throws FileError where a file cannot be read or has other particles than the last
nlohmann::ordered_json report_body(const std::filesystem::path& directory, double peak_time,
                                   std::size_t most, const UnitNames& units,
                                   ReportStreams& streams);

}  // namespace perilink
