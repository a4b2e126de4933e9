#include "io/text/toml_guard.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <utility>

#include "base/error.hpp"

namespace perilink {
namespace {

/// A case needs two levels of tables and two of arrays.
constexpr int deepest_level = 16;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Copies and checks the document, in one pass.
class Guard {
 public:
  Guard(std::string_view text, const std::string& path) : text_(text), path_(path) {
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    result_.reserve(text_.size());
  }

  std::string run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        copy_string(c);
      } else if (c == '#') {
        copy_comment();
      } else {
        look_at(c);
        copy();
      }
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& fault, const std::string& suggestion) const {
    throw InputError({path_, line_, ""}, fault, suggestion);
  }

  void copy() { result_ += text_[at_++]; }

  void copy_comment() {
    for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
      result_ += is_ascii(text_[at_]) ? text_[at_] : '?';
    }
  }

  void copy_string(char quote) {
    if (text_.substr(at_, 3) == std::string(3, quote)) {
      refuse("a string begins with three quotes",
             "write text on one line between single or double quotes");
    }
    if (at_ > 0 &&
        std::string_view(" \t\r\n=,[{.").find(text_[at_ - 1]) == std::string_view::npos) {
      refuse("a quote is in the middle of a word", "put whole words between quotes");
    }
    copy();
    while (at_ < text_.size() && text_[at_] != '\n') {
      const char c = text_[at_];
      if (!is_ascii(c)) {
        copy_as_escape(quote);
      } else if (c == '\\' && quote == '"') {
        copy_escape();
      } else {
        copy();
        if (c == quote) return;
      }
    }
    refuse("a string is not closed", "end it with a quote on its line");
  }

  void copy_escape() {
    copy();
    if (at_ == text_.size() || text_[at_] == '\n') return;
    if (!is_ascii(text_[at_])) {
      refuse("a backslash stands before a character that it cannot escape", "write \\\\ for one");
    }
    copy();
  }

  void copy_as_escape(char quote) {
    if (quote == '\'') {
      refuse("text between single quotes holds a character beyond ASCII",
             "put it between double quotes (\")");
    }
    const auto lead = static_cast<unsigned char>(text_[at_]);
    const int more = lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    unsigned code = lead & (0x3FU >> more);
    for (int k = 1; k <= more; ++k) {
      code = code << 6 |
             (static_cast<unsigned char>(text_[at_ + static_cast<std::size_t>(k)]) & 0x3FU);
    }
    result_ += fmt::format("\\U{:08X}", code);
    at_ += static_cast<std::size_t>(more) + 1;
  }

  void look_at(char c) {
    if (!is_ascii(c)) {
      refuse("a character beyond ASCII stands outside of quotes",
             "put text between straight quotes (\"), and only plain spaces between words");
    }
    if (c == '[' || c == '{') ++brackets_;
    if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots_ = 0;
    if (c == '.') ++dots_;
    if (brackets_ > deepest_level || dots_ > deepest_level) {
      refuse(fmt::format("the values nest deeper than {} levels", deepest_level),
             "a case needs no more than tables and lists of numbers");
    }
    if (c == '\n') ++line_;
  }

  std::string_view text_;
  const std::string& path_;
  std::string result_;
  std::size_t at_ = 0;
  int line_ = 1;
  int brackets_ = 0;
  int dots_ = 0;
};

}  // namespace

std::string guard_toml(const std::string& text, const std::string& path) {
  return Guard(text, path).run();
}

}  // namespace perilink
