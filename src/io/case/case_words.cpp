#include "io/case/case_words.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Compares without regard to upper and lower case.
bool ends_with(std::string_view path, std::string_view extension) {
  if (path.size() < extension.size()) return false;
  return std::equal(
      extension.begin(), extension.end(), path.end() - extension.size(),
      [](char small, char c) { return small == (c >= 'A' && c <= 'Z' ? c + 32 : c); });
}

}  // namespace

bool is_gmsh_script(std::string_view path) { return ends_with(path, ".geo"); }

bool is_geometry(std::string_view path) {
  return is_gmsh_script(path) || ends_with(path, ".step") || ends_with(path, ".stp") ||
         ends_with(path, ".brep");
}

bool is_flat(Pattern pattern) {
  return pattern == Pattern::rectangular || pattern == Pattern::hexagonal;
}

}  // namespace perilink
