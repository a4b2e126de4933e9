#include "base/error.hpp"

namespace perilink {
namespace {

std::string compose(const SourceLocation& where, const std::string& fault,
                    const std::string& suggestion) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  text += ": ";
  if (!where.key.empty()) text += where.key + ": ";
  text += fault;
  if (!suggestion.empty()) text += "\n  " + suggestion;
  return text;
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& fault,
                       const std::string& suggestion)
    : Error(compose(where, fault, suggestion)), where_(where) {}

}  // namespace perilink
