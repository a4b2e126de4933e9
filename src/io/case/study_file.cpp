#include "io/case/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include "base/plain_text.hpp"
#include "io/case/case_overrides.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_table.hpp"
#include "io/case/case_words.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

constexpr int most_repeats = 1000;
constexpr int most_study_columns = 100000;

/// Returns the schema with `error` as one table or a list of tables.
std::vector<TableSchema> study_schema(bool several_errors) {
  return {
      {"", false, {"title", "case", "repeats"}},
      {"vary",
       false,
       {"spacing", "columns", "mesh", "mesh_size", "horizon_ratio", "surface", "method"}},
      {"error",
       several_errors,
       {"name", "displacement", "rigid_motion", "gauge", "quantity", "reference"}},
  };
}

/// Returns the path from a folder to a file, independent of the working directory.
std::string path_from(const std::string& directory, const std::string& file) {
  const fs::path base = fs::absolute(directory.empty() ? "." : directory);
  return fs::proximate(fs::absolute(file), base).lexically_normal().string();
}

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }

/// Refuses a list that is empty or holds a value twice.
template <class T>
std::vector<T> distinct(const CaseTable& table, const std::string& key, std::vector<T> values) {
  if (values.empty()) table.refuse(key, "is empty", "give at least one value, or delete the key");
  std::vector<T> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    table.refuse(key, fmt::format("holds {} twice", *twice), "give every value once");
  }
  return values;
}

std::vector<double> positive_list(const CaseTable& table, const std::string& key) {
  std::vector<double> values = distinct(table, key, *table.numbers(key));
  for (const double value : values) {
    if (value > 0.0) continue;
    table.refuse(key, fmt::format("holds {}, but the values must be greater than zero", value),
                 "give positive numbers");
  }
  return values;
}

template <class Enumeration>
std::vector<Enumeration> choices(const CaseTable& table, const std::string& key) {
  std::vector<Enumeration> result;
  if (!table.has(key)) return result;
  constexpr auto words = words_of(Enumeration{});
  for (const std::string& word : distinct(table, key, *table.texts(key))) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
      table.refuse(key,
                   fmt::format("holds {}, which is not one of the choices", perilink::quoted(word)),
                   suggest(word, {words.begin(), words.end()}));
    }
    result.push_back(static_cast<Enumeration>(found - words.begin()));
  }
  return result;
}

void read_refinement(const CaseTable& table, VarySection& vary, const StudyFile& study) {
  constexpr auto words = words_of(Refinement{});
  table.need_one_of({words.begin(), words.end()});
  const auto given = std::find_if(words.begin(), words.end(), [&](std::string_view word) {
    return table.has(std::string(word));
  });
  vary.refinement = static_cast<Refinement>(given - words.begin());
  const std::string key(*given);
  vary.where = {study.path, table.value(key)->line, "vary." + key};
  if (vary.refinement == Refinement::columns) {
    for (const int value : distinct(table, key, *table.integers(key, 2, most_study_columns))) {
      vary.values.push_back(body_key(key, value));
    }
  } else if (vary.refinement == Refinement::mesh) {
    for (const std::string& mesh : distinct(table, key, *table.texts(key))) {
      // Relative to the folder of the case, as in the case file.
      vary.values.push_back(
          body_key(key, path_from(folder_of(study.case_path), beside(study.path, mesh))));
    }
  } else {
    for (const double value : positive_list(table, key))
      vary.values.push_back(body_key(key, value));
  }
  if (vary.values.size() < 2) {
    table.refuse(key, "holds one value, but an order of convergence needs at least two",
                 "give at least two values");
  }
}

