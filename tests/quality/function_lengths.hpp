#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

/// \file
/// Finds the functions of a C++ file and their lengths by matching braces: no compiler, but enough
/// for code laid out by clang-format.

namespace perilink::quality {

struct FunctionExtent {
  std::string header;  ///< text before the body, white space squeezed
  int first_line = 0;  ///< where the header begins, one-based
  int last_line = 0;   ///< where the closing brace is

  int length() const { return last_line - first_line + 1; }
};

struct Token {
  std::size_t end;  ///< position after it
  bool code;        ///< as against a comment, text, character or number
};

/// The token that starts at `at`. (No std::regex here: it recurses once per letter, and long
/// comments overflow the stack.)
inline Token next_token(const std::string& text, std::size_t at) {
  const auto after = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  if (text.compare(at, 2, "//") == 0) return {std::min(text.find('\n', at), text.size()), false};
  if (text.compare(at, 2, "/*") == 0) return {after("*/", at + 2), false};
  if (text.compare(at, 2, "R\"") == 0) {
    const std::size_t open = std::min(text.find('(', at), text.size());
    return {after(")" + text.substr(at + 2, open - at - 2) + "\"", open), false};
  }
  if (text[at] == '"' || text[at] == '\'') {
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != text[at]) end += text[end] == '\\' ? 2 : 1;
    return {std::min(end + 1, text.size()), false};
  }
  const auto is_word = [&](std::size_t i) {
    return std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_';
  };
  // The quote in 1'000 opens no character, and the digits of a name are no number.
  const bool number = std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  std::size_t end = at;
  while (end < text.size() && (is_word(end) || (number && text[end] == '\''))) ++end;
  return {std::max(end, at + 1), !number};
}

/// Comments, texts, characters, numbers and preprocessor lines replaced by blanks; line breaks
/// stay.
inline std::string blank_out(const std::string& text) {
  std::string result = text;
  bool line_start = true;
  for (std::size_t at = 0; at < text.size();) {
    Token token = next_token(text, at);
    if (line_start && text[at] == '#') {
      token = {at, false};
      while (token.end < text.size() && (text[token.end] != '\n' || text[token.end - 1] == '\\')) {
        ++token.end;
      }
    }
    if (text[at] != ' ') line_start = text[at] == '\n';
    for (; at < token.end; ++at) {
      if (!token.code && text[at] != '\n') result[at] = ' ';
    }
  }
  return result;
}

/// Reads a file from brace to brace and notes the functions that are not inside another one.
class FunctionScanner {
 public:
  explicit FunctionScanner(const std::string& text) : text_(blank_out(text)) {}

  std::vector<FunctionExtent> scan() {
    for (const char c : text_) {
      step(c);
      if (c == '\n') ++line_;
    }
    return functions_;
  }

 private:
  enum class Scope { transparent, function, other };

  void step(char c) {
    if (c == '{') {
      open_brace();
    } else if (c == '}') {
      close_brace();
    } else if (inside_code()) {
      return;
    } else if (c == ';' && parentheses_ == 0) {
      header_.clear();
    } else {
      if (c == '(') ++parentheses_;
      if (c == ')') --parentheses_;
      add_to_header(c);
    }
  }

  bool inside_code() const { return !scopes_.empty() && scopes_.back() != Scope::transparent; }

  void add_to_header(char c) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (header_.empty()) {
      if (blank) return;
      header_line_ = line_;
    }
    if (!blank) {
      header_ += c;
    } else if (header_.back() != ' ') {
      header_ += ' ';
    }
  }

  void open_brace() {
    if (inside_code() || parentheses_ > 0) {
      scopes_.push_back(Scope::other);
      return;
    }
    static const std::regex type_or_namespace(
        R"(^(template ?<.*> ?)?(inline |export )*(namespace|class|struct|union|enum|extern)\b)");
    // A constructor's "a_{1}" before its body; the words that may follow a parameter list are not.
    static const std::regex member(R"(\) ?(noexcept ?)?: ?[^:].*[A-Za-z0-9_>]$)");
    static const std::regex qualifier(R"(\) ?(const|noexcept|override|final|mutable|try| )*$)");
    while (!header_.empty() && header_.back() == ' ') header_.pop_back();
    const bool has_parameters = header_.find('(') != std::string::npos;
    if (std::regex_search(header_, type_or_namespace) && !ends_like_function()) {
      scopes_.push_back(Scope::transparent);
      header_.clear();
    } else if (has_parameters &&
               !(std::regex_search(header_, member) && !std::regex_search(header_, qualifier))) {
      scopes_.push_back(Scope::function);
      functions_.push_back({header_, header_line_, 0});
      header_.clear();
    } else {
      scopes_.push_back(Scope::other);
    }
  }

  /// "struct Foo f() {": a function whose result names its kind.
  bool ends_like_function() const {
    static const std::regex end(R"(\) ?(const|noexcept|override)*$)");
    return std::regex_search(header_, end) && header_.find("alignas") == std::string::npos;
  }

  void close_brace() {
    if (scopes_.empty()) return;
    const Scope closed = scopes_.back();
    scopes_.pop_back();
    if (closed == Scope::function) functions_.back().last_line = line_;
    if (closed == Scope::other && !inside_code()) header_ += ' ';
    if (closed != Scope::other) header_.clear();
  }

  std::string text_;
  std::string header_;
  std::vector<Scope> scopes_;
  std::vector<FunctionExtent> functions_;
  int parentheses_ = 0;
  int line_ = 1;
  int header_line_ = 1;
};

inline std::vector<FunctionExtent> find_functions(const std::string& text) {
  return FunctionScanner(text).scan();
}

}  // namespace perilink::quality
