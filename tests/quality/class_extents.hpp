#pragma once

#include <algorithm>
#include <map>
#include <regex>
#include <string>

#include "quality/function_lengths.hpp"

/// \file
/// Counts what the classes of a header declare: no compiler, but enough for code laid out by
/// clang-format.

namespace perilink::quality {

/// Declarations of one class, without nested classes, types and static constants.
struct ClassExtent {
  int members = 0, functions = 0, booleans = 0;
};

/// Reads the declarations of a header one by one.
class ClassScanner {
 public:
  explicit ClassScanner(const std::string& text) : text_(blank_out(text)) { read_scope(""); }
  const std::map<std::string, ClassExtent>& classes() const { return classes_; }

 private:
  /// Reads up to the brace that closes the scope.
  /// \param name  class whose body this is; empty: a namespace
  void read_scope(const std::string& name) {
    std::string declaration;
    int parentheses = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      parentheses += (c == '(') - (c == ')');
      if (parentheses > 0 || (c != '{' && c != '}' && c != ';')) {
        declaration += c == '\n' ? ' ' : c;
        continue;
      }
      if (c == '}') return;
      if (c == '{' && !opens_scope(declaration)) {
        const bool is_body = declaration.find('(') != std::string::npos;
        skip_braces();
        declaration += is_body ? "" : "{}";
        if (!is_body) continue;
      } else if (c == '{') {
        ++at_;
        read_scope(name_of(declaration));
        // A member that is declared with its type: struct { ... } name;
        declaration.clear();
        continue;
      }
      if (!name.empty()) count(declaration, classes_[name]);
      declaration.clear();
    }
  }

  static bool opens_scope(const std::string& declaration) {
    static const std::regex scope(R"((^|.*[\s>])(class|struct|namespace)\b[^()=]*)");
    return std::regex_match(declaration, scope);
  }

  /// Returns the name of the class that the text before a brace declares; empty: a namespace.
  static std::string name_of(const std::string& declaration) {
    static const std::regex name(R"(.*\b(?:class|struct)\s+(?:alignas\s*\w+\s+)?(\w+)[^;]*)");
    std::smatch found;
    return std::regex_match(declaration, found, name) ? found[1].str() : std::string();
  }

  void skip_braces() {
    int depth = 0;
    do {
      depth += (text_[at_] == '{') - (text_[at_] == '}');
      ++at_;
    } while (at_ < text_.size() && depth > 0);
    --at_;
  }

  static void count(std::string declaration, ClassExtent& extent) {
    static const std::regex access(R"(\b(public|private|protected)\s*:)");
    static const std::regex no_state(
        R"(^\s*(using|friend|static\s+constexpr|enum|class|struct)\b.*)");
    static const std::regex angles(R"(<[^<>]*>)"), boolean(R"(^\s*(mutable\s+)?bool\b.*)");
    declaration = std::regex_replace(declaration, access, "");
    if (declaration.find_first_not_of(' ') == std::string::npos) return;
    if (std::regex_match(declaration, no_state)) return;
    std::string plain = declaration;
    do {
      declaration = plain;
      plain = std::regex_replace(declaration, angles, "");
    } while (plain != declaration);
    const std::size_t parenthesis = plain.find('('), equals = plain.find('=');
    if (parenthesis != std::string::npos && parenthesis < equals) {
      ++extent.functions;
      return;
    }
    const int names = 1 + static_cast<int>(std::count(plain.begin(), plain.end(), ','));
    extent.members += names;
    if (std::regex_match(plain, boolean)) extent.booleans += names;
  }

  std::string text_;
  std::size_t at_ = 0;
  std::map<std::string, ClassExtent> classes_;
};

}  // namespace perilink::quality
