#include "io/case/case_file.hpp"

#include <fmt/format.h>

#include <array>
#include <type_traits>

#include "io/case/case_keys.hpp"
#include "io/case/case_overrides.hpp"
#include "io/case/case_settings.hpp"
#include "io/case/case_table.hpp"
#include "io/case/sections/case_elements.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_rebar.hpp"
#include "io/case/sections/case_rules.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/case/sections/case_stages.hpp"
#include "io/case/sections/case_unused.hpp"
#include "io/case/sections/laws/case_interfaces.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Records the lines of a key and of all keys below it, without the numbers of lists.
void collect_lines(const TomlValue& value, const std::string& key,
                   std::map<std::string, int>& lines) {
  if (!key.empty()) lines[key] = value.line;
  for (const TomlValue& entry : value.entries) {
    collect_lines(entry, key.empty() ? entry.key : key + "." + entry.key, lines);
  }
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (value.items[i].kind == TomlValue::Kind::table) {
      collect_lines(value.items[i], item_key(key, i), lines);
    }
  }
}

/// The document's tables as CaseTable; absent tables are empty.
class Document {
 public:
  Document(const TomlValue& root, const std::string& path) : root_(root), path_(path) {}

  CaseTable top() const { return {root_, "", path_}; }

  CaseTable table(const std::string& name) const {
    static const TomlValue absent;
    const TomlValue* found = root_.find(name);
    return {found != nullptr ? *found : absent, name, path_};
  }

  CaseTable needed_table(const std::string& name) const {
    if (root_.find(name) == nullptr) refuse_missing("[" + name + "]");
    return table(name);
  }

  /// Reads every entry of a list of tables.
  template <class Reader>
  auto list(const std::string& name, Reader reader) const {
    std::vector<std::decay_t<std::invoke_result_t<Reader, CaseTable, std::size_t>>> result;
    const TomlValue* found = root_.find(name);
    for (std::size_t i = 0; found != nullptr && i < found->items.size(); ++i) {
      result.push_back(reader(CaseTable(found->items[i], item_key(name, i), path_), i));
    }
    return result;
  }

  template <class Reader>
  auto needed_list(const std::string& name, Reader reader) const {
    auto result = list(name, reader);
    if (result.empty()) refuse_missing("[[" + name + "]]");
    return result;
  }

 private:
  [[noreturn]] void refuse_missing(const std::string& header) const {
    throw InputError(
        {path_, 0, ""}, fmt::format("the case has no {}", header),
        "a case needs [body], [[regions]], [[materials]] and [[loads]], [[tractions]], "
        "[[point_loads]] or [[displacements]]; docs/case_file.md describes them");
  }

  const TomlValue& root_;
  const std::string& path_;
};

/// Reads the kind of the case, before all other keys.
void read_kind(const Document& document, CaseFile& input) {
  const CaseTable body = document.needed_table("body");
  assign(input.body.problem, body.choice<Problem>("problem"));
  assign(input.body.method, body.choice<BodyMethod>("method"));
  if (input.body.method == BodyMethod::bonds) {
    if (is_shell(input.body) || is_beam(input.body)) input.body.model = BodyModel::micropolar;
    assign(input.body.model, body.choice<BodyModel>("model"));
  }
  assign(input.analysis.type, document.table("analysis").choice<AnalysisType>("type"));
}

void refuse_studies(const TomlValue& root, const std::string& path) {
  for (const auto& [key, of, command] :
       {std::array{"vary", "study", "converge"}, std::array{"values", "scan", "scan"},
        std::array{"runs", "scan", "scan"}}) {
    const TomlValue* found = root.find(key);
    if (found == nullptr) continue;
    throw InputError({path, found->line, key},
                     fmt::format("belongs to a {}, but this command needs a case", of),
                     fmt::format("run the {} by `perilink {} {}`", of, command, path));
  }
}

}  // namespace

