#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "io/text/toml_tree.hpp"

/// \file Descriptions of tables and keys. Reading, writing, messages, the JSON schema and the check
///     of the reference page derive from them.

namespace perilink {

class CaseTable;
class TomlWriter;

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

/// Numbers that a key allows.
struct Range {
  double least = -infinity, most = infinity;
  bool above = false;  ///< `least` itself is refused
  bool below = false;  ///< `most` itself is refused

  bool contains(double value) const;
};

namespace allowed {

inline constexpr Range positive{0.0, infinity, true};
inline constexpr Range not_negative{0.0};
inline constexpr Range fraction{0.0, 1.0, true, true};
/// Returns a closed range.
constexpr Range from(double least, double most) { return {least, most}; }

}  // namespace allowed

/// Values that a key allows.
struct Values {
  enum class Kind {
    by_type,  ///< follows from the type of the member
    boolean,
    integer,
    number,
    energy,  ///< a number, or "infinite"
    text,
    axis,        ///< of displacements
    normal,      ///< axis of a position
    components,  ///< as many numbers as displacements have components
    position,    ///< as many numbers as the body has dimensions
    points,      ///< a list of positions
    pairs,       ///< a list of two numbers each
    formula,     ///< a number or a formula
    formulas,    ///< as many of them as displacements have components
    moment,      ///< a number in the plane, components in space
  };
  Values(Kind type = Kind::by_type, const Range& allowed = {}) : kind(type), range(allowed) {}
  Values(const Range& allowed) : range(allowed) {}  // NOLINT: a range is all that most keys need
  Values(std::vector<std::string_view> allowed)     // NOLINT
      : kind(Kind::text), words(std::move(allowed)) {}

  Values as_list() const {
    Values values = *this;
    values.list = true;
    return values;
  }

  Kind kind = Kind::by_type;
  Range range;  ///< of every number
  bool list = false;
  std::vector<std::string_view> words = {};  ///< of text; empty: any
};

/// A key that a table may have. Members with empty defaults are rules that few keys have.
struct KeySchema {
  KeySchema(const char* key, std::vector<NotFor> without = {})  // NOLINT: words are keys
      : name(key), not_for(std::move(without)) {}
  KeySchema(const char* key, Values allowed, std::vector<NotFor> without = {})
      : name(key), values(std::move(allowed)), not_for(std::move(without)) {}

  /// Refuses tables without the key, unless another key that it depends on excludes it.
  /// \param what  description for the message
  KeySchema needed(std::string_view what) const { return with(&KeySchema::missing, what); }
  /// \param advice  suggestion for numbers out of range or out of order
  KeySchema hinted(std::string_view advice) const { return with(&KeySchema::hint, advice); }
  /// \param key  another key of the table without which this one is refused
  KeySchema beside(std::string_view key) const { return with(&KeySchema::companion, key); }
  /// \param key  another key of the table beside which this one is refused
  KeySchema instead_of(std::string_view key) const { return with(&KeySchema::rival, key); }
  /// \param key    key with words
  /// \param words  words of that key with which this one is allowed
  KeySchema only_with(std::string_view key, std::vector<std::string_view> words) const {
    return with(&KeySchema::choice, key).with(&KeySchema::chosen, std::move(words));
  }
  /// Refuses lists of numbers that do not ascend.
  KeySchema ascending() const { return with(&KeySchema::sorted, true); }
  /// States no default in the JSON schema: it depends on other keys.
  KeySchema derived() const { return with(&KeySchema::fallback, nullptr); }
  /// Writes lists and texts that are empty.
  KeySchema written_empty() const { return with(&KeySchema::empty_too, true); }
  /// Reads and writes the key also where the analysis does not use it.
  KeySchema kept() const { return with(&KeySchema::always, true); }
  template <class Section>
  KeySchema written_if(bool (*condition)(const Section&)) const {
    return with(&KeySchema::write, [inner = write, condition](const KeySchema& key, TomlWriter& out,
                                                              const void* of_case, Kinds kind) {
      if (condition(*static_cast<const Section*>(of_case))) {
        inner(key, out, of_case, kind);
      }
    });
  }
  template <class Section>
  KeySchema written_by(void (*writer)(TomlWriter&, const Section&, Kinds)) const {
    return with(&KeySchema::write,
                [writer](const KeySchema&, TomlWriter& out, const void* of_case, Kinds kind) {
                  writer(out, *static_cast<const Section*>(of_case), kind);
                })
        .with(&KeySchema::section, &typeid(Section));
  }

  std::string_view name;
  Values values;
  std::vector<NotFor> not_for;  ///< the first that holds applies
  std::string_view missing, hint, companion, rival, choice;
  std::vector<std::string_view> chosen;
  bool always = false, empty_too = false, sorted = false;
  const std::type_info* section = nullptr;  ///< struct of the member; null: read by hand
  std::function<void(const KeySchema&, const CaseTable&, void* section, Kinds)> read;
  std::function<void(const KeySchema&, TomlWriter&, const void* section, Kinds)> write;
  std::function<std::string(const KeySchema&)> fallback;  ///< default as TOML; empty: none

 private:
  template <class T, class Value>
  KeySchema with(T KeySchema::*member, Value&& value) const {
    KeySchema key = *this;
    key.*member = std::forward<Value>(value);
    return key;
  }
};

/// A table that a case may have.
struct TableSchema {
  std::string_view name;          ///< empty: the top of the file
  bool list = false;              ///< written [[name]], any number of times
  std::vector<KeySchema> keys;    ///< in the order of the reference page
  std::vector<NotFor> not_for{};  ///< cases without the table
  /// Groups of keys of which a table has exactly one.
  std::vector<std::vector<std::string_view>> one_of{};
};

/// Returns "[body]", "[[regions]]" or "the top of the file".
std::string header_of(const TableSchema& schema);

/// Returns the first exception that holds for a kind of case, or nullptr.
const NotFor* exception_of(const std::vector<NotFor>& exceptions, Kinds kind);

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
