#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "io/case/case_file.hpp"

/// \file
/// DIR/summary.json, whatever the analysis: written first when a run starts, with the status
/// "running", and replaced at its end.

namespace perilink {

/// What every summary begins with: whose run it is, of which kind, and how it stands.
nlohmann::ordered_json summary_head(const CaseFile& input, const std::string& status,
                                    const std::string& reason);

/// Says that a run is under way, or was killed. Takes the room that the last summary will need.
/// \throws FileError
void write_running_summary(const std::filesystem::path& directory, const CaseFile& input);

/// Says that a run failed before it computed anything. \throws FileError
void write_failed_summary(const std::filesystem::path& directory, const CaseFile& input,
                          const std::string& reason);

/// Replaces the file; on a full disk the summary of write_running_summary() makes room.
/// \throws FileError
void write_summary_file(const std::filesystem::path& directory,
                        const nlohmann::ordered_json& summary);

/// Reads the file back; nothing where there is none.
/// \throws FileError where it is no JSON object, has no status, or a Quantity of it is no number
std::optional<nlohmann::ordered_json> read_summary_file(const std::filesystem::path& directory);

/// A text of a summary, printable; empty where it has none of this name.
/// \throws FileError where the value is something else
std::string summary_text(const nlohmann::ordered_json& summary, const std::string& key,
                         const std::filesystem::path& directory);

}  // namespace perilink
