#include "io/mesh/abaqus_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "io/mesh/mesh_listing.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

/// Returns the entries between commas outside of quotes; a last comma ends the line.
std::vector<std::string_view> entries_of(std::string_view line) {
  std::vector<std::string_view> entries;
  while (!line.empty()) {
    std::size_t comma = 0;
    for (bool in_quotes = false; comma < line.size(); ++comma) {
      if (line[comma] == ',' && !in_quotes) break;
      in_quotes ^= line[comma] == '"';
    }
    entries.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
  return entries;
}

std::string without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

template <class Value>
bool parse(std::string_view text, Value& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::string AbaqusKeyword::value(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  return found != parameters.end() ? found->second : std::string();
}

std::optional<std::string_view> AbaqusLines::peek() {
  while (!peeked_ && !rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    next_ = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    peeked_ = !next_.empty() && !next_.starts_with("**");
  }
  return peeked_ ? std::optional(next_) : std::nullopt;
}

std::optional<AbaqusKeyword> AbaqusLines::next_keyword() {
  while (next_data()) {
  }
  std::vector<std::string_view> entries;
  for (bool goes_on = true; goes_on;) {  // a line that ends with a comma goes on in the next one
    const auto line = peek();
    if (!line || (!entries.empty() && line->starts_with('*'))) break;
    peeked_ = false;
    goes_on = line->ends_with(',');
    const std::vector<std::string_view> more = entries_of(*line);
    entries.insert(entries.end(), more.begin(), more.end());
  }
  if (entries.empty()) return std::nullopt;
  AbaqusKeyword keyword;
  keyword.name = upper(trimmed(entries[0].substr(1)));
  for (std::size_t k = 1; k < entries.size(); ++k) {
    const std::size_t sign = std::min(entries[k].find('='), entries[k].size());
    const std::string_view value = entries[k].substr(std::min(sign + 1, entries[k].size()));
    keyword.parameters[upper(trimmed(entries[k].substr(0, sign)))] = without_quotes(trimmed(value));
  }
  return keyword;
}

std::optional<std::vector<std::string_view>> AbaqusLines::next_data() {
  const auto line = peek();
  if (!line || line->starts_with('*')) return std::nullopt;
  peeked_ = false;
  return entries_of(*line);
}

double AbaqusLines::number(std::string_view entry) const {
  std::string text(entry);
  for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;  // exponents as Fortran writes them
  double value = 0.0;
  if (!entry.empty() && !parse(text, value)) {
    refuse(fmt::format("has {} where a number should be", quoted(std::string(entry))), "");
  }
  if (!(std::abs(value) <= largest_coordinate)) {
    refuse(fmt::format("has the coordinate {}, which is not finite or too large", value), "");
  }
  return value;
}

std::int64_t AbaqusLines::label(std::string_view entry) const {
  std::int64_t value = 0;
  if (!parse(entry, value) || value < 1) {
    refuse(fmt::format("has {} where the number of a node or element should be",
                       quoted(std::string(entry))),
           "");
  }
  return value;
}

bool AbaqusLines::is_label(std::string_view entry) {
  std::int64_t value = 0;
  return parse(entry, value);
}

void AbaqusLines::refuse(const std::string& fault, const std::string& advice) const {
  throw InputError({path_, line_, ""}, fault, advice);
}

}  // namespace perilink
