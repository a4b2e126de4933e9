#include "io/case/case_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/case_keys.hpp"
#include "io/case/case_overrides.hpp"
#include "io/text/input_text.hpp"

namespace perilink {
namespace {

constexpr const char* how_to_set =
    "write KEY=VALUE, for example body.spacing=0.5, 'materials[1].fracture_energy=0.1' or "
    "'title=\"A beam\"'";

[[noreturn]] void refuse_setting(const std::string& key, const std::string& fault,
                                 const std::string& suggestion) {
  throw InputError({"", from_option, key}, fault, suggestion);
}

/// Part of a key: a name, or the number of an entry of a list.
struct KeyPart {
  std::string name;
  std::size_t number = 0;  ///< from 1; 0: a name
};

/// Reads the parts of "materials[1].area", `regions."upper edge".y`.
class KeyReader {
 public:
  explicit KeyReader(const std::string& key) : key_(key) {}

  std::vector<KeyPart> run() {
    std::vector<KeyPart> parts;
    do {
      parts.push_back({name()});
      while (take('[')) parts.push_back({"", number()});
    } while (take('.'));
    if (at_ != key_.size()) fail();
    return parts;
  }

 private:
  [[noreturn]] void fail() const { refuse_setting(key_, "is not a key of a case", how_to_set); }
  bool take(char c) {
    if (at_ == key_.size() || key_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string until(std::string_view ends) {
    const std::size_t begin = at_;
    at_ = std::min(key_.find_first_of(ends, at_), key_.size());
    return key_.substr(begin, at_ - begin);
  }
  std::string name() {
    const bool in_quotes = take('"');
    std::string result = in_quotes ? until("\"") : std::string(trimmed(until(".[\"")));
    if (result.empty() || (in_quotes && !take('"'))) fail();
    return result;
  }
  std::size_t number() {
    const std::size_t begin = at_;
    const std::string digits = until("]");
    const bool good = !digits.empty() && digits.size() < 8 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
    if (!good || std::stoul(digits) == 0 || !take(']')) {
      const bool is_name = digits.find_first_not_of("0123456789.+- ") != std::string::npos;
      refuse_setting(key_, fmt::format("has {} between brackets", quoted(digits)),
                     is_name ? fmt::format("names stand after a dot: '{}.{}.KEY'; numbers in "
                                           "brackets: materials[1]",
                                           key_.substr(0, begin - 1), digits)
                             : "entries of lists have numbers from 1, as in materials[1]");
    }
    return std::stoul(digits);
  }

  const std::string& key_;
  std::size_t at_ = 0;
};

void mark_as_option(TomlValue& value) {
  value.line = from_option;
  for (TomlValue& item : value.items) mark_as_option(item);
  for (TomlValue& entry : value.entries) mark_as_option(entry);
}

std::string name_of_entry(const TomlValue& entry) {
  const TomlValue* name = entry.find("name");
  return name != nullptr && name->kind == TomlValue::Kind::text ? name->text : "";
}

/// Returns an entry of a list by number or name.
TomlValue& entry_of(TomlValue& list, const KeyPart& part, const std::string& key,
                    const std::string& list_key) {
  const std::size_t count = list.items.size();
  const std::string only = fmt::format("the only entry is {}[1]", list_key);
  if (part.number > 0) {
    if (part.number <= count) return list.items[part.number - 1];
    refuse_setting(key,
                   fmt::format("there is no {}[{}]: the list has {}", list_key, part.number,
                               counted(count, "entry", "entries")),
                   count == 0   ? "add it to the case"
                   : count == 1 ? only
                                : fmt::format("give a number from 1 to {}", count));
  }
  TomlValue* found = nullptr;
  std::vector<std::string> names;
  for (TomlValue& item : list.items) {
    names.push_back(name_of_entry(item));
    if (names.back() != part.name) continue;
    if (found != nullptr) {
      refuse_setting(key, fmt::format("several entries of {} are named {}", list_key, part.name),
                     fmt::format("give a number from 1 to {}: {}[1]", count, list_key));
    }
    found = &item;
  }
  if (found != nullptr) return *found;
  std::erase(names, "");
  const std::string fault = fmt::format("no entry of {} is named {}", list_key, quoted(part.name));
  if (count == 1) {
    refuse_setting(key, fault, only + (names.empty() ? "" : ", named " + quoted(names[0])));
  }
  const std::string by_number = fmt::format("give its number, from 1 to {}: {}[1]{}", count,
                                            list_key, names.empty() ? "" : ", or its name: ");
  refuse_setting(
      key, fault,
      by_number + (names.empty() ? "" : suggest(part.name, {names.begin(), names.end()})));
}

bool is_list_of_tables(const std::string& name) {
  const auto& schema = case_schema();
  return std::any_of(schema.begin(), schema.end(),
                     [&](const TableSchema& table) { return table.list && table.name == name; });
}

/// Returns a table or list in a table; an absent table is added.
TomlValue& child_of(TomlValue& table, const std::string& name, bool in_list,
                    const std::string& key) {
  if (TomlValue* found = table.find(name)) return *found;
  if (in_list || is_list_of_tables(name)) {
    refuse_setting(key, fmt::format("the case has no {}", name), "add it to the case");
  }
  table.entries.emplace_back().key = name;
  table.entries.back().line = from_option;
  return table.entries.back();
}

void apply_setting(TomlValue& document, const std::string& path, const CaseSetting& setting) {
  const std::string& key = setting.key;
  const std::vector<KeyPart> parts = KeyReader(key).run();
  TomlValue value = setting.value;
  mark_as_option(value);
  TomlValue* here = &document;
  std::string place;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const KeyPart& part = parts[k];
    const bool last = k + 1 == parts.size();
    if (here->kind == TomlValue::Kind::array) {
      here = &entry_of(*here, part, key, place);
    } else if (here->kind != TomlValue::Kind::table || part.number > 0) {
      refuse_setting(key, fmt::format("{} is {}", place, describe(*here)),
                     part.number > 0 ? "leave out the number between brackets"
                                     : fmt::format("set it as a whole: {}=VALUE", place));
    } else if (last) {
      value.key = part.name;
      return set_key(*here, std::move(value), {path, from_option, place});
    } else {
      here = &child_of(*here, part.name, parts[k + 1].number > 0, key);
    }
    place +=
        part.number > 0 ? fmt::format("[{}]", part.number) : (place.empty() ? "" : ".") + part.name;
  }
  value.key = here->key;
  *here = std::move(value);
}

}  // namespace

CaseSetting parse_setting(const std::string& text) {
  std::size_t equals = text.find('=');  // outside quotes: "a=b" may be the name of a region
  while (equals != text.npos && std::count(text.begin(), text.begin() + equals, '"') % 2 == 1) {
    equals = text.find('=', equals + 1);
  }
  CaseSetting setting{std::string(trimmed(text.substr(0, equals))), {}};
  if (setting.key.empty() || equals == text.npos) {
    refuse_setting(text, setting.key.empty() ? "has no key" : "has no value", how_to_set);
  }
  const std::string value(trimmed(std::string_view(text).substr(equals + 1)));
  if (value.empty()) refuse_setting(setting.key, "has nothing after =", how_to_set);
  try {
    setting.value = parse_toml("value = " + value, "").entries.at(0);
  } catch (const InputError&) {
    if (std::string_view("[{\"'").find(value.front()) != std::string_view::npos) {
      refuse_setting(setting.key, fmt::format("is {}, which is not TOML", value),
                     "write a number, text between quotes or a list [1, 2]; single quotes around "
                     "KEY=VALUE keep the shell from changing it");
    }
    setting.value.kind = TomlValue::Kind::text;
    setting.value.text = value;
  }
  return setting;
}

std::vector<CaseSetting> parse_settings(const std::vector<std::string>& texts) {
  std::vector<CaseSetting> settings;
  for (const std::string& text : texts) settings.push_back(parse_setting(text));
  return settings;
}

std::string setting_text(const CaseSetting& setting) {
  return setting.key + "=" + toml_text(setting.value);
}

void apply_settings(TomlValue& document, const std::string& path,
                    const std::vector<CaseSetting>& settings) {
  for (const CaseSetting& setting : settings) apply_setting(document, path, setting);
}

}  // namespace perilink
