#include "io/mesh/gmsh_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "io/text/input_text.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Commands of gmsh 4.8 to 4.13 that draw and mesh.
constexpr std::string_view geometry_commands = R"(
 Affine All Alternate AlternateLeft AlternateRight BSpline Background Bezier Block
 BooleanDifference BooleanFragments BooleanIntersection BooleanUnion Boundary BoundingBox Box Bump
 Chamfer Characteristic Choices Circle ClassifySurfaces Closed Coherence Color CombinedBoundary
 Compound Cone Crack CreateGeometry CreateTopology Curve Cylinder DefineConstant Delete Dilate Disk
 Duplicata Ellipse Error Exists Extrude Field Fillet General Geometry HealShapes Help Hide In
 Include Intersect Knots Layers Left Length Line List Loop Loops Max Merge Mesh MeshSize
 MeshSizeFromBoundary Min Name Nurbs OptimizeMesh Order Parametric Periodic Physical Physicals
 Plane Plugin Point PointsOf Printf Progression QuadTriAddVerts QuadTriNoNewVerts Range ReadOnly
 Recombine RecombineMesh Rectangle Recursive RefineMesh ReorientMesh Reverse ReverseMesh Right
 Rotate Ruled SH SI SL SP SQ SS ST ScaleLastLayer SetFactory SetOrder Show Smoother Sphere Spline
 Split Sprintf Step Str StrCat Surface Symmetry ThickSolid ThruSections Torus TransfQuadTri
 Transfinite Translate Using View Visible Volume Warning Wedge Wire
)";
/// Commands that act outside of gmsh or read other files, refused even where they look like
/// variables. Loops, branches and macros are among them: gmsh jumps by lines there and may join the
/// rest of one line with another.
constexpr std::string_view outside_commands =
    " SystemCall NonBlockingSystemCall System OnelabRun OnelabAction ExternalProcess Solver Save "
    "Print CreateDir SendToServer Exit S2N StringToName GetEnv ListFromFile Slide Open "
    "MergeWithBoundingBox FileName ShapeFromFile "
    "For EndFor If ElseIf Else EndIf Macro Function Return Call ";
constexpr std::size_t most_scripts = 200;
constexpr std::string_view letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZ_abcdefghijklmnopqrstuvwxyz0123456789";

struct Token {
  std::string text;
  int line;

  bool begins(std::string_view signs) const { return signs.find(text[0]) != signs.npos; }
  bool is_text() const { return begins("\"'"); }
  bool is_number() const { return begins("0123456789"); }
  bool is_word() const { return begins(letters) && !is_number(); }
  bool is(std::string_view list) const {
    const std::size_t at = is_word() ? list.find(' ' + text) : list.npos;
    return at != list.npos && std::isspace(list[at + 1 + text.size()]) != 0;
  }
};

[[noreturn]] void refuse_script(const fs::path& path, int line, const std::string& fault) {
  throw InputError({path.string(), line, ""}, fault,
                   "a geometry may draw and mesh only. Change the script, mesh it by hand and name "
                   "the .msh file, or give --trust-geometry if you trust whoever wrote it");
}

/// Whether gmsh may run part of a text or comment: it continues at the beginning of a line after an
/// included file.
bool may_run(const std::string& hidden, bool behind_code) {
  return behind_code && (hidden.find('\n') != hidden.npos || hidden.size() > 1000);
}

/// Refuses bytes that gmsh counts as blanks or ends of texts and this check does not.
void refuse_controls(const std::string& script, const fs::path& path) {
  int line = 0;
  for (std::size_t at = 0; at < script.size(); ++at) {
    const char sign = script[at];
    line += sign == '\n';
    const bool ends_line = sign == '\n' || (sign == '\r' && script[at + 1] == '\n');
    if (ends_line || sign == '\t' || static_cast<unsigned char>(sign) >= ' ') continue;
    refuse_script(path, line, "has a control character");
  }
}

