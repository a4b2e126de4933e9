#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/toml_tree.hpp"

namespace perilink {

/// Kinds of cases, as bits in three groups: bodies, their dimensions, analyses. A case has one bit
/// of each group; beams also have the bit of the plane.
using Kinds = unsigned;

namespace kinds {

inline constexpr Kinds bond_based = 1, micropolar = 2, lattice = 4, particles = 8, elements = 16;
inline constexpr Kinds plane = 32, space = 64, shell = 128, beam = 4096;  // beams also have plane
inline constexpr Kinds damage = 256, elastic = 512, explicit_ = 1024, relaxation = 2048;

}  // namespace kinds

/// Kinds of cases that cannot use a key or a table, and the message to the user.
struct NotFor {
  Kinds kinds;  ///< a group (bodies, dimensions, analyses) without a bit is not restricted
  /// Text of the refusal; {model}, {type} and {resting} stand for the case's model, its type of
  /// analysis and the reason why particles do not rotate. Empty: the key is checked and reported as
  /// unused.
  std::string_view fault;
  std::string_view suggestion;  ///< {turning} stands for a model whose particles rotate
  std::string_view about = {};  ///< key path at fault; empty: the key or table itself

  /// \param kind  one bit of each group
  bool holds(Kinds kind) const;
};

/// A key that a table may have.
struct KeySchema {
  KeySchema(const char* key, std::vector<NotFor> without = {})  // NOLINT: words are keys
      : name(key), not_for(std::move(without)) {}

  std::string_view name;
  std::vector<NotFor> not_for;  ///< the first that holds applies
};

/// A table that a case may have.
struct TableSchema {
  std::string_view name;          ///< empty: the top of the file
  bool list = false;              ///< written [[name]], any number of times
  std::vector<KeySchema> keys;    ///< in the order of the reference page
  std::vector<NotFor> not_for{};  ///< cases without the table
};

/// Refuses every table and key that a schema lacks, and [name] in place of [[name]] or vice versa.
/// \param schema         the top of the file first
/// \param document_name  "case", for messages
/// \throws InputError
void check_against_schema(const TomlValue& document, const std::string& path,
                          const std::vector<TableSchema>& schema, std::string_view document_name);

/// Returns "did you mean `horizon`? Allowed: ..." with the nearest allowed word, if one is near in
/// spelling, whatever the case of letters.
std::string suggest(const std::string& word, const std::vector<std::string_view>& allowed);

/// Returns the least number of insertions, deletions, replacements and exchanges of neighbouring
/// letters that turns one word into the other.
int edit_distance(std::string_view a, std::string_view b);

}  // namespace perilink
