#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/scan/scan_result.hpp"
#include "io/case/case_file.hpp"
#include "io/case/scan_file.hpp"
#include "results/result_directory.hpp"

/// \file
/// Runs of the members of a scan, each in a process, with their table and picture.

namespace perilink {

/// A member of a scan whose process has ended.
struct EndedMember {
  std::size_t number = 0;  ///< from 0
  const ScanResult& result;
  std::size_t done = 0;   ///< members that have ended, with this one
  std::size_t count = 0;  ///< members that this scan runs
};

/// How the members of a scan run. Functions may be empty; all are called from the caller's thread.
struct ScanSettings {
  std::filesystem::path directory;
  std::vector<CaseSetting> common = {};  ///< values of --set, for all members
  int jobs = 0;                          ///< most members at once; 0: as many as have processors
  int threads = 1;                       ///< of each member
  /// Removed: all members run anew; else finished results of the same cases are kept.
  OldResults old_results = OldResults::refused;
  bool trust_geometry = false;                    ///< gmsh scripts may run commands and write files
  std::string program = "/proc/self/exe";         ///< of the members
  std::vector<std::string> words = {"perilink"};  ///< its command line up to `run`
  std::function<bool()> stop_requested = {};
  std::function<void()> on_start = {};  ///< called before the first member runs
  std::function<void(const EndedMember&)> on_member = {};
  /// Called every tenth of a second with the members that have ended, and all that run.
  std::function<void(std::size_t, std::size_t)> on_wait = {};
};

/// Reads and checks the case of every member, and gives the scan its title.
/// \param common  values of --set, for all members
/// \throws InputError  at the member's values, or at those of --set
std::vector<CaseFile> read_members(ScanFile& scan, const std::vector<CaseSetting>& common);

/// Runs the members in parallel until all have ended or a stop is requested. A case without a file
/// is written to scan_case.toml in the directory.
/// \param cases  of read_members()
/// \return results in the order of the members
/// \throws FileError  where the directory holds results of another case, or cannot be written
std::vector<ScanResult> run_scan(ScanFile& scan, const std::vector<CaseFile>& cases,
                                 const ScanSettings& settings);

}  // namespace perilink
