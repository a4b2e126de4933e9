#include "app/commands/option_texts.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string_view>
#include <vector>

#include "base/build_info.hpp"
#include "results/case_json_schema.hpp"

namespace perilink {
namespace {

/// Returns the text with a backslash before each of the signs.
std::string escaped(const std::string& text, std::string_view signs) {
  std::string result;
  for (const char c : text) {
    if (signs.find(c) != signs.npos) result += '\\';
    result += c;
  }
  return result;
}

/// Returns a text in single quotes for the shells of POSIX.
std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Returns a text for troff, where a hyphen is typographic and a first point begins a command.
std::string troff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) result += "\\&";
      result += c;
    }
  }
  return result;
}

bool has_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// Returns "--out", "--threads", ... of a command; arguments have no such name.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) {
    return !option->get_positional() && !option->get_lnames().empty() &&
           !option->get_group().empty();
  });
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands(std::function<bool(const CLI::App*)>());
}

std::string long_name(const CLI::Option& option) { return "--" + option.get_lnames().front(); }

/// Returns the kind of an option's value, such as TEXT, without the range that follows it.
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return troff(type.substr(0, type.find(':')));
}

std::string options_for_troff(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : options_of(app)) {
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", troff(option->get_name(false, true)),
                        has_value(*option) ? " \\fI" + value_name(*option) + "\\fR" : "",
                        troff(option->get_description()));
  }
  return text;
}

std::string manual(const CLI::App& app, const std::string& footer) {
  const std::string description = app.get_description();  // "Perilink: ..."
  std::string text = fmt::format(
      ".TH PERILINK 1 \"\" \"Perilink {}\" \"User Commands\"\n.SH NAME\nperilink \\- {}\n"
      ".SH SYNOPSIS\n\\fBperilink\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH OPTIONS\n{}"
      ".SH COMMANDS\n",
      program_version(), troff(description.substr(description.find(':') + 2)),
      options_for_troff(app));
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format(".SS {}", troff(command->get_name()));
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) text += " " + troff(option->get_name(true));
    }
    text +=
        fmt::format("\n{}.\n{}", troff(command->get_description()), options_for_troff(*command));
  }
  return text + ".SH EXIT STATUS AND FILES\n" + troff(footer) + "\n";
}

std::string names_of_options(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : options_of(command)) {
    names += (names.empty() ? "" : " ") + long_name(*option);
  }
  return names;
}

/// Returns KEY= of every key that --set may have, separated by spaces.
std::string settings() {
  std::string text;
  for (const std::string& key : settable_keys()) text += (text.empty() ? "" : " ") + key + "=";
  return text;
}

std::string for_bash(const CLI::App& app) {
  std::string cases, names;
  for (const CLI::App* command : commands_of(app)) {
    names += command->get_name() + " ";
    cases +=
        fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), names_of_options(*command));
  }
  return fmt::format(
      "_perilink() {{\n  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" words\n"
      "  case \"${{COMP_WORDS[1]}}\" in\n{}    *) words=\"\" ;;\n  esac\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then words=\"{}{}\"; fi\n"
      "  if [ \"${{COMP_WORDS[COMP_CWORD-1]}}\" = --set ]; then\n    compopt -o nospace\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"{}\" -- \"$word\")\n    return\n  fi\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ] || [[ \"$word\" == -* ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n  else\n"
      "    compopt -o filenames\n"
      "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n  fi\n}}\n"
      "complete -F _perilink perilink\n",
      cases, names, names_of_options(app), settings());
}

std::string for_zsh(const CLI::App& app) {
  constexpr const char* special = "\\[]:";
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += fmt::format("  {}\n", in_quotes(command->get_name() + ":" +
                                                escaped(command->get_description(), special)));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const CLI::Option* option : options_of(*command)) {
      cases += " " + in_quotes(fmt::format("{}[{}]{}", long_name(*option),
                                           escaped(option->get_description(), special),
                                           has_value(*option) ? ":value:_files" : ""));
    }
    cases += " '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef perilink\nlocal -a commands\ncommands=(\n{})\n"
      "if (( CURRENT == 2 )); then\n  _describe command commands\nelse\n"
      "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n{}"
      "  esac\nfi\n",
      commands, cases);
}

std::string for_fish(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c perilink -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        command->get_name(), escaped(command->get_description(), "\\'"));
    for (const CLI::Option* option : options_of(*command)) {
      text +=
          fmt::format("complete -c perilink -n '__fish_seen_subcommand_from {}' -l {}{} -d '{}'\n",
                      command->get_name(), option->get_lnames().front(),
                      option->get_lnames().front() == "set" ? " -x -a '" + settings() + "'"
                      : has_value(*option)                  ? " -r"
                                                            : "",
                      escaped(option->get_description(), "\\'"));
    }
  }
  return text;
}

}  // namespace

std::string option_text(const CLI::App& app, const std::string& kind, const std::string& footer) {
  if (kind == "man") return manual(app, footer);
  if (kind == "bash") return for_bash(app);
  return kind == "zsh" ? for_zsh(app) : for_fish(app);
}

}  // namespace perilink
