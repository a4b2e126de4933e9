#pragma once

#include <string>
#include <vector>

namespace perilink {

/// A piece of a script of gmsh as gmsh's own lexer cuts it.
struct GmshToken {
  enum class Kind { word, number, text, sign } kind = Kind::sign;
  std::string text;  ///< without quotes where it is a text
  int line = 0;

  bool is(const char* word) const { return kind != Kind::text && text == word; }
};

/// Cuts a script into words, numbers, texts between quotes, and signs such as "=" and "+=". The end
/// of the script is a sign without text.
/// \param hidden  gets the comments
/// \param path    for messages
/// \throws InputError  where gmsh might cut the script otherwise: control characters, comments and
///         texts without an end, texts that are too long for gmsh, a last line of several
///         statements without an end
std::vector<GmshToken> gmsh_tokens(const std::string& script, const std::string& path,
                                   std::vector<GmshToken>& hidden);

}  // namespace perilink
