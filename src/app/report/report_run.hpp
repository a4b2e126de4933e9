#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "app/report/report_streams.hpp"

namespace perilink {

/// Returns what a report shows of the result of a run, finished or not: texts, summary, curve and
/// body, with the numbers of the streams that hold rows, fields and the case.
/// \param most  characters of base64 that rows and fields should not exceed
/// \param at    row whose body is shown first: "peak", "last" or a number
/// \throws FileError where the directory is no result of a run, or a file cannot be read
nlohmann::ordered_json report_run(const std::string& directory, std::size_t most,
                                  ReportStreams& streams, const std::string& at = "last");

}  // namespace perilink
