#include "io/mesh/gmsh_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "io/mesh/gmsh_tokens.hpp"
#include "io/mesh/gmsh_words.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using Kind = GmshToken::Kind;

/// Scripts that one geometry may include, within each other or side by side; brackets in brackets.
constexpr std::size_t most_scripts = 200, deepest_nesting = 100;

std::set<std::string, std::less<>> words_of(const char* list) {
  std::istringstream stream(list);
  std::set<std::string, std::less<>> words;
  for (std::string word; stream >> word;) words.insert(word);
  return words;
}

bool is_harmless(const std::string& word) {
  static const auto words = words_of(harmless_words);
  return words.contains(word);
}

/// Words that take texts and whose value is one.
bool makes_text(const GmshToken& token) {
  static const auto words = words_of(text_words);
  return token.kind == Kind::text || words.contains(token.text);
}

bool is_plain(unsigned char c) {
  return c >= 0x80 || std::isalnum(c) != 0 || std::strchr("/._-+ ,()=@%#", c) != nullptr;
}

/// gmsh would look for some names elsewhere: it takes `\` and `x:` for the beginning of a path of
/// Windows, and the folder of "/a.geo" for the one in which the program runs; it unpacks ".gz".
void refuse_odd_name(const std::string& name, const SourceLocation& where) {
  const bool odd = name.empty() || !std::all_of(name.begin(), name.end(), is_plain) ||
                   name.front() == ' ' || name.back() == ' ' || name.rfind('/') == 0 ||
                   name.ends_with(".gz");
  if (!odd) return;
  throw InputError(
      where, fmt::format("names the file {}, which gmsh may look for elsewhere", quoted(name)),
      "use letters, digits, blanks within the name, and . _ - + , ( ) = @ % # / in "
      "names of geometries and their folders, or give --trust-geometry if you trust "
      "whoever wrote it");
}

bool opens(const GmshToken& token) { return token.is("(") || token.is("[") || token.is("{"); }
bool closes(const GmshToken& token) { return token.is(")") || token.is("]") || token.is("}"); }

/// Whether a text holds a word, which may be the end of a longer one: gmsh may begin anywhere.
bool holds_word(const std::string& text, std::string_view word) {
  for (std::size_t k = text.find(word); k != std::string::npos; k = text.find(word, k + 1)) {
    const auto next = static_cast<unsigned char>(text.c_str()[k + word.size()]);
    if (std::isalpha(static_cast<unsigned char>(word.back())) == 0 || std::isalnum(next) == 0) {
      return true;
    }
  }
  return false;
}

bool assigns(const GmshToken& token) {
  for (const char* sign : {"=", "+=", "-=", "*=", "/=", "++", "--"}) {
    if (token.is(sign)) return true;
  }
  return false;
}

bool prints(const GmshToken& token) {
  return token.is("Printf") || token.is("Warning") || token.is("Error");
}

/// A file that a script reads.
struct GmshFile {
  std::string name;
  bool included;  ///< read as a script whatever its name says
};

/// One script and the names that it and those around it give.
class Script {
 public:
  Script(const std::string& text, std::string path) : path_(std::move(path)) {
    tokens_ = gmsh_tokens(text, path_, hidden_);
    for (const GmshToken& token : tokens_) {
      if (token.kind == Kind::text) hidden_.push_back(token);
    }
    match_brackets();
  }

  void add_names(std::set<std::string>& names) const;
  void check(const std::set<std::string>& names) const;
  /// Texts after Include and Merge.
  std::vector<GmshFile> files() const;

 private:
  [[noreturn]] void refuse(const GmshToken& token, const std::string& fault) const;
  const GmshToken& at(std::size_t k) const { return tokens_[std::min(k, tokens_.size() - 1)]; }
  void match_brackets();
  std::size_t behind_brackets(std::size_t k) const;
  std::size_t before_brackets(std::size_t k) const;
  bool is_field_type(std::size_t k) const;
  void check_word(std::size_t k, const std::set<std::string>& names) const;
  void check_member(std::size_t k) const;
  void check_name(std::size_t k, const std::set<std::string>& names) const;
  void check_hidden() const;

  std::string path_;
  std::vector<GmshToken> tokens_;
  std::vector<std::size_t> partner_;  ///< the other bracket of a pair; the end where it lacks
  std::vector<GmshToken> hidden_;     ///< comments and texts
};

void Script::refuse(const GmshToken& token, const std::string& fault) const {
  throw InputError(
      {path_, token.line, ""}, fault,
      "a geometry may draw and mesh only. Delete this from the script, mesh it by hand "
      "and name the .msh file, or give --trust-geometry if you trust whoever wrote it");
}

void Script::match_brackets() {
  partner_.assign(tokens_.size(), tokens_.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < tokens_.size(); ++k) {
    if (opens(tokens_[k])) {
      open.push_back(k);
      if (open.size() > deepest_nesting) {
        refuse(tokens_[k], fmt::format("nests more than {} brackets", deepest_nesting));
      }
    } else if (closes(tokens_[k]) && !open.empty()) {
      partner_[k] = open.back();
      partner_[open.back()] = k;
      open.pop_back();
    }
  }
}

