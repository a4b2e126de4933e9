#include "base/joined_text.hpp"

#include <fmt/format.h>

#include <vector>

namespace perilink {

std::string joined(std::span<const double> numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(fmt::format("{:.6g}", number));
  return joined(texts);
}

std::string joined(std::span<const std::string> texts) {
  std::string text;
  for (const std::string& one : texts) text += (text.empty() ? "" : ", ") + one;
  return text;
}

}  // namespace perilink
