#include "io/case/case_unused.hpp"

#include <fmt/format.h>

#include <array>

namespace perilink {
namespace {

/// Which analyses use a key: `quasistatic` are type = "damage" and "elastic".
struct KeyUse {
  const char* key;
  bool quasistatic, relaxation, explicit_;
};

constexpr std::array uses = {
    KeyUse{"analysis.control", true, false, false},
    KeyUse{"analysis.factor", true, false, false},
    KeyUse{"analysis.load_factors", true, true, false},
    KeyUse{"analysis.strain", false, true, true},
    KeyUse{"analysis.tolerance", false, true, false},
    KeyUse{"analysis.iterations", false, true, false},
    KeyUse{"analysis.duration", false, false, true},
    KeyUse{"analysis.ramp_time", false, false, true},
    KeyUse{"analysis.time_step", false, false, true},
    KeyUse{"analysis.safety", false, false, true},
    KeyUse{"analysis.rows", false, false, true},
    KeyUse{"analysis.damping_rate", false, false, true},
    KeyUse{"analysis.masses", false, false, true},
    KeyUse{"stop", true, false, false},
    KeyUse{"output.fields_at", true, false, false},
    KeyUse{"output.fields_every", true, false, false},
    KeyUse{"output.fields_times", false, false, true},
};

bool is_used(const KeyUse& use, const std::string& type) {
  return type == "explicit"     ? use.explicit_
         : type == "relaxation" ? use.relaxation
                                : use.quasistatic;
}

}  // namespace

void set_aside_unused(CaseFile& input) {
  for (const KeyUse& use : uses) {
    if (input.lines.count(use.key) == 0 || is_used(use, input.analysis.type)) continue;
    input.unused.emplace_back(use.key);
    const std::string key = use.key;
    if (key == "stop") input.stop = {};
    if (key == "output.fields_at") input.output.fields_at = {};
    if (key == "output.fields_every") input.output.fields_every = {};
    if (key == "output.fields_times") input.output.fields_times = {};
  }
}

std::optional<std::string> note_of_unused(const CaseFile& input) {
  if (input.unused.empty()) return std::nullopt;
  return fmt::format("not used by type = \"{}\": {}", input.analysis.type,
                     fmt::join(input.unused, ", "));
}

}  // namespace perilink
