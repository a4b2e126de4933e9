#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "io/case/case_file.hpp"

/// \file
/// DIR/summary.json of all analyses, written at the start with status "running" and replaced at the
/// end.

namespace perilink {

/// Returns the common beginning of summaries: case, analysis type, status and reason.
/// \param meshes  mesh_checksum(); empty without a mesh
nlohmann::ordered_json summary_head(const CaseFile& input, const std::string& meshes,
                                    const std::string& status, const std::string& reason);

/// Writes a summary with status "running", padded to reserve space for the final summary.
/// \throws FileError
void write_running_summary(const std::filesystem::path& directory, const CaseFile& input,
                           const std::string& meshes);

/// Writes the summary of a run that failed before its analysis. \throws FileError
void write_failed_summary(const std::filesystem::path& directory, const CaseFile& input,
                          const std::string& meshes, const std::string& reason);

/// Replaces the summary; on a full disk the reserve of write_running_summary() is used.
/// \throws FileError
void write_summary_file(const std::filesystem::path& directory,
                        const nlohmann::ordered_json& summary);

/// Reads the summary; empty where there is none.
/// \throws FileError where it is not a JSON object, lacks a status, or a quantity is not a number
std::optional<nlohmann::ordered_json> read_summary_file(const std::filesystem::path& directory);

/// Returns whether a status says that a run came to its end: completed, collapsed, nothing_breaks.
bool is_end(const std::string& status);

/// Returns a printable text of a summary; empty where the key is missing.
/// \throws FileError where the value is not a text
std::string summary_text(const nlohmann::ordered_json& summary, const std::string& key,
                         const std::filesystem::path& directory);

}  // namespace perilink