/// Place behind the brackets that begin at a place, one after the other, as in `a[1]` and
/// `a~{i}(2)`.
std::size_t Script::behind_brackets(std::size_t k) const {
  while (at(k).is("~") || opens(at(k))) {
    if (at(k).is("~")) ++k;
    k = opens(at(k)) ? partner_[k] + 1 : k + 1;
  }
  return k;
}

/// Place of the word before the brackets that end at a place.
std::size_t Script::before_brackets(std::size_t k) const {
  const std::size_t first = closes(at(k)) ? partner_[k] : k;
  return first > 0 ? first - 1 : tokens_.size() - 1;
}

void Script::add_names(std::set<std::string>& names) const {
  for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
    if (tokens_[k].kind != Kind::word) continue;
    const GmshToken& before = k > 0 ? tokens_[k - 1] : tokens_.back();
    const bool introduced = before.is("For") || before.is("Macro") || before.is("Function") ||
                            (before.is("(") && k > 1 && tokens_[k - 2].is("Exists"));
    if (introduced || assigns(at(behind_brackets(k + 1)))) names.insert(tokens_[k].text);
  }
}

std::vector<GmshFile> Script::files() const {
  std::vector<GmshFile> files;
  for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
    const GmshToken& token = tokens_[k];
    if (!token.is("Include") && !token.is("Merge") && !token.is("MergeWithBoundingBox")) continue;
    if (at(k + 1).kind != Kind::text || !at(k + 2).is(";")) {
      refuse(token, fmt::format("has {} of a file whose name is not a plain text", token.text));
    }
    refuse_odd_name(at(k + 1).text, {path_, token.line, ""});
    files.push_back({at(k + 1).text, token.is("Include")});
  }
  return files;
}

/// Options of gmsh: `Mesh.Algorithm`, `View[0].Name`, `Field[1].F`, `Plugin(Crack).Run`.
void Script::check_member(std::size_t k) const {
  std::size_t owner = k - 1;  // the dot is at k
  if (closes(at(owner))) owner = before_brackets(owner);
  const GmshToken& word = at(owner);
  const bool nested = word.is("Color") && owner > 1 && at(owner - 1).is(".");
  for (const char* known : {"Mesh", "Geometry", "View", "Field", "Plugin"}) {
    if (word.is(known) || nested) return;
  }
  // Options of other kinds name files and programs; numbers among them say how much gmsh tells.
  if (word.is("General") && at(k + 2).is("=") && at(k + 3).kind == Kind::number) return;
  refuse(word, fmt::format("sets an option of {}", quoted(word.text)));
}

/// Names of the script stand for numbers and texts. Before a text or another word, or around a
/// text, they would be commands.
void Script::check_name(std::size_t k, const std::set<std::string>& names) const {
  const GmshToken& token = tokens_[k];
  if (!names.contains(token.text)) {
    refuse(token,
           fmt::format("has the word {}, which is not known to be harmless", quoted(token.text)));
  }
  const GmshToken& before = k > 0 ? tokens_[k - 1] : tokens_.back();
  if (before.is("Macro") || before.is("Function")) return;
  const std::size_t next = behind_brackets(k + 1);
  const bool acts = makes_text(at(next)) ||
                    (at(next).kind == Kind::word && !at(next).is("In") && !at(next).is("Using"));
  if (acts || (opens(at(k + 1)) && makes_text(at(k + 2)))) {
    refuse(token, fmt::format("uses {} as a command", quoted(token.text)));
  }
}

/// The word after `Field[1] =`.
bool Script::is_field_type(std::size_t k) const {
  return k > 2 && at(k - 1).is("=") && closes(at(k - 2)) && at(before_brackets(k - 2)).is("Field");
}

void Script::check_word(std::size_t k, const std::set<std::string>& names) const {
  const GmshToken& token = tokens_[k];
  const auto refused = std::find_if(refused_words.begin(), refused_words.end(),
                                    [&](const Refused& entry) { return token.text == entry.word; });
  if (refused != refused_words.end()) {
    refuse(token, fmt::format("has {}, which {}", refused->word, refused->deed));
  }
  if (token.is("Plugin")) {
    if (!at(k + 1).is("(") || !at(k + 2).is("Crack")) {
      refuse(token, fmt::format("uses the plugin {}", quoted(at(k + 2).text)));
    }
  } else if (prints(token)) {
    return;  // check() looks for the file
  } else if (k > 0 && at(k - 1).is(".")) {
    return;  // the owner of the option has been looked at
  } else if (is_field_type(k)) {
    static const auto fields = words_of(harmless_fields);
    if (fields.contains(token.text)) return;
    refuse(token, fmt::format("has a field of type {}", quoted(token.text)));
  } else if (is_harmless(token.text) || token.is("Include") || token.is("General") ||
             token.text.starts_with("Merge") || (token.is("Crack") && at(k - 2).is("Plugin"))) {
    return;
  } else {
    check_name(k, names);
  }
}

