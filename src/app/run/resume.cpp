#include "app/run/resume.hpp"

#include <fmt/format.h>

#include <array>
#include <sstream>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/case/case_file.hpp"
#include "model/body/mesh_input.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

constexpr const char* other_ways =
    "\n  begin it again with --force in place of --resume, or choose another directory with --out "
    "DIR";

/// Returns the first lines that differ, "`a = 1` there, `a = 2` here".
std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream old(there), now(here);
  std::string before, after;
  while (before == after && old && now) {
    std::getline(old, before);
    std::getline(now, after);
  }
  const auto shown = [](const std::string& line) {
    return line.empty() ? std::string("nothing") : "`" + line + "`";
  };
  return fmt::format("{} there, {} here", shown(before), shown(after));
}

/// Refuses a stop rule that the results may have passed already.
/// \param table  "stop", "stages[2]"
void require_raised(const StopSection& there, const StopSection& here, const std::string& table,
                    const std::filesystem::path& directory) {
  const auto refuse = [&](const char* key) {
    throw FileError(fmt::format(
        "{}: its rows may be past {}.{}, which comes earlier than that of the results, or is new\n"
        "  raise stop rules or delete them to go on{}",
        directory.string(), table, key, other_ways));
  };
  const auto is_lower = [](const auto& old, const auto& now) {
    return now && (!old || *now < *old);
  };
  if (is_lower(there.broken_bonds, here.broken_bonds)) refuse("broken_bonds");
  if (is_lower(there.displacement, here.displacement)) refuse("displacement");
  if (here.load_fraction && (!there.load_fraction || *here.load_fraction > *there.load_fraction)) {
    refuse("load_fraction");
  }
}

bool has_ended(const std::filesystem::path& directory) {
  const auto summary = read_summary_file(directory);
  if (!summary) return false;
  const std::string status = summary_text(*summary, "status", directory);
  constexpr std::array<const char*, 3> ends = {"completed", "collapsed", "nothing_breaks"};
  return std::ranges::any_of(ends, [&](const char* end) { return status == end; });
}

}  // namespace

std::string resumable_case(const CaseFile& input, const std::filesystem::path& directory) {
  CaseFile seen = seen_from(input, directory);
  seen.stop = {};
  if (!seen.stages.empty()) seen.stages.back().stop = {};
  return write_case(seen);
}

Resumed find_results(const CaseFile& input, const std::filesystem::path& directory) {
  const std::filesystem::path old = directory / "case.toml";
  if (!std::filesystem::exists(old)) return {};
  CaseFile there = read_case_file(old.string());
  there.trust_geometry = input.trust_geometry;
  const std::string before = resumable_case(there, directory);
  const std::string now = resumable_case(input, directory);
  if (before != now) {
    throw FileError(fmt::format("{}: holds the results of another case: {}{}", directory.string(),
                                first_difference(before, now), other_ways));
  }
  require_raised(there.stop, input.stop, "stop", directory);
  if (!input.stages.empty()) {
    require_raised(there.stages.back().stop, input.stages.back().stop,
                   fmt::format("stages[{}]", input.stages.size()), directory);
  }
  const bool same_rules =
      read_regular_file(old.string()) == write_case(seen_from(input, directory));
  Resumed found;
  found.is_finished = same_rules && has_ended(directory);
  if (!found.is_finished) {
    found.checkpoint = read_checkpoint((directory / checkpoint_name).string());
  }
  if (found.checkpoint && found.checkpoint->run != now) {
    throw FileError(fmt::format("{}: is of another case: {}{}",
                                (directory / checkpoint_name).string(),
                                first_difference(found.checkpoint->run, now), other_ways));
  }
  return found;
}

void require_same_model(const Checkpoint& checkpoint, const std::string& fingerprint,
                        const std::filesystem::path& directory) {
  if (checkpoint.model == fingerprint) return;
  throw FileError(fmt::format(
      "{}: was saved with another model ({} there, {} here): a mesh has changed, or "
      "another machine rounds the stiffness in another way{}",
      (directory / checkpoint_name).string(), checkpoint.model, fingerprint, other_ways));
}

}  // namespace perilink
