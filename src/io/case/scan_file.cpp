#include "io/case/scan_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_table.hpp"
#include "io/text/input_text.hpp"

namespace perilink {
namespace {

constexpr std::size_t most_members = 9999;

/// Largest seed of a list, and the distance between seeds of tables whose seeds differ.
constexpr int most_seed = 999'999;

/// Collects keys and values of a table. Tables in it are parts of keys: `body.spacing = 1` is the
/// key "body.spacing".
void collect(const TomlValue& table, const std::string& above, std::vector<CaseSetting>& found) {
  for (const TomlValue& entry : table.entries) {
    const std::string key = above.empty() ? entry.key : above + "." + entry.key;
    if (entry.kind == TomlValue::Kind::table) {
      collect(entry, key, found);
    } else {
      found.push_back({key, entry});
    }
  }
}

/// \param where  table of the scan file
std::vector<CaseSetting> settings_of(const TomlValue& table, const SourceLocation& where) {
  std::vector<CaseSetting> settings;
  collect(table, "", settings);
  if (settings.empty()) {
    throw InputError(where, "has no key", "name keys of the case: \"body.spacing\" = ...");
  }
  return settings;
}

void refuse_many(const ScanFile& scan, std::size_t members, const SourceLocation& where) {
  if (members <= most_members) return;
  throw InputError({scan.path, where.line, where.key},
                   fmt::format("gives more than {} members", most_members), "give fewer values");
}

/// Multiplies the members with the values of a key; the last key varies fastest.
void multiply(ScanFile& scan, const CaseSetting& list, const SourceLocation& where) {
  if (list.value.kind != TomlValue::Kind::array) {
    throw InputError(
        where, fmt::format("is {}, but must be a list of values", describe(list.value)),
        fmt::format("write the values between brackets: [{}, ...]", toml_text(list.value)));
  }
  if (list.value.items.empty()) throw InputError(where, "is empty", "give at least one value");
  std::set<std::string> texts;
  for (const TomlValue& value : list.value.items) {
    if (texts.insert(toml_text(value)).second) continue;
    throw InputError(where, fmt::format("holds {} twice", toml_text(value)),
                     "give every value once");
  }
  refuse_many(scan, scan.members.size() * list.value.items.size(), where);
  std::vector<ScanMember> product;
  for (const ScanMember& member : scan.members) {
    for (const TomlValue& value : list.value.items) {
      product.push_back(member);
      product.back().settings.push_back({list.key, value});
      product.back().settings.back().value.line = where.line;
    }
  }
  scan.members = std::move(product);
}

void read_grid(ScanFile& scan, const TomlValue& values) {
  scan.members = {{{}, values.line}};
  for (const CaseSetting& list : settings_of(values, {scan.path, values.line, "values"})) {
    scan.keys.push_back(list.key);
    multiply(scan, list, {scan.path, list.value.line, "values." + list.key});
  }
}

void read_runs(ScanFile& scan, const TomlValue& runs) {
  if (runs.items.empty()) {
    throw InputError({scan.path, runs.line, "runs"}, "is empty", "give at least one [[runs]]");
  }
  refuse_many(scan, runs.items.size(), {scan.path, runs.line, "runs"});
  for (std::size_t k = 0; k < runs.items.size(); ++k) {
    const TomlValue& run = runs.items[k];
    scan.members.push_back(
        {settings_of(run, {scan.path, run.line, fmt::format("runs[{}]", k + 1)}), run.line});
    for (const CaseSetting& setting : scan.members.back().settings) {
      if (std::find(scan.keys.begin(), scan.keys.end(), setting.key) != scan.keys.end()) continue;
      scan.keys.push_back(setting.key);
    }
  }
}

/// Reads `seeds`: their number, or a list.
void read_seeds(ScanFile& scan, const CaseTable& top, const TomlValue& root) {
  const TomlValue* value = root.find("seeds");
  if (value == nullptr) return;
  scan.seeds_line = value->line;
  if (value->kind == TomlValue::Kind::array) {
    assign(scan.seeds, top.integers("seeds", 0, most_seed));
  } else if (const auto count = top.integer("seeds", 1, static_cast<int>(most_members))) {
    scan.seeds.resize(static_cast<std::size_t>(*count));
    std::iota(scan.seeds.begin(), scan.seeds.end(), 1);
  }
  if (scan.seeds.empty()) {
    top.refuse("seeds", "is empty", "give the number of samples, seeds = 20, or a list of seeds");
  }
  if (std::set<int>(scan.seeds.begin(), scan.seeds.end()).size() < scan.seeds.size()) {
    top.refuse("seeds", "holds a seed twice", "give every seed once");
  }
}

constexpr const char* body_seed = "body.seed";

std::string seed_key(std::size_t table) { return fmt::format("random[{}].seed", table + 1); }

/// Refuses cases, studies and unknown tables. Keys of [values] and [[runs]] are those of the case,
/// which are checked with it.
void check_tables(const TomlValue& root, const std::string& path) {
  for (const auto& [key, of, command] :
       {std::array{"body", "case", "run"}, std::array{"vary", "study", "converge"}}) {
    const TomlValue* found = root.find(key);
    if (found == nullptr) continue;
    throw InputError({path, found->line, key},
                     fmt::format("belongs to a {}, but this command needs a scan", of),
                     fmt::format("run the {} by `perilink {} {}`", of, command, path));
  }
  const std::vector<TableSchema> schema = {
      {"", false, {"title", "case", "seeds"}}, {"values", false, {}}, {"runs", true, {}}};
  TomlValue without_keys = root;
  for (TomlValue& table : without_keys.entries) {
    table.entries.clear();
    for (TomlValue& item : table.items) item.entries.clear();
  }
  check_against_schema(without_keys, path, schema, "scan");
}

}  // namespace

const TomlValue* ScanMember::find(const std::string& key) const {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const CaseSetting& setting) { return setting.key == key; });
  return found == settings.end() ? nullptr : &found->value;
}

