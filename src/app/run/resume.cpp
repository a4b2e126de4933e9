#include "app/run/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "model/body/mesh_input.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

constexpr const char* other_ways =
    "\n  begin it again with --force, or choose another directory with --out DIR";

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
  if (here.gauge.empty()) return;
  const bool other = there.gauge != here.gauge;
  if (other || is_lower(there.above, here.above)) refuse("gauge");
  if (here.below && (!there.below || *here.below > *there.below)) refuse("gauge");
}

/// State of earlier results in their summary; empty where it is damaged, as it is written anew.
struct Earlier {
  bool has_ended = false;
  std::string meshes;  ///< mesh_checksum() of the run
};

Earlier read_earlier(const std::filesystem::path& directory) {
  try {
    const auto summary = read_summary_file(directory);
    if (!summary) return {};
    return {is_end(summary_text(*summary, "status", directory)),
            summary_text(*summary, "mesh_checksum", directory)};
  } catch (const FileError&) {
    return {};
  }
}

/// Returns a case with a checksum in place of paths of meshes and fields, which may have changed.
CaseFile with_checksum(CaseFile input, const std::string& meshes) {
  const std::string name = meshes.empty() ? "cannot be read" : "checksum " + meshes;
  if (input.body.mesh) input.body.mesh = name;
  if (input.elements && input.elements->mesh) input.elements->mesh = name;
  for (GradedSection& graded : input.fields.graded) {
    if (graded.file && is_used(input, graded)) graded.file = name;
  }
  return input;
}

/// Refuses results without the files that a run goes on with.
void require_history(const std::filesystem::path& directory) {
  for (const char* name : {"history.csv", "timing.csv"}) {
    if (std::filesystem::exists(directory / name)) continue;
    throw FileError(fmt::format("{}: is missing, so its run cannot go on{}",
                                (directory / name).string(), other_ways));
  }
}

}  // namespace

Index rows_between_checkpoints(double checkpoint, double row) {
  constexpr double part = 0.02, least_seconds = 5.0;
  return static_cast<Index>(std::clamp(std::max(checkpoint / part, least_seconds) / row, 1.0, 1e8));
}

bool holds_a_run(const std::filesystem::path& directory) {
  if (std::filesystem::exists(directory / "case.toml")) {
    return !std::filesystem::exists(directory / "study.toml");
  }
  return std::ranges::all_of(
      refuse_old_results(directory, true), [](const std::filesystem::path& file) {
        return file.filename() == "summary.json" || file.extension() == ".part";
      });
}

std::string resumable_case(const CaseFile& input, const std::string& meshes) {
  CaseFile kept = with_checksum(input, meshes);
  kept.stop = {};
  if (!kept.stages.empty()) kept.stages.back().stop = {};
  return write_case(kept);
}

Resumed find_results(const CaseFile& input, const std::filesystem::path& directory) {
  const std::filesystem::path old = directory / "case.toml";
  if (!std::filesystem::exists(old)) return {};
  CaseFile there = read_case_file(old.string());
  there.trust_geometry = input.trust_geometry;
  Earlier earlier = read_earlier(directory);
  if (earlier.meshes.empty()) earlier.meshes = mesh_checksum(there);
  const std::string meshes = mesh_checksum(input);
  const std::string before = resumable_case(there, earlier.meshes);
  const std::string now = resumable_case(input, meshes);
  if (before != now) {
    const std::string difference = resumable_case(there, meshes) == now
                                       ? "the contents of a mesh or field have changed"
                                       : first_difference(before, now);
    throw FileError(fmt::format("{}: holds the results of another case: {}{}", directory.string(),
                                difference, other_ways));
  }
  require_raised(there.stop, input.stop, "stop", directory);
  if (!input.stages.empty()) {
    require_raised(there.stages.back().stop, input.stages.back().stop,
                   fmt::format("stages[{}]", input.stages.size()), directory);
  }
  const bool same_rules =
      write_case(with_checksum(there, meshes)) == write_case(with_checksum(input, meshes));
  Resumed found;
  found.is_finished = same_rules && earlier.has_ended;
  if (!found.is_finished) {
    found.checkpoint = read_checkpoint((directory / checkpoint_name).string());
  }
  if (found.checkpoint && found.checkpoint->run != now) {
    throw FileError(fmt::format("{}: is of another case: {}{}",
                                (directory / checkpoint_name).string(),
                                first_difference(found.checkpoint->run, now), other_ways));
  }
  if (found.is_finished || found.checkpoint) require_history(directory);
  return found;
}

void require_same_model(const Checkpoint& checkpoint, const std::string& fingerprint,
                        const std::filesystem::path& directory) {
  if (checkpoint.model == fingerprint) return;
  throw FileError(fmt::format(
      "{}: was saved with another model ({} there, {} here): a mesh or a field has changed, or "
      "another machine rounds the stiffness in another way{}",
      (directory / checkpoint_name).string(), checkpoint.model, fingerprint, other_ways));
}

}  // namespace perilink