std::string item_key(const std::string& table, std::size_t index, const std::string& key) {
  const std::string item = fmt::format("{}[{}]", table, index + 1);
  return key.empty() ? item : item + "." + key;
}

SourceLocation CaseFile::where(const std::string& key) const {
  std::string above = key;
  while (!above.empty()) {
    const auto found = lines.find(above);
    if (found != lines.end()) return {path, found->second, key};
    const std::size_t end = above.find_last_of(".[");
    above.resize(end == std::string::npos ? 0 : end);
  }
  return {path, 0, key};
}

CaseFile parse_case(const std::string& text, const std::string& path) {
  return parse_case(text, path, {}, {});
}

CaseFile parse_case(const std::string& text, const std::string& path,
                    const std::vector<TomlValue>& body_keys) {
  return parse_case(text, path, {}, body_keys);
}

CaseFile parse_case(const std::string& text, const std::string& path,
                    const std::vector<CaseSetting>& settings,
                    const std::vector<TomlValue>& body_keys) {
  refuse_large_input(text, path);
  TomlValue root = parse_toml(text, path);
  refuse_studies(root, path);
  apply_settings(root, path, settings);
  override_body(root, path, body_keys);
  check_against_schema(root, path, case_schema(), "case");
  const Document document(root, path);

  CaseFile input;
  input.path = path;
  collect_lines(root, "", input.lines);
  assign(input.title, document.top().text("title"));
  assign(input.units, document.top().text("units"));
  read_kind(document, input);
  input.unused = find_unused(root, input);
  input.body = read_body(document.table("body"), input.body);
  const int dim = dimension_of(input.body);
  const auto about = [](auto reader, const auto& known) {
    return [reader, &known](const CaseTable& table, std::size_t) { return reader(table, known); };
  };
  input.regions = document.needed_list("regions", about(read_region, dim));
  input.materials =
      document.needed_list("materials", [&input](const CaseTable& table, std::size_t index) {
        return read_material(table, input, index);
      });
  input.supports = document.list("supports", about(read_support, input.body));
  input.displacements = document.list("displacements", about(read_displacement, input.body));
  input.velocities = document.list("velocities", about(read_displacement, input.body));
  input.loads = document.list("loads", about(read_load, input.body));
  input.tractions = document.list("tractions", about(read_traction, input.body));
  input.point_loads = document.list("point_loads", about(read_point_load, input.body));
  input.symmetry = document.list("symmetry", about(read_symmetry, dim));
  const int axes = axes_of(input.body);
  input.springs = document.list("springs", about(read_springs, axes));
  input.cracks = document.list("cracks", about(read_crack, dim));
  input.interfaces = document.list("interfaces", about(read_interface, dim));
  input.random = document.list(
      "random", [](const CaseTable& table, std::size_t) { return read_random(table); });
  input.rebar = document.list("rebar", about(read_rebar, dim));
  input.gauges = document.list("gauges", about(read_gauge, input.body));
  input.elements = read_elements(document.table("elements"));
  input.analysis = read_analysis(document.table("analysis"), input.analysis.type);
  const StopSection stop = read_stop(document.table("stop"));
  if (input.analysis.type == AnalysisType::damage) {
    input.stop = stop;
  } else if (input.analysis.type != AnalysisType::elastic) {
    input.stop = {{}, {}, {}, stop.gauge, stop.above, stop.below};
  }
  input.stages = document.list(
      "stages", [](const CaseTable& table, std::size_t) { return read_stage(table); });
  input.output = read_output(document.table("output"), input.analysis.type);
  resolve_stages(input);
  check_rules(input);
  return input;
}

CaseFile read_case_file(const std::string& path) { return read_case_file(path, {}, {}); }

CaseFile read_case_file(const std::string& path, const std::vector<CaseSetting>& settings,
                        const std::vector<TomlValue>& body_keys) {
  return parse_case(read_input_text(path), path, settings, body_keys);
}

}  // namespace perilink
