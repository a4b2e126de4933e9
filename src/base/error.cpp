#include "base/error.hpp"

#include <fmt/format.h>

namespace perilink {
namespace {

std::string compose(const SourceLocation& where, const std::string& fault,
                    const std::string& suggestion) {
  std::string text = fmt::format("--set {}: ", where.key);
  if (where.line >= 0) {
    text = where.file;
    if (where.line > 0) text += fmt::format(":{}", where.line);
    text += where.key.empty() ? ": " : fmt::format(": {}: ", where.key);
  }
  text += fault;
  if (!suggestion.empty()) text += fmt::format("\n  {}", suggestion);
  return text;
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& fault,
                       const std::string& suggestion)
    : Error(compose(where, fault, suggestion)), where_(where) {}

}  // namespace perilink
