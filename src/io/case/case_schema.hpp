#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/toml_tree.hpp"

namespace perilink {

/// Kinds of cases, as bits in three groups: bodies, their dimensions, analyses. Each group has one
/// bit set in a case, but beams are in the plane as well.
using Kinds = unsigned;

namespace kinds {

inline constexpr Kinds bond_based = 1, micropolar = 2, lattice = 4, particles = 8, elements = 16;
inline constexpr Kinds plane = 32, space = 64, shell = 128, beam = 4096;  // beams are plane too
inline constexpr Kinds damage = 256, elastic = 512, explicit_ = 1024, relaxation = 2048;

}  // namespace kinds

/// Cases that have no use for a key or a table, and what their user is told.
struct NotFor {
  Kinds kinds;  ///< all of the groups (bodies, dimensions, analyses) that it has no bit of
  /// For a refusal, in which {model}, {type} and {resting} stand for the case's model, its type of
  /// analysis and why nothing of it rotates. Empty: the key is checked, not used, and reported so.
  std::string_view fault;
  std::string_view suggestion;  ///< {turning} stands for what would rotate
  std::string_view about = {};  ///< key path that is to blame; empty: the key or table itself

  /// \param kind  a bit of each group
  bool holds(Kinds kind) const;
};

/// A key that a table may have.
struct KeySchema {
  KeySchema(const char* key, std::vector<NotFor> without = {})  // NOLINT: words are keys
      : name(key), not_for(std::move(without)) {}

  std::string_view name;
  std::vector<NotFor> not_for;  ///< the first that holds counts
};

/// A table that a case may have.
struct TableSchema {
  std::string_view name;          ///< empty: the top of the file
  bool list = false;              ///< written [[name]], any number of times
  std::vector<KeySchema> keys;    ///< in the order of the reference page
  std::vector<NotFor> not_for{};  ///< cases without the table
};

/// Refuses every table and key that a schema lacks, [name] in place of [[name]] and vice versa.
/// \param schema         the top of the file first
/// \param document_name  "case", for messages
/// \throws InputError
void check_against_schema(const TomlValue& document, const std::string& path,
                          const std::vector<TableSchema>& schema, std::string_view document_name);

/// "did you mean `horizon`? Allowed: ..." with the allowed word nearest in spelling, if any is
/// near.
std::string suggest(const std::string& word, const std::vector<std::string_view>& allowed);

/// Least number of letters inserted, deleted, replaced or exchanged with their neighbour that turns
/// one word into the other.
int edit_distance(std::string_view a, std::string_view b);

}  // namespace perilink
