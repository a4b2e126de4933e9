#include "io/case/case_file.hpp"

#include <fmt/format.h>

#include <array>
#include <type_traits>

#include "io/case/binding/key_binding.hpp"
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

  /// Refuses a case without an entry of a list of tables.
  void need(const std::string& name) const {
    const TomlValue* found = root_.find(name);
    if (found == nullptr || found->items.empty()) refuse_missing("[[" + name + "]]");
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
    const auto found = source.lines.find(above);
    if (found != source.lines.end()) return {source.path, found->second, key};
    const std::size_t end = above.find_last_of(".[");
    above.resize(end == std::string::npos ? 0 : end);
  }
  return {source.path, 0, key};
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
  input.source.path = path;
  collect_lines(root, "", input.source.lines);
  input = read_section("", document.top(), Kinds{}, std::move(input));
  read_kind(document, input);
  const Kinds kind = kinds_of(input);
  input.source.unused = find_unused(root, input);
  input.body = read_body(document.table("body"), input.body, kind);
  const auto each = [&](const char* name, auto reader, const auto& known) {
    return document.list(name,
                         [&](const CaseTable& table, std::size_t) { return reader(table, known); });
  };
  const auto prescribed = [&](const char* name) {
    return document.list(name, [&](const CaseTable& table, std::size_t) {
      return read_displacement(table, name, kind);
    });
  };
  document.need("regions");
  input.regions = each("regions", read_region, dimension_of(kind));
  document.need("materials");
  input.materials = document.list("materials", [&input](const CaseTable& table, std::size_t index) {
    return read_material(table, input, index);
  });
  input.supports = each("supports", read_support, input);
  input.displacements = prescribed("displacements");
  input.velocities = prescribed("velocities");
  input.loads = each("loads", read_load, kind);
  input.tractions = each("tractions", read_traction, kind);
  input.point_loads = each("point_loads", read_point_load, kind);
  input.symmetry = document.list("symmetry", [&](const CaseTable& table, std::size_t) {
    return read_section<SymmetrySection>("symmetry", table, kind);
  });
  input.springs = each("springs", read_springs, kind);
  input.cracks = each("cracks", read_crack, kind);
  input.interfaces = each("interfaces", read_interface, kind);
  input.fields = {each("random", read_random, kind), each("graded", read_graded, kind)};
  input.rebar = each("rebar", read_rebar, kind);
  input.gauges = each("gauges", read_gauge, kind);
  input.elements = read_elements(document.table("elements"), kind);
  input.analysis = read_analysis(document.table("analysis"), kind);
  for (std::string& key : unused_fields(input)) input.source.unused.push_back(std::move(key));
  input.stop = read_stop(document.table("stop"), kind);
  input.stages = each("stages", read_stage, kind);
  input.output = read_section<OutputSection>("output", document.table("output"), kind);
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
