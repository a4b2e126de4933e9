#include "app/report/report_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/plot/plot_axes.hpp"
#include "app/plot/plot_labels.hpp"
#include "base/plain_text.hpp"

namespace perilink {
namespace {

using Kind = TomlValue::Kind;

std::string text_of(const TomlValue& value) {
  switch (value.kind) {
    case Kind::boolean: return value.boolean ? "yes" : "no";
    case Kind::integer: return std::to_string(value.integer);
    case Kind::number: return fmt::format("{}", value.number);
    case Kind::array: {
      std::string list;
      for (const TomlValue& item : value.items) {
        const std::string text = text_of(item);
        list += (list.empty() ? "" : ", ") + (item.kind == Kind::array ? "(" + text + ")" : text);
      }
      return list.empty() ? "none" : list;
    }
    case Kind::table: {
      std::string list;
      for (const TomlValue& entry : value.entries) {
        list += (list.empty() ? "" : ", ") + in_words(printable(entry.key)) + " " + text_of(entry);
      }
      return list;
    }
    default: return printable(value.text);
  }
}

bool holds_numbers(const TomlValue& value) {
  if (value.kind == Kind::array) return !value.items.empty() && holds_numbers(value.items.front());
  return value.kind == Kind::integer || value.kind == Kind::number;
}

/// Returns "youngs modulus 30000 N/mm²". Coordinates and prescribed displacements are lengths.
std::string phrase_of(const TomlValue& value, const std::string& table, const UnitNames& units) {
  const bool axis = value.key == "x" || value.key == "y" || value.key == "z";
  const bool placed = table == "regions" || table == "displacements" || table == "velocities";
  std::string unit;
  if (axis && placed) {
    unit = unit_of_quantity(table == "velocities" ? "velocity" : "displacement", units);
  } else if (value.key == "at") {
    unit = units.length;
  } else {
    unit = unit_of_quantity(value.key, units);
  }
  return fmt::format("{} {}", in_words(value.key),
                     in_unit(text_of(value), holds_numbers(value) ? unit : ""));
}

bool names_entry(const std::string& key) {
  return key == "name" || key == "region" || key == "regions";
}

/// Returns the name of an entry of a list of tables and its other keys.
std::pair<std::string, std::string> entry_of(const TomlValue& entry, const std::string& table,
                                             std::size_t number, const UnitNames& units) {
  const TomlValue* name = entry.find("name");
  if (name == nullptr) name = entry.find("region");
  if (name == nullptr) name = entry.find("regions");
  std::string text;
  for (const TomlValue& value : entry.entries) {
    if (name != nullptr && value.key == name->key) continue;
    const std::string phrase = names_entry(value.key) ? in_words(value.key) + ": " + text_of(value)
                                                      : phrase_of(value, table, units);
    text += (text.empty() ? "" : "; ") + phrase;
  }
  return {name != nullptr ? text_of(*name) : std::to_string(number), text};
}

std::string heading_of(const std::string& key) {
  std::string heading = in_words(printable(key));
  if (!heading.empty() && heading[0] >= 'a' && heading[0] <= 'z') heading[0] += 'A' - 'a';
  return heading;
}

double number_in(const nlohmann::ordered_json& summary, const char* key) {
  const auto found = summary.find(key);
  const bool known = found != summary.end() && found->is_number();
  return known ? found->get<double>() : std::nan("");
}

std::string text_in(const nlohmann::ordered_json& summary, const char* key) {
  const auto found = summary.find(key);
  const bool known = found != summary.end() && found->is_string();
  return known ? printable(found->get<std::string>()) : "";
}

std::string body_key(const TomlValue& root, const char* key) {
  const TomlValue* body = root.find("body");
  const TomlValue* value = body == nullptr ? nullptr : body->find(key);
  return value == nullptr ? "" : text_of(*value);
}

/// Writes numbers of a summary with their units.
struct Figures {
  const nlohmann::ordered_json& summary;
  const UnitNames& units;