/// Splits a script into tokens as gmsh does, with two empty tokens before it and five after it.
std::vector<Token> cut_script(const std::string& script, const fs::path& path) {
  refuse_controls(script, path);
  std::vector<Token> tokens(2, {";", 0});
  int line = 0;
  for (std::size_t at = 0, end = 1; at < script.size(); at = end, end = at + 1) {
    const Token sign{script.substr(at, 1), line};
    const bool comment = script[at] == '/' && (script[end] == '/' || script[end] == '*');
    if (comment && script[end] == '/') end = script.find_first_of("\r\n", at);
    if (comment && script[end] == '*') end = script.find("*/", at + 2) + 2;
    if (sign.is_text()) end = script.find(script[at], end) + 1;
    if (sign.is_word()) end = script.find_first_not_of(letters, at);
    if (sign.is_number()) end = script.find_first_not_of("0123456789.eE", at);
    if (end <= at) refuse_script(path, line, "has a text or comment without an end");
    const Token token{script.substr(at, end - at), line};
    const bool behind_code = token.is_text() || tokens.back().line == line;
    if ((comment || token.is_text()) && may_run(token.text, behind_code)) {
      refuse_script(path, line,
                    "has a text or comment behind code that is long or has a line break");
    }
    line += static_cast<int>(std::count(token.text.begin(), token.text.end(), '\n'));
    if (!comment && !token.begins(" \t\r\n")) tokens.push_back(token);
  }
  tokens.insert(tokens.end(), 5, {";", line - 1});
  return tokens;
}

/// Whether a word is a command and not a variable or function.
bool is_command(const Token* word) {
  const Token &before = word[-1], &next = word[1];
  if (!word->is_word()) return false;
  return word->is(outside_commands) || next.is_text() || next.is_number() ||
         (next.is_word() && !next.is(" In Using ")) || next.begins("{.") ||
         (next.begins("([") && word[2].is_text()) || (before.begins(";}") && next.begins(";"));
}

/// Checks a script and all files that it reads.
void check_script(const fs::path& path, bool included, std::set<std::string>& seen) {
  static const std::regex data(".*\\.(step|STEP|stp|STP|brep|iges|IGES|igs|stl|STL)");
  static const std::regex name_within("[\"'][\\w-][\\w+/-]*(\\.[\\w+/-]+)*[\"']");
  const bool is_data = !included && std::regex_match(path.filename().string(), data);
  if (is_data || !seen.insert(path.string()).second) return;
  if (seen.size() > most_scripts) refuse_script(path, 1, "is one of too many files");
  const std::string text = read_input_text(path.string());
  refuse_large_input(text, path.string());
  if (!included && seen.size() > 1 && text.starts_with("$MeshFormat")) return;  // a mesh to merge
  const std::vector<Token> tokens = cut_script('\n' + text + '\n', path);
  const auto end = std::find(text.rbegin(), text.rend(), '\n');
  const bool cuts = std::count(text.rbegin(), end, ';') > 1;  // gmsh 4.8 allows only one of them
  if (cuts) refuse_script(path, tokens.back().line, "ends without a line break");
  bool prints = false;
  for (const Token* token = &tokens[2]; token != &tokens.end()[-5]; ++token) {
    const auto refuse_if = [&](bool fault, const char* what) {
      if (fault) refuse_script(path, token->line, fmt::format(fmt::runtime(what), token->text));
    };
    prints = (prints && !token->begins(";")) || token->is(" Printf Error Warning ");
    refuse_if(prints && token->begins(">"), "prints to a file");
    refuse_if((is_command(token) && !token->is(geometry_commands)) ||
                  (token->is_text() && token[-1].begins(")]}\"'0123456789")),
              "names the command {}, which is not on the list of geometry commands");
    refuse_if(token->is(" Plugin ") && !token[2].is(" Crack "), "names a {} other than Crack");
    refuse_if(token->is(" General ") && !token[4].is_number(), "sets a text of {}");
    if (!token->is(" Include Merge ")) continue;
    const std::string& name = token[1].text;
    const fs::path file = path.parent_path() / name.substr(1, name.size() - 2);
    const bool within = std::regex_match(name, name_within) && token[2].begins(";");
    refuse_if(!within || !fs::exists(file), "has {} of no file in its folder or below");
    refuse_if(token[2].line != token->line ||
                  (token[3].line == token->line && token + 3 != &tokens.end()[-5]),
              "has {} that does not end its line");
    check_script(file, token->is(" Include "), seen);
  }
}

}  // namespace

void refuse_unsafe_geometry(const std::string& path) {
  std::set<std::string> seen;
  check_script(path, false, seen);
  if (fs::exists(path + ".opt")) check_script(path + ".opt", true, seen);
}

}  // namespace perilink
