#include "io/case/case_words.hpp"

#include <algorithm>
#include <cstddef>

namespace perilink {
namespace {

/// The words stand in the order of the enumerators.
template <class Enumeration>
Enumeration find_word(const std::vector<std::string_view>& words, std::string_view word) {
  return static_cast<Enumeration>(std::find(words.begin(), words.end(), word) - words.begin());
}

/// In letters of either case.
bool ends_with(std::string_view path, std::string_view extension) {
  if (path.size() < extension.size()) return false;
  return std::equal(
      extension.begin(), extension.end(), path.end() - extension.size(),
      [](char small, char c) { return small == (c >= 'A' && c <= 'Z' ? c + 32 : c); });
}

}  // namespace

const std::vector<std::string_view>& pattern_words() {
  static const std::vector<std::string_view> words = {"rectangular", "hexagonal", "cubic",
                                                      "face_centred"};
  return words;
}

const std::vector<std::string_view>& surface_words() {
  static const std::vector<std::string_view> words = {"none", "ghost", "energy", "calibrated"};
  return words;
}

const std::vector<std::string_view>& method_words() {
  static const std::vector<std::string_view> words = {"bonds", "linear_elements"};
  return words;
}

std::string_view word_of(Pattern pattern) {
  return pattern_words()[static_cast<std::size_t>(pattern)];
}

std::string_view word_of(Surface surface) {
  return surface_words()[static_cast<std::size_t>(surface)];
}

Pattern pattern_of(std::string_view word) { return find_word<Pattern>(pattern_words(), word); }

Surface surface_of(std::string_view word) { return find_word<Surface>(surface_words(), word); }

bool is_gmsh_script(std::string_view path) { return ends_with(path, ".geo"); }

bool is_geometry(std::string_view path) {
  return is_gmsh_script(path) || ends_with(path, ".step") || ends_with(path, ".stp") ||
         ends_with(path, ".brep");
}

bool is_flat(Pattern pattern) {
  return pattern == Pattern::rectangular || pattern == Pattern::hexagonal;
}

}  // namespace perilink