/// gmsh passes over what a condition leaves out with another, coarser lexer, which can lose a
/// quote; after loops, macros and included files it goes on where a line begins. A text or a
/// comment must not become commands by this.
void Script::check_hidden() const {
  const auto jumps = [](const GmshToken& token) {
    return token.kind == Kind::word &&
           std::find(jumping_words.begin(), jumping_words.end(), token.text) != jumping_words.end();
  };
  if (std::none_of(tokens_.begin(), tokens_.end(), jumps)) return;
  std::set<int> lines;  // with more than comments
  for (const GmshToken& token : tokens_) lines.insert(token.line);
  for (const GmshToken& hidden : hidden_) {
    const auto holds = [&](std::string_view word) { return holds_word(hidden.text, word); };
    const auto refuse_word = [&](std::string_view word) {
      if (!holds(word)) return;
      refuse(hidden, fmt::format("has {} in a text or comment of a script with If, For, Macro or "
                                 "Include, where gmsh may run it",
                                 word));
    };
    for (const std::string_view word : hidden_commands) refuse_word(word);
    for (const Refused& entry : refused_words) refuse_word(entry.word);
    for (const char* word : {"Error", "Warning"}) {  // words of people, too
      if (holds("(") || holds("[")) refuse_word(word);
    }
    if (holds("\n") && lines.contains(hidden.line)) {
      refuse(hidden,
             "has a text or comment that begins behind something else and goes on in the "
             "next line, which gmsh may run");
    }
  }
}

void Script::check(const std::set<std::string>& names) const {
  const GmshToken* printing = nullptr;
  for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
    const GmshToken& token = tokens_[k];
    if (prints(token)) printing = &token;
    if (token.is(";")) printing = nullptr;
    if (printing != nullptr && (token.is(">") || token.is(">>"))) {
      refuse(*printing, fmt::format("{} writes a file", printing->text));
    }
    if (token.kind == Kind::word) check_word(k, names);
    if (token.is(".") && k > 0) check_member(k);
  }
  check_hidden();
}

/// Files that gmsh takes for data whatever they hold. It runs all others as scripts, "part.Step"
/// and meshes without $MeshFormat too.
bool is_data(const fs::path& path, const std::string& text) {
  for (const char* extension :
       {".step", ".STEP", ".stp", ".STP", ".brep", ".iges", ".IGES", ".igs", ".stl", ".STL"}) {
    if (path.extension() == extension) return true;
  }
  return path.extension() == ".msh" && text.starts_with("$MeshFormat");
}

/// gmsh would run "part.Step" as a script.
void refuse_mixed_letters(const fs::path& path) {
  std::string small = path.extension().string();
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* extension : {".step", ".stp", ".brep", ".iges", ".igs", ".stl"}) {
    if (small != extension) continue;
    throw InputError(
        {path.string(), 0, ""},
        fmt::format("ends with {}, which gmsh does not know as {} and reads as a script",
                    path.extension().string(), extension),
        "rename the file");
  }
}

/// Name by which two ways to one folder are the same. The last part stays as it is, because gmsh
/// goes by names: a link "a.stl" to "b.geo" is data, "b.geo" is a script.
std::string key_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  return (fs::weakly_canonical(folder) / path.filename()).string();
}

/// A geometry with all that gmsh reads for it.
class ScriptReader {
 public:
  void read(const fs::path& path, bool included, const SourceLocation& by) {
    if (!seen_.insert({key_of(path), included}).second) return;
    if (seen_.size() > most_scripts) {
      throw InputError({path.string(), 0, ""},
                       fmt::format("is one of more than {} included files", most_scripts),
                       "mesh the geometry by hand and name the .msh file");
    }
    std::string text;
    try {
      text = read_input_text(path.string());
    } catch (const FileError& error) {
      if (by.file.empty()) throw;
      throw InputError(by, fmt::format("includes a file that cannot be read: {}", error.what()),
                       "");
    }
    if (!included && is_data(path, text)) return;
    refuse_mixed_letters(path);
    refuse_large_input(text, path.string());
    const Script script(text, path.string());
    script.add_names(names_);
    scripts_.push_back(script);
    for (const GmshFile& file : script.files()) {
      // An absolute name stands for itself.
      read(path.parent_path() / file.name, file.included, {path.string(), 0, ""});
    }
  }

  void check() const {
    for (const Script& script : scripts_) script.check(names_);
  }

 private:
  std::set<std::pair<std::string, bool>> seen_;
  std::set<std::string> names_;
  std::vector<Script> scripts_;
};

}  // namespace

std::vector<std::string> check_gmsh_script(const std::string& text, const std::string& path) {
  const Script script(text, path);
  std::set<std::string> names;
  script.add_names(names);
  script.check(names);
  std::vector<std::string> files;
  for (const GmshFile& file : script.files()) files.push_back(file.name);
  return files;
}

void refuse_unsafe_geometry(const std::string& path) {
  ScriptReader reader;
  refuse_odd_name(path, {path, 0, ""});
  reader.read(path, false, {});
  if (const std::string options = path + ".opt"; fs::exists(options)) {
    reader.read(options, true, {});
  }
  reader.check();
}

}  // namespace perilink