  bool has(const char* key) const { return !std::isnan(number_in(summary, key)); }
  std::string operator()(const char* key) const {
    return in_unit(short_number(number_in(summary, key)), unit_of_quantity(key, units));
  }
  std::string count(const char* key, const char* noun) const {
    return counted(static_cast<std::int64_t>(number_in(summary, key)), noun);
  }
};

std::string sentence_of_body(const Figures& figure, const TomlValue& root) {
  const std::string problem = body_key(root, "problem"), model = text_in(figure.summary, "model");
  std::string text = "The body";
  if (!problem.empty()) {
    text += fmt::format(" ({}{})", in_words(problem), model.empty() ? "" : ", " + in_words(model));
  }
  if (!figure.has("particles")) return problem.empty() ? "" : text + " is given below.";
  text += " has " + figure.count("particles", "particle");
  if (figure.has("spacing")) text += ", " + figure("spacing") + " apart";
  if (number_in(figure.summary, "bonds") > 0.0) text += ", and " + figure.count("bonds", "bond");
  if (number_in(figure.summary, "horizon") > 0.0) {
    text += " within a horizon of " + figure("horizon");
  }
  const std::string thickness = body_key(root, "thickness");
  if (!thickness.empty()) {
    text += "; its thickness is " + in_unit(thickness, figure.units.length);
  }
  return text + ".";
}

std::string sentence_of_peak(const Figures& figure) {
  if (!figure.has("peak_load") || !figure.has("peak_displacement")) return "";
  std::string text = fmt::format("Peak load {} at displacement {}", figure("peak_load"),
                                 figure("peak_displacement"));
  if (figure.has("smoothed_peak_load")) {
    text += fmt::format(" (smoothed peak load {})", figure("smoothed_peak_load"));
  }
  return text + ".";
}

std::string sentence_of_energy(const Figures& figure) {
  if (!figure.has("dissipated_energy")) return "";
  std::string text = "Dissipated energy " + figure("dissipated_energy");
  if (figure.has("broken_bonds")) {
    text += "; " + figure.count("broken_bonds", "broken bond");
  }
  if (!figure.has("energy_error")) return text + ".";
  return fmt::format("{}; largest energy error {} of the work.", text, figure("energy_error"));
}

}  // namespace

std::vector<WordedTable> tables_of_case(const TomlValue& root, const UnitNames& units) {
  std::vector<WordedTable> tables;
  for (const TomlValue& value : root.entries) {
    WordedTable table{heading_of(value.key), {}};
    if (value.kind == Kind::table) {
      for (const TomlValue& entry : value.entries) {
        const std::string unit = holds_numbers(entry) ? unit_of_quantity(entry.key, units) : "";
        table.entries.emplace_back(in_words(printable(entry.key)), in_unit(text_of(entry), unit));
      }
    } else if (value.kind == Kind::array) {
      for (const TomlValue& entry : value.items) {
        table.entries.push_back(entry_of(entry, value.key, table.entries.size() + 1, units));
      }
    }
    if (!table.entries.empty()) tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<std::string> sentences_of_run(const nlohmann::ordered_json& summary,
                                          const TomlValue& root, const UnitNames& units) {
  const Figures figure{summary, units};
  std::vector<std::string> sentences;
  const auto add = [&](std::string sentence) {
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
  };
  const std::string analysis = text_in(summary, "analysis"), status = text_in(summary, "status"),
                    reason = text_in(summary, "reason");
  if (!analysis.empty()) add(heading_of(analysis) + " analysis.");
  add(sentence_of_body(figure, root));
  if (!status.empty()) {
    add(fmt::format("Status: {}{}.", status, reason.empty() ? "" : " (" + reason + ")"));
  }
  add(sentence_of_peak(figure));
  add(sentence_of_energy(figure));
  return sentences;
}

}  // namespace perilink
