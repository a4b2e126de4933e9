#include "io/toml_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "base/error.hpp"

namespace perilink {
namespace {

/// A case needs two levels of tables and two of arrays.
constexpr int deepest_level = 16;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Walks over the document once, outside of strings and comments.
class Guard {
 public:
  Guard(std::string_view text, const std::string& path) : text_(text), path_(path) {
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  }

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        look_at(c);
        ++at_;
      }
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& fault, const std::string& suggestion) const {
    throw InputError({path_, line_, ""}, fault, suggestion);
  }

  void skip_string(char quote) {
    if (text_.substr(at_, 3) == std::string(3, quote)) {
      refuse("a string begins with three quotes",
             "write text on one line between single or double quotes");
    }
    // Both this walk and the parser must agree on where strings begin.
    if (at_ > 0 &&
        std::string_view(" \t\r\n=,[{.").find(text_[at_ - 1]) == std::string_view::npos) {
      refuse("a quote stands in the midst of a word", "put whole words between quotes");
    }
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') refuse("a string is not closed", "end it with a quote on its line");
      if (quote == '"' && text_[at_] == '\\' && !text_.substr(at_ + 1).starts_with('\n')) {
        ++at_;
      } else if (text_[at_] == quote) {
        ++at_;
        return;
      }
    }
    refuse("a string is not closed", "end it with a quote on its line");
  }

  void look_at(char c) {
    if (static_cast<unsigned char>(c) >= 0x80) {
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
  std::size_t at_ = 0;
  int line_ = 1;
  int brackets_ = 0;
  int dots_ = 0;
};

}  // namespace

void refuse_dangerous_text(const std::string& text, const std::string& path) {
  Guard(text, path).run();
}

}  // namespace perilink
