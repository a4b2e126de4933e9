#include "io/case/sections/case_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

StageSection read_stage(const CaseTable& table, Kinds kind) {
  auto stage = read_section<StageSection>("stages", table, kind);
  if (stage.name.empty()) table.refuse("name", "is empty", "give the stage a name");
  if (!table.has("loads")) stage.loads = stage.name;
  check_rules_of_gauge(table);
  if (!stage.to && !stage.to_load) return stage;
  for (const char* rule : {"to_load", "broken_bonds", "load_fraction", "displacement", "gauge"}) {
    const std::string end = stage.to ? "to" : "to_load";
    if (!table.has(rule) || end == rule) continue;
    table.refuse(rule, fmt::format("is given together with `{}`", end),
                 "a stage goes to a load factor or a load, or by events until a rule is met; "
                 "delete one of the two");
  }
  return stage;
}

namespace {

/// Calls visit(table, index, stage) for every entry that loads the body.
template <class Input, class Visit>
void for_each_load(Input& input, Visit visit) {
  const auto all = [&](const char* table, auto& sections) {
    for (std::size_t i = 0; i < sections.size(); ++i) visit(table, i, sections[i].stage);
  };
  all("loads", input.loads);
  all("tractions", input.tractions);
  all("point_loads", input.point_loads);
  all("displacements", input.displacements);
  for (std::size_t i = 0; i < input.rebar.size(); ++i) {
    if (input.rebar[i].prestrain != 0.0) visit("rebar", i, input.rebar[i].stage);
  }
}

void refuse_stages_of_loads(CaseFile& input) {
  for_each_load(input, [&](const char* table, std::size_t i, const std::string& stage) {
    if (stage.empty()) return;
    throw InputError(input.where(item_key(table, i, "stage")),
                     fmt::format("is {}, but the case has no [[stages]]", quoted(stage)),
                     "delete it, or add [[stages]] with this name");
  });
}

/// Refuses keys that stages exclude.
void refuse_beside_stages(const CaseFile& input) {
  const StopSection& stop = input.stop;
  if (stop.broken_bonds || stop.load_fraction || stop.displacement || !stop.gauge.empty()) {
    throw InputError(input.where("stop"), "is given, but the case has [[stages]]",
                     "move its rules to the stages that they end");
  }
  if (input.analysis.control == LoadControl::steps) {
    throw InputError(
        input.where("analysis.control"),
        "is \"steps\", but the case has [[stages]], which say how loads grow",
        "delete `control` and `load_factors`; a stage with `to` goes to a load factor");
  }
  if (input.analysis.rigid_body_modes == RigidBodyModes::pin) {
    throw InputError(input.where("analysis.rigid_body_modes"),
                     "is \"pin\", but the case has [[stages]], whose loads would each have to "
                     "balance",
                     "hold the body with [[supports]], [[symmetry]] or [[springs]]");
  }
}

/// Returns the names of stages that have their own loads, and checks all names.
std::vector<std::string_view> check_names(const CaseFile& input) {
  std::vector<std::string_view> owners;
  std::set<std::string_view> before;
  for (std::size_t i = 0; i < input.stages.size(); ++i) {
    const StageSection& stage = input.stages[i];
    if (!before.insert(stage.name).second) {
      throw InputError(input.where(item_key("stages", i, "name")),
                       fmt::format("is {}, the name of another stage", quoted(stage.name)),
                       "give every stage a different name; `loads` says whose loads it changes");
    }
    if (stage.loads == stage.name) {
      owners.push_back(stage.name);
    } else if (std::find(owners.begin(), owners.end(), stage.loads) == owners.end()) {
      throw InputError(
          input.where(item_key("stages", i, "loads")),
          fmt::format("is {}, but no earlier stage of that name has loads", quoted(stage.loads)),
          owners.empty() ? "delete it: the first stage must have its own loads"
                         : suggest(stage.loads, owners));
    }
  }
  return owners;
}

/// Refuses a stage without an end, unless it is the last.
void refuse_endless(const CaseFile& input, std::size_t i) {
  const StageSection& stage = input.stages[i];
  const StopSection& stop = stage.stop;
  const bool ends = stage.to || stage.to_load || stop.broken_bonds || stop.load_fraction ||
                    stop.displacement || !stop.gauge.empty();
  if (ends || i + 1 == input.stages.size()) return;
  throw InputError(input.where(item_key("stages", i)),
                   fmt::format("goes on until the body collapses, so that stage {} never begins",
                               quoted(input.stages[i + 1].name)),
                   "give it `to` or `to_load`, or one of `displacement`, `load_fraction`, "
                   "`broken_bonds`, `gauge`");
}

}  // namespace

void resolve_stages(CaseFile& input) {
  if (input.stages.empty()) return refuse_stages_of_loads(input);
  refuse_beside_stages(input);
  const std::vector<std::string_view> owners = check_names(input);
  std::set<std::string_view> loaded;
  for_each_load(input, [&](const char* table, std::size_t i, std::string& stage) {
    if (stage.empty() && owners.size() == 1) stage = owners.front();
    if (stage.empty()) {
      throw InputError(input.where(item_key(table, i)),
                       "lacks `stage`, but several stages have loads of their own",
                       suggest("", owners));
    }
    const auto owner = std::find(owners.begin(), owners.end(), stage);
    if (owner == owners.end()) {
      throw InputError(
          input.where(item_key(table, i, "stage")),
          fmt::format("is {}, but no stage of that name has its own loads", quoted(stage)),
          suggest(stage, owners));
    }
    loaded.insert(*owner);
  });
  for (std::size_t i = 0; i < input.stages.size(); ++i) {
    refuse_endless(input, i);
    const std::string& loads = input.stages[i].loads;
    if (loaded.count(loads) > 0) continue;
    throw InputError(
        input.where(item_key("stages", i)),
        fmt::format("has no loads: none has stage = {}", quoted(loads)),
        "give loads this `stage`, or name the loads of an earlier stage: loads = \"NAME\"");
  }
}

}  // namespace perilink
