#include "io/gmsh_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "io/gmsh_tokens.hpp"
#include "io/gmsh_words.hpp"
#include "io/input_text.hpp"
#include "io/toml_tree.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using Kind = GmshToken::Kind;

/// Scripts that one geometry may include, one within the other or side by side.
constexpr std::size_t most_scripts = 200;

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
  for (const char* word :
       {"Str", "StrCat", "Sprintf", "StrChoice", "StrSub", "StrPrefix", "StrRelative", "StrReplace",
        "UpperCase", "LowerCase", "CurrentDir", "CurrentDirectory", "CurrentFileName", "DirName",
        "AbsolutePath", "N2S", "NameToString", "Today", "DefineString"}) {
    if (token.is(word)) return true;
  }
  return token.kind == Kind::text;
}

bool opens(const GmshToken& token) { return token.is("(") || token.is("[") || token.is("{"); }
bool closes(const GmshToken& token) { return token.is(")") || token.is("]") || token.is("}"); }

bool assigns(const GmshToken& token) {
  for (const char* sign : {"=", "+=", "-=", "*=", "/=", "++", "--"}) {
    if (token.is(sign)) return true;
  }
  return false;
}

bool prints(const GmshToken& token) {
  return token.is("Printf") || token.is("Warning") || token.is("Error");
}

/// One script and the names that it and those around it give.
class Script {
 public:
  Script(const std::string& text, std::string path) : path_(std::move(path)) {
    tokens_ = gmsh_tokens(text, path_, hidden_);
    for (const GmshToken& token : tokens_) {
      if (token.kind == Kind::text) hidden_.push_back(token);
    }
  }

  void add_names(std::set<std::string>& names) const;
  void check(const std::set<std::string>& names) const;
  /// Texts after Include and Merge.
  std::vector<std::string> files() const;

 private:
  [[noreturn]] void refuse(const GmshToken& token, const std::string& fault) const;
  const GmshToken& at(std::size_t k) const { return tokens_[std::min(k, tokens_.size() - 1)]; }
  std::size_t behind_brackets(std::size_t k) const;
  std::size_t before_brackets(std::size_t k) const;
  bool is_field_type(std::size_t k) const;
  void check_word(std::size_t k, const std::set<std::string>& names) const;
  void check_member(std::size_t k) const;
  void check_print(std::size_t k) const;
  void check_name(std::size_t k, const std::set<std::string>& names) const;
  void check_hidden() const;

  std::string path_;
  std::vector<GmshToken> tokens_;
  std::vector<GmshToken> hidden_;  ///< comments and texts
};

void Script::refuse(const GmshToken& token, const std::string& fault) const {
  throw InputError(
      {path_, token.line, ""}, fault,
      "a geometry may draw and mesh only. Delete this from the script, mesh it by hand "
      "and name the .msh file, or give --trust-geometry if you trust whoever wrote it");
}

/// Place behind the brackets that begin at a place, one after the other: of `a[1]` and `a~{i}(2)`.
std::size_t Script::behind_brackets(std::size_t k) const {
  while (at(k).is("~") || opens(at(k))) {
    int depth = 0;
    if (at(k).is("~")) ++k;
    do {
      depth += opens(at(k)) ? 1 : closes(at(k)) ? -1 : 0;
      ++k;
    } while (depth > 0 && k < tokens_.size());
  }
  return k;
}

/// Place of the word before the brackets that end at a place.
std::size_t Script::before_brackets(std::size_t k) const {
  int depth = 0;
  do {
    depth += closes(at(k)) ? 1 : opens(at(k)) ? -1 : 0;
  } while (k-- > 0 && depth > 0);
  return k < tokens_.size() ? k : tokens_.size() - 1;
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

std::vector<std::string> Script::files() const {
  std::vector<std::string> files;
  for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
    const GmshToken& token = tokens_[k];
    if (!token.is("Include") && !token.is("Merge") && !token.is("MergeWithBoundingBox")) continue;
    if (at(k + 1).kind != Kind::text || !at(k + 2).is(";")) {
      refuse(token, fmt::format("has {} of a file whose name is not a plain text", token.text));
    }
    files.push_back(at(k + 1).text);
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

void Script::check_print(std::size_t k) const {
  for (std::size_t next = k + 1; !at(next).is(";") && next < tokens_.size(); ++next) {
    if (!at(next).is(">") && !at(next).is(">>")) continue;
    refuse(at(k), fmt::format("{} writes a file", tokens_[k].text));
  }
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

/// Of `Field[1] = MathEval`.
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
    check_print(k);
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

/// gmsh passes over what a loop or a condition leaves out with another, coarser lexer, which can
/// lose a quote: then texts and comments would be read as commands.
void Script::check_hidden() const {
  const bool branches = std::any_of(tokens_.begin(), tokens_.end(), [](const GmshToken& token) {
    return token.is("If") || token.is("For") || token.is("Macro") || token.is("Function");
  });
  if (!branches) return;
  for (const GmshToken& hidden : hidden_) {
    std::vector<GmshToken> ignored;
    std::string plain = hidden.text;
    for (char& c : plain) {
      if (c == '"' || c == '\'') c = '(';
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '(') c = ' ';
    }
    const std::vector<GmshToken> words = gmsh_tokens(plain, path_, ignored);
    for (std::size_t k = 0; k + 1 < words.size(); ++k) {
      // "Save" and "Print" are words of people, too; before a text they are commands.
      const bool acts = words[k + 1].is("(");
      const bool refused =
          std::any_of(refused_words.begin(), refused_words.end(), [&](const Refused& entry) {
            return words[k].text == entry.word && (acts || entry.deed.starts_with("runs"));
          });
      if (!refused && !(prints(words[k]) && acts)) continue;
      refuse(hidden, fmt::format("has {} in a text or comment of a script with If, For or Macro, "
                                 "where gmsh may run it",
                                 words[k].text));
    }
  }
}

void Script::check(const std::set<std::string>& names) const {
  for (std::size_t k = 0; k + 1 < tokens_.size(); ++k) {
    if (tokens_[k].kind == Kind::word) check_word(k, names);
    if (tokens_[k].is(".") && k > 0) check_member(k);
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

/// A geometry with all that gmsh reads for it.
class Reader {
 public:
  void read(const fs::path& path, const SourceLocation& by) {
    // By name, as gmsh goes by names: a link "a.stl" to "b.geo" is data, "b.geo" is a script.
    if (!seen_.insert(path.lexically_normal().string()).second) return;
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
    if (is_data(path, text)) return;
    refuse_mixed_letters(path);
    refuse_large_input(text, path.string());
    const Script script(text, path.string());
    script.add_names(names_);
    scripts_.push_back(script);
    for (const std::string& file : script.files()) {
      // An absolute name stands for itself.
      read(path.parent_path() / file, {path.string(), 0, ""});
    }
  }

  void check() const {
    for (const Script& script : scripts_) script.check(names_);
  }

 private:
  std::set<std::string> seen_;
  std::set<std::string> names_;
  std::vector<Script> scripts_;
};

}  // namespace

std::vector<std::string> check_gmsh_script(const std::string& text, const std::string& path) {
  const Script script(text, path);
  std::set<std::string> names;
  script.add_names(names);
  script.check(names);
  return script.files();
}

void refuse_unsafe_geometry(const std::string& path) {
  Reader reader;
  reader.read(path, {});
  if (const std::string options = path + ".opt"; fs::exists(options)) reader.read(options, {});
  reader.check();
}

}  // namespace perilink
