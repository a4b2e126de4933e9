#pragma once

#include <span>
#include <string>

#include "app/scan/scan_result.hpp"
#include "io/case/scan_file.hpp"

/// \file
/// Results of a scan as tables. Results are in the order of the members.

namespace perilink {

/// Returns scan.csv: a row for each member, with the seconds in the last column.
std::string scan_table(const ScanFile& scan, std::span<const ScanResult> results);

/// Returns the table that is printed, the reasons of failures and a summary.
std::string scan_report(const ScanFile& scan, std::span<const ScanResult> results);

/// Returns the name of the directory of a member, "0001" for the first.
std::string member_name(std::size_t member);

}  // namespace perilink
