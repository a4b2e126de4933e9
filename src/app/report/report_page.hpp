#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/report/report_streams.hpp"

namespace perilink {

/// First line of every report, by which the program knows its own files.
inline constexpr const char* report_mark = "<!doctype html><!-- report of perilink -->";

/// Time after which the page of a running case reloads itself [s].
inline constexpr int seconds_between_loads = 3;

/// Returns a JSON text that ends no script element, in ASCII: < > & are escaped.
std::string json_for_page(const nlohmann::ordered_json& json);

/// Returns a report as an HTML page that needs no other file.
/// \param runs        report_run() of each run
/// \param is_running  the page reloads itself every few seconds
std::string report_page(const nlohmann::ordered_json& runs, const ReportStreams& streams,
                        bool is_running);

}  // namespace perilink
