#pragma once

#include <string>

namespace CLI {
class App;
}

namespace perilink {

/// Kinds of option_text().
inline constexpr const char* option_texts[] = {"man", "bash", "zsh", "fish"};

/// Returns a text made of the commands and options of the program: "man" is the manual page, the
/// others are what shells complete words with.
/// \param footer  end of the manual page, on the exit status
std::string option_text(const CLI::App& app, const std::string& kind, const std::string& footer);

}  // namespace perilink
