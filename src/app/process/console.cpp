#include "app/process/console.hpp"

#include <cstdio>
#include <exception>

#include "base/plain_text.hpp"

namespace perilink {

void complain(const std::string& text) noexcept {
  try {
    std::fputs(printable("perilink: " + text + "\n").c_str(), stderr);
  } catch (const std::exception&) {
    std::fputs("perilink: out of memory\n", stderr);
  }
}

void say(const std::string& text) { std::fputs(printable(text).c_str(), stdout); }

}  // namespace perilink