ScanFile parse_scan(const std::string& text, const std::string& path) {
  refuse_large_input(text, path);
  const TomlValue root = parse_toml(text, path);
  check_tables(root, path);
  ScanFile scan;
  scan.path = path;
  const CaseTable top(root, "", path);
  assign(scan.title, top.text("title"));
  scan.case_path = beside(path, top.need("case", top.path("case"),
                                         "the case file, relative to the scan: case = \"a.toml\""));
  read_seeds(scan, top, root);
  const TomlValue *values = root.find("values"), *runs = root.find("runs");
  if (values == nullptr && runs == nullptr && !scan.seeds.empty()) {
    scan.members = {{{}, scan.seeds_line}};
    return scan;
  }
  if ((values == nullptr) == (runs == nullptr)) {
    throw InputError({path, runs == nullptr ? 0 : runs->line, ""},
                     runs == nullptr ? "the scan has neither [values] nor [[runs]]"
                                     : "the scan has both [values] and [[runs]]",
                     "give lists of values that form a grid: [values] and \"body.spacing\" = "
                     "[1, 2]; or sets of values: [[runs]] and \"body.spacing\" = 1 below each");
  }
  if (values != nullptr) {
    read_grid(scan, *values);
  } else {
    read_runs(scan, *runs);
  }
  return scan;
}

namespace {

/// Returns the keys that are seeds in a member of the scan, with their values in the case.
std::vector<std::pair<std::string, std::int64_t>> seeds_of(const TomlValue& document,
                                                           const ScanMember& member) {
  std::vector<std::pair<std::string, std::int64_t>> seeds;
  const auto add = [&](const std::string& key, const TomlValue& table) {
    const TomlValue* seed = table.find("seed");
    seeds.emplace_back(key, seed == nullptr ? 1 : seed->integer);
  };
  if (const TomlValue* random = document.find("random")) {
    for (std::size_t k = 0; k < random->items.size(); ++k) add(seed_key(k), random->items[k]);
  }
  const TomlValue* body = document.find("body");
  const TomlValue* pattern = member.find("body.pattern");
  if (pattern == nullptr && body != nullptr) pattern = body->find("pattern");
  const bool is_unstructured = pattern != nullptr && pattern->text == word_of(Pattern::irregular);
  if (body != nullptr && is_unstructured) add(body_seed, *body);
  return seeds;
}

}  // namespace

void give_seeds(ScanFile& scan, const TomlValue& document) {
  if (scan.seeds.empty()) return;
  const auto given =
      std::ranges::find_if(scan.keys, [&](const std::string& key) { return is_seed(scan, key); });
  if (given != scan.keys.end()) {
    throw InputError({scan.path, scan.seeds_line, "seeds"},
                     fmt::format("is given together with {}", quoted(*given)),
                     "delete one of the two");
  }
  refuse_many(scan, scan.members.size() * scan.seeds.size(), {scan.path, scan.seeds_line, "seeds"});
  std::vector<ScanMember> product;
  std::string first_key;
  for (const ScanMember& member : scan.members) {
    const auto own = seeds_of(document, member);
    if (own.empty()) {
      throw InputError(
          {scan.path, scan.seeds_line, "seeds"},
          fmt::format("is given, but {}{}{} has no [[random]] and no unstructured particles",
                      scan.case_path, member.settings.empty() ? "" : " with ",
                      member_text(member.settings)),
          "add [[random]] to the case, set pattern = \"unstructured\" in its [body], or "
          "delete the line");
    }
    first_key = own.front().first;
    std::vector<std::int64_t> different;  // seeds of the case, and for each key its number in them
    std::vector<int> number;
    for (const auto& [key, seed] : own) {
      const auto found = std::find(different.begin(), different.end(), seed);
      number.push_back(static_cast<int>(found - different.begin()));
      if (found == different.end()) different.push_back(seed);
    }
    for (const int seed : scan.seeds) {
      product.push_back(member);
      for (std::size_t k = 0; k < number.size(); ++k) {
        TomlValue value;
        value.kind = TomlValue::Kind::integer;
        value.line = scan.seeds_line;
        value.integer = seed + number[k] * (most_seed + 1);
        value.number = static_cast<double>(value.integer);
        product.back().settings.push_back({own[k].first, value});
      }
    }
  }
  scan.members = std::move(product);
  scan.keys.push_back(first_key);
}

bool is_seed(const ScanFile& scan, const std::string& key) {
  if (scan.seeds.empty()) return false;
  return key == body_seed || (key.starts_with("random[") && key.ends_with("].seed"));
}

ScanFile read_scan_file(const std::string& path) { return parse_scan(read_input_text(path), path); }

std::string value_text(const TomlValue& value) {
  if (value.kind == TomlValue::Kind::number) return fmt::format("{}", value.number);
  return value.kind == TomlValue::Kind::text ? value.text : toml_text(value);
}

std::string member_text(std::span<const CaseSetting> settings) {
  std::string text;
  for (const CaseSetting& setting : settings) {
    text +=
        fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.key, value_text(setting.value));
  }
  return text;
}

}  // namespace perilink