VarySection read_vary(const CaseTable& table, const StudyFile& study) {
  VarySection vary;
  read_refinement(table, vary, study);
  if (table.has("horizon_ratio")) {
    vary.horizon_ratio = positive_list(table, "horizon_ratio");
    for (const double ratio : vary.horizon_ratio) {
      if (ratio >= 1.0) continue;
      table.refuse("horizon_ratio",
                   fmt::format("holds {}, less than 1: no particle would have a neighbour", ratio),
                   "2 to 4 is usual");
    }
  }
  vary.surface = choices<Surface>(table, "surface");
  vary.method = choices<BodyMethod>(table, "method");
  return vary;
}

void read_reference(const CaseTable& table, ErrorSection& error, std::size_t members) {
  const TomlValue* value = table.value("reference");
  if (value == nullptr) {
    table.refuse_missing("reference",
                         "what the value is compared with: a number, \"finest\" or "
                         "\"extrapolated\"");
  }
  if (value->kind != TomlValue::Kind::text) {
    error.reference_value = *table.number("reference");
    if (error.reference_value != 0.0) return;
    table.refuse("reference", "is zero, and errors are relative to it",
                 "measure a quantity that does not vanish");
  }
  error.reference = *table.choice<Reference>("reference");
  if (error.reference == Reference::extrapolated && members < 3) {
    table.refuse("reference",
                 "is \"extrapolated\", but [vary] has " + counted(members, "refinement"),
                 "extrapolation needs three; add one, or write \"finest\"");
  }
}

/// The number of formulas is checked later against the dimensions of the case.
std::vector<Expression> read_field(const CaseTable& table) {
  const std::size_t count = table.value("displacement")->items.size();
  if (table.value("displacement")->kind == TomlValue::Kind::array && count != 2 && count != 3) {
    table.refuse("displacement", "has " + counted(count, "formula"),
                 "give one for each axis: [\"formula x\", \"formula y\"]");
  }
  const int dim = static_cast<int>(count);
  const ExpressionVector formulas = *table.expressions("displacement", dim, dim);
  return {formulas.begin(), formulas.begin() + dim};
}

ErrorSection read_error(const CaseTable& table, std::size_t members, SourceLocation where) {
  ErrorSection error;
  error.where = std::move(where);
  table.need_one_of({"displacement", "gauge", "quantity"});
  if (table.has("displacement")) error.displacement = read_field(table);
  assign(error.gauge, table.text("gauge"));
  if (table.has("gauge") && error.gauge.empty()) {
    table.refuse("gauge", "is empty", "name one of the case's [[gauges]]");
  }
  error.quantity = table.choice<Quantity>("quantity");
  if (table.has("displacement")) {
    if (table.has("reference")) {
      table.refuse("reference", "is given, but `displacement` is the reference itself",
                   "delete it");
    }
    assign(error.rigid_motion, table.choice<RigidMotion>("rigid_motion"));
  } else {
    if (table.has("rigid_motion")) {
      table.refuse("rigid_motion", "is given, but only a displacement field has one", "delete it");
    }
    read_reference(table, error, members);
  }
  error.name = !error.gauge.empty() ? error.gauge
               : error.quantity     ? std::string(word_of(*error.quantity))
                                    : "displacement";
  assign(error.name, table.text("name"));
  if (error.name.empty()) table.refuse("name", "is empty", "name the error, or delete the key");
  return error;
}

std::vector<ErrorSection> read_errors(const TomlValue& root, const std::string& path,
                                      std::size_t members) {
  const TomlValue* given = root.find("error");
  const bool several = given != nullptr && given->kind == TomlValue::Kind::array;
  if (given == nullptr || (several && given->items.empty())) {
    throw InputError({path, 0, ""}, "the study has no [error]",
                     "say what is measured; docs/studies.md describes studies");
  }
  std::vector<ErrorSection> errors;
  std::set<std::string> names;
  for (std::size_t i = 0; i < (several ? given->items.size() : 1); ++i) {
    const TomlValue& value = several ? given->items[i] : *given;
    const std::string key = several ? fmt::format("error[{}]", i + 1) : "error";
    const CaseTable table(value, key, path);
    errors.push_back(read_error(table, members, {path, value.line, key}));
    if (names.insert(errors.back().name).second) continue;
    table.refuse(
        "name",
        fmt::format("is {}, the name of another error", perilink::quoted(errors.back().name)),
        "give every error a different `name`");
  }
  return errors;
}

