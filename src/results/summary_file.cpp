#include "results/summary_file.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Space reserved for the summary of a run with many notes [bytes].
constexpr std::size_t reserve = 8 * 1024;
/// Largest size of a summary that is read [bytes].
constexpr std::size_t longest_summary = std::size_t{16} << 20;

std::string path_in(const fs::path& directory) { return (directory / "summary.json").string(); }

/// Returns the JSON text of a summary; invalid UTF-8, for example in paths, is replaced.
std::string text_of(const nlohmann::ordered_json& summary) {
  return summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

[[noreturn]] void refuse(const fs::path& directory, const std::string& fault) {
  throw FileError(
      fmt::format("{}: {}, so the file is damaged\n  delete it, so that the results "
                  "count as those of a killed run, or run the case again",
                  path_in(directory), fault));
}

}  // namespace

nlohmann::ordered_json summary_head(const CaseFile& input, const std::string& meshes,
                                    const std::string& status, const std::string& reason) {
  nlohmann::ordered_json head = {{"title", input.title},
                                 {"units", input.units},
                                 {"analysis", word_of(input.analysis.type)},
                                 {"model", word_of(input.body.model)},
                                 {"status", status},
                                 {"reason", reason}};
  if (!meshes.empty()) head["mesh_checksum"] = meshes;
  return head;
}

void write_running_summary(const fs::path& directory, const CaseFile& input,
                           const std::string& meshes) {
  std::string text =
      text_of(summary_head(input, meshes, "running",
                           "the run is not finished, or it was killed; at its end it replaces "
                           "this file"));
  text.insert(text.size() - 1, reserve - text.size() % reserve, ' ');
  write_whole_file(path_in(directory), text);
}

void write_failed_summary(const fs::path& directory, const CaseFile& input,
                          const std::string& meshes, const std::string& reason) {
  write_summary_file(directory, summary_head(input, meshes, "failed", reason));
}

void write_summary_file(const fs::path& directory, const nlohmann::ordered_json& summary) {
  const std::string path = path_in(directory), text = text_of(summary);
  try {
    write_whole_file(path, text, true);
  } catch (const DiskFull&) {
    std::error_code ignored;
    fs::remove(path, ignored);
    write_whole_file(path, text);
  }
}

std::optional<nlohmann::ordered_json> read_summary_file(const fs::path& directory) {
  const std::string path = path_in(directory);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  const std::string text = read_regular_file(path, longest_summary);
  if (text.empty()) refuse(directory, "is empty");
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) refuse(directory, "is not a JSON object");
  if (!json.contains("status")) refuse(directory, "lacks the \"status\" of every summary");
  for (const std::string_view quantity : words_of(Quantity{})) {
    const auto value = json.find(quantity);
    if (value == json.end() || value->is_number() || value->is_null()) continue;
    refuse(directory, fmt::format("\"{}\" is no number", quantity));
  }
  return json;
}

bool is_end(const std::string& status) {
  return status == "completed" || status == "collapsed" || status == "nothing_breaks";
}

std::string summary_text(const nlohmann::ordered_json& summary, const std::string& key,
                         const fs::path& directory) {
  const auto found = summary.find(key);
  if (found == summary.end()) return "";
  if (!found->is_string()) refuse(directory, fmt::format("\"{}\" is no text", key));
  return printable(found->get<std::string>());
}

}  // namespace perilink
