#include "io/mesh/gmsh_tokens.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "base/error.hpp"

namespace perilink {
namespace {

/// gmsh ends longer texts by itself and reads on in their midst.
constexpr std::size_t longest_token = 1000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

class Lexer {
 public:
  Lexer(const std::string& script, const std::string& path, std::vector<GmshToken>& hidden)
      : script_(script), path_(path), hidden_(hidden) {}

  std::vector<GmshToken> run() {
    refuse_controls();
    while (at_ < script_.size()) step();
    refuse_cut_line();
    tokens_.push_back({GmshToken::Kind::sign, "", line_});
    return std::move(tokens_);
  }

 private:
  [[noreturn]] void refuse(const std::string& fault) const {
    throw InputError({path_, line_, ""}, fault, "mend the script");
  }

  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < script_.size() ? script_[at_ + ahead] : '\0';
  }

  /// Goes on by some characters, and counts lines.
  std::string_view take(std::size_t count) {
    const std::string_view taken = std::string_view(script_).substr(at_, count);
    for (const char c : taken) line_ += c == '\n' ? 1 : 0;
    at_ += taken.size();
    return taken;
  }

  /// Characters at which gmsh may end a line, a comment or a text.
  void refuse_controls() {
    for (; at_ < script_.size(); take(1)) {
      const auto c = static_cast<unsigned char>(peek());
      const bool ends_line = c == '\r' && peek(1) == '\n';
      if (c < 0x20 && c != '\t' && c != '\n' && !ends_line) refuse("has a control character");
    }
    at_ = 0;
    line_ = 1;
  }

  /// Where the last line has no end, gmsh takes its first statement only.
  void refuse_cut_line() const {
    int depth = 0;
    for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
      const GmshToken& token = tokens_[k];
      if (token.is("(") || token.is("[") || token.is("{")) ++depth;
      if (token.is(")") || token.is("]") || token.is("}")) --depth;
      if (depth > 0 || !token.is(";") || token.line < line_) continue;
      refuse("ends without a line break, so that gmsh takes only the first statement of this line");
    }
  }

  void step() {
    const char c = peek();
    if (c == '/' && (peek(1) == '/' || peek(1) == '*')) {
      skip_comment();
    } else if (c == '"' || c == '\'') {
      take_text(c);
    } else if (begins_word(c)) {
      std::size_t count = 1;
      while (begins_word(peek(count)) || is_digit(peek(count))) ++count;
      add(GmshToken::Kind::word, count);
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      add(GmshToken::Kind::number, length_of_number());
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      take(1);
    } else {
      add(GmshToken::Kind::sign, length_of_sign());
    }
  }

  void add(GmshToken::Kind kind, std::size_t count) {
    const int line = line_;
    tokens_.push_back({kind, std::string(take(count)), line});
  }

  void skip_comment() {
    const bool block = peek(1) == '*';
    const std::size_t end = block ? script_.find("*/", at_ + 2) : script_.find('\n', at_);
    if (block && end == std::string::npos) refuse("has a comment without an end");
    const int line = line_;
    const std::string_view comment =
        take(end == std::string::npos ? script_.size() - at_ : end - at_ + (block ? 2 : 0));
    hidden_.push_back({GmshToken::Kind::text, std::string(comment), line});
  }

  void take_text(char quote) {
    const std::size_t end = script_.find(quote, at_ + 1);
    if (end == std::string::npos) refuse("has a text without an end");
    const std::string_view text = std::string_view(script_).substr(at_ + 1, end - at_ - 1);
    if (text.size() > longest_token) {
      refuse(fmt::format("has a text of {} characters; gmsh reads {}", text.size(), longest_token));
    }
    tokens_.push_back({GmshToken::Kind::text, std::string(text), line_});
    take(end - at_ + 1);
  }

  std::size_t length_of_number() const {
    std::size_t count = 0;
    const auto skip_digits = [&] {
      while (is_digit(peek(count))) ++count;
    };
    skip_digits();
    if (peek(count) == '.') ++count;
    skip_digits();
    if (peek(count) != 'e' && peek(count) != 'E') return count;
    const std::size_t sign = peek(count + 1) == '+' || peek(count + 1) == '-' ? 1 : 0;
    if (!is_digit(peek(count + 1 + sign))) return count;
    count += 1 + sign;
    skip_digits();
    return count;
  }

  std::size_t length_of_sign() const {
    static constexpr std::array<std::string_view, 15> long_signs = {
        "+=", "-=", "*=", "/=", "...", "::", "||", "&&", "++", "--", "==", "!=", "<=", ">=", ">>"};
    for (const std::string_view sign : long_signs) {
      if (std::string_view(script_).substr(at_).starts_with(sign)) return sign.size();
    }
    return 1;
  }

  const std::string& script_;
  const std::string& path_;
  std::vector<GmshToken>& hidden_;
  std::vector<GmshToken> tokens_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<GmshToken> gmsh_tokens(const std::string& script, const std::string& path,
                                   std::vector<GmshToken>& hidden) {
  return Lexer(script, path, hidden).run();
}

}  // namespace perilink
