#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/scan/scan_result.hpp"
#include "io/case/scan_file.hpp"

/// \file
/// Results of a scan as tables. Results are in the order of the members.

namespace perilink {

/// Numbers of members that differ in their seeds alone.
struct ScanSample {
  std::string name;            ///< values of the other keys; empty: there are none
  std::vector<double> values;  ///< of members with the number
  double mean() const;         ///< NaN without values
  double deviation() const;    ///< standard deviation, with values - 1; NaN below two values
};

/// Returns the samples of a scan with seeds, else none.
/// \param quantity  number of summary.json
std::vector<ScanSample> samples_of(const ScanFile& scan, std::span<const ScanResult> results,
                                   const std::string& quantity);

/// Describes a sample, "20 seeds: mean 3.1, standard deviation 0.2 (6.5 %)".
std::string sample_text(const ScanSample& sample);

/// Returns scan.csv: a row for each member, with the seconds in the last column.
std::string scan_table(const ScanFile& scan, std::span<const ScanResult> results);

/// Returns scan_seeds.csv: mean and standard deviation of each number over each set of seeds.
std::string seed_table(const ScanFile& scan, std::span<const ScanResult> results);

/// Returns the table that is printed, the reasons of failures and a summary.
std::string scan_report(const ScanFile& scan, std::span<const ScanResult> results);

/// Returns the name of the directory of a member, "0001" for the first.
std::string member_name(std::size_t member);

/// Returns the values with which the run in a directory differs from others of its scan,
/// "spacing = 0.5, surface = none", from the scan.csv beside it; empty: it is of no scan.
std::string scanned_values(const std::filesystem::path& directory);

}  // namespace perilink
