#include "io/text/toml_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/text/toml_guard.hpp"

namespace perilink {
namespace {

class BrokenAssumption {};

/// A separate function: a throw in the assertions of noexcept functions would give a warning at
/// each.
[[noreturn]] void break_assumption() { throw BrokenAssumption(); }

}  // namespace
}  // namespace perilink

// Some malformed documents (`[= 1]`) violate assertions of toml++ 3.3. With NDEBUG this would be
// undefined behaviour. Here failed assertions end the parse in every build.
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : perilink::break_assumption())
#include <toml++/toml.h>

namespace perilink {
namespace {

int line_of(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

TomlValue convert(const toml::node& node, int line);

/// Converts the entries in the file's order, for the order of messages; toml++ sorts them by key.
void convert_entries(const toml::table& table, TomlValue& result) {
  struct Entry {
    toml::source_position position;
    const toml::key* key;
    const toml::node* node;
  };
  std::vector<Entry> order;
  for (const auto& [key, node] : table) order.push_back({key.source().begin, &key, &node});
  std::stable_sort(order.begin(), order.end(),
                   [](const Entry& a, const Entry& b) { return a.position < b.position; });
  for (const Entry& entry : order) {
    const int line = static_cast<int>(entry.position.line);
    result.entries.push_back(convert(*entry.node, line));
    result.entries.back().key = entry.key->str();
  }
}

TomlValue convert(const toml::node& node, int line) {
  using Kind = TomlValue::Kind;
  TomlValue result;
  result.line = line;
  if (const auto* table = node.as_table()) {
    result.kind = Kind::table;
    convert_entries(*table, result);
  } else if (const auto* array = node.as_array()) {
    result.kind = Kind::array;
    for (const toml::node& item : *array)
      result.items.push_back(convert(item, line_of(item.source())));
  } else if (const auto* text = node.as_string()) {
    result.kind = Kind::text;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = Kind::integer;
    result.integer = integer->get();
    result.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = Kind::number;
    result.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = Kind::boolean;
    result.boolean = boolean->get();
  } else {
    result.kind = Kind::date;
  }
  return result;
}

/// Returns the number of bytes of a UTF-8 character that begins with `lead`; 0 for an invalid byte.
std::size_t utf8_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

/// Whether TOML forbids the character, even within comments. In release builds toml++ has undefined
/// behaviour for some of them.
bool is_forbidden(unsigned char c) {
  return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F;
}

/// Returns the line of the first byte that is not UTF-8 text, or 0. The parser's own message does
/// not name the line.
int line_without_text(const std::string& text) {
  int line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    line += lead == '\n';
    const std::size_t length = utf8_length(lead);
    if (length == 0 || i + length > text.size() || is_forbidden(lead)) return line;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0U) != 0x80U) return line;
    }
    i += length;
  }
  return 0;
}

}  // namespace

const TomlValue* TomlValue::find(const std::string& name) const {
  for (const TomlValue& value : entries) {
    if (value.key == name) return &value;
  }
  return nullptr;
}

TomlValue parse_toml(const std::string& text, const std::string& path) {
  if (const int line = line_without_text(text); line > 0) {
    throw InputError({path, line, ""}, "the line holds bytes that are not UTF-8 text",
                     "name the .toml file of a case, saved as UTF-8");
  }
  const std::string safe = guard_toml(text, path);
  try {
    const toml::table document = toml::parse(std::string_view(safe), std::string_view(path));
    return convert(document, 1);
  } catch (const toml::parse_error& error) {
    const bool is_bracket = error.description().find("'=', saw '['") != std::string_view::npos;
    throw InputError({path, line_of(error.source()), ""},
                     fmt::format("is not valid TOML: {}", error.description()),
                     is_bracket ? "put a key with brackets between quotes: "
                                  "\"materials[1].tensile_strength\" = [2, 3]"
                                : "docs/case_file.md shows how a case is written; text stands "
                                  "between quotes");
  } catch (const BrokenAssumption&) {
    throw InputError({path, 0, ""}, "is not valid TOML",
                     "docs/case_file.md shows how a case is written; look for a misplaced bracket");
  }
}

std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size();) {
    if (i >= longest) return result + "...\"";
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = std::max<std::size_t>(1, utf8_length(lead));
    if (lead < 0x20 || lead == 0x7F) {
      result += fmt::format("\\x{:02x}", lead);
    } else {
      result += printable(text.substr(i, length));
    }
    i += length;
  }
  return result + "\"";
}

std::string toml_text(const TomlValue& value) {
  using Kind = TomlValue::Kind;
  const auto in_quotes = [](const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') result += '\\';
      const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
      result += control ? fmt::format("\\u{:04x}", static_cast<int>(c)) : std::string(1, c);
    }
    return result + "\"";
  };
  std::string list;
  switch (value.kind) {
    case Kind::boolean: return value.boolean ? "true" : "false";
    case Kind::integer: return fmt::format("{}", value.integer);
    case Kind::number: {
      const std::string digits = fmt::format("{}", value.number);
      return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
    }
    case Kind::text: return in_quotes(value.text);
    case Kind::date: return "";
    case Kind::array:
      for (const TomlValue& item : value.items)
        list += (list.empty() ? "" : ", ") + toml_text(item);
      return "[" + list + "]";
    case Kind::table: break;
  }
  for (const TomlValue& entry : value.entries) {
    list += (list.empty() ? "" : ", ") + in_quotes(entry.key) + " = " + toml_text(entry);
  }
  return "{" + list + "}";
}

std::string describe(const TomlValue& value) {
  using Kind = TomlValue::Kind;
  switch (value.kind) {
    case Kind::boolean: return value.boolean ? "the boolean true" : "the boolean false";
    case Kind::integer: return fmt::format("the integer {}", value.integer);
    case Kind::number: return fmt::format("the number {}", value.number);
    case Kind::text: return fmt::format("the text {}", quoted(value.text));
    case Kind::date: return "a date or time";
    case Kind::array: return "an array of " + counted(value.items.size(), "value");
    case Kind::table: break;
  }
  return "a table";
}

}  // namespace perilink