void write_error(TomlWriter& out, const ErrorSection& error, bool several) {
  out.header(several ? "[[error]]" : "[error]");
  out.write("name", error.name);
  if (error.is_field()) {
    out.write("displacement", error.displacement);
    out.write("rigid_motion", word_of(error.rigid_motion));
    return;
  }
  if (!error.gauge.empty()) out.write("gauge", error.gauge);
  if (error.quantity) out.write("quantity", word_of(*error.quantity));
  if (error.reference == Reference::number) {
    out.write("reference", error.reference_value);
  } else {
    out.write("reference", word_of(error.reference));
  }
}

void write_refinement(TomlWriter& out, const StudyFile& study, const std::string& directory) {
  const VarySection& vary = study.vary;
  const std::string_view key = word_of(vary.refinement);
  if (vary.refinement == Refinement::mesh) {
    std::vector<std::string> meshes;
    for (const TomlValue& value : vary.values) {
      meshes.push_back(path_from(directory, beside(study.case_path, value.text)));
    }
    out.write(key, meshes);
  } else {
    std::vector<double> numbers;
    for (const TomlValue& value : vary.values) numbers.push_back(value.number);
    out.write(key, numbers);
  }
}

template <class Enumeration>
void write_words(TomlWriter& out, const char* key, const std::vector<Enumeration>& values) {
  if (values.empty()) return;
  std::vector<std::string> list;
  for (const Enumeration value : values) list.emplace_back(word_of(value));
  out.write(key, list);
}

}  // namespace

StudyFile parse_study(const std::string& text, const std::string& path) {
  refuse_large_input(text, path);
  const TomlValue root = parse_toml(text, path);
  const TomlValue* errors = root.find("error");
  const bool several = errors != nullptr && errors->kind == TomlValue::Kind::array;
  if (const TomlValue* body = root.find("body")) {
    throw InputError({path, body->line, "body"},
                     "belongs to a case, but this command needs a study",
                     fmt::format("run the case by `perilink run {}`", path));
  }
  check_against_schema(root, path, study_schema(several), "study");

  StudyFile study;
  study.path = path;
  const CaseTable top(root, "", path);
  assign(study.title, top.text("title"));
  study.case_path =
      beside(path, top.need("case", top.text("case"),
                            "the case file, relative to the study: case = \"a.toml\""));
  assign(study.repeats, top.integer("repeats", 1, most_repeats));
  const TomlValue* vary = root.find("vary");
  if (vary == nullptr) {
    throw InputError({path, 0, ""}, "the study has no [vary]",
                     "say what is refined: [vary] and spacing = [0.2, 0.1, 0.05]");
  }
  study.vary = read_vary(CaseTable(*vary, "vary", path), study);
  study.errors = read_errors(root, path, study.vary.values.size());
  return study;
}

StudyFile read_study_file(const std::string& path) {
  return parse_study(read_input_text(path), path);
}

std::string write_study(const StudyFile& study, const std::string& directory,
                        const std::string& case_path) {
  TomlWriter out;
  if (!study.title.empty()) out.write("title", study.title);
  out.write("case", path_from(directory, case_path));
  out.write("repeats", study.repeats);
  out.header("[vary]");
  write_refinement(out, study, directory);
  if (!study.vary.horizon_ratio.empty()) out.write("horizon_ratio", study.vary.horizon_ratio);
  write_words(out, "surface", study.vary.surface);
  write_words(out, "method", study.vary.method);
  for (const ErrorSection& error : study.errors) {
    write_error(out, error, study.errors.size() > 1);
  }
  return out.take();
}

}  // namespace perilink
