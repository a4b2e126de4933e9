// The manual page and the completions of shells name every command and option of the help.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "support/process.hpp"

namespace perilink::test {
namespace {

using testing::HasSubstr;

class OptionTexts : public testing::Test {
 protected:
  OptionTexts() { std::filesystem::create_directories(work()); }
  std::filesystem::path work() const { return temporary_ / "work"; }
  std::string output(const std::vector<std::string>& arguments) const {
    const ProcessEnd end = run_program(work(), arguments);
    EXPECT_EQ(end.exit_status, 0) << end.err;
    return end.out;
  }
  /// Long options in a help text.
  static std::set<std::string> options_in(const std::string& help) {
    static const std::regex option("\n +(?:-\\w,)?--([a-z-]+)");
    std::set<std::string> found;
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at) {
      found.insert((*at)[1]);
    }
    return found;
  }
  /// Returns whether the shell, if it is there, finds no fault in the text.
  bool accepted_by(const std::string& shell, const std::string& text) const {
    write_text(work() / "text", text);
    const std::string here = "cd " + work().string() + " && ";
    if (std::system(("command -v " + shell + " > /dev/null").c_str()) != 0) return true;
    return std::system((here + shell + " -n text 2> faults").c_str()) == 0;
  }

  TemporaryDirectory temporary_;
};

const std::vector<std::string> commands = {"run",   "converge", "compare", "scan",
                                           "check", "report",   "schema",  "plot"};

TEST_F(OptionTexts, NameEveryCommandAndOption) {
  for (const std::string kind : {"man", "bash", "zsh", "fish"}) {
    const std::string text = output({"--describe", kind});
    for (const std::string& command : commands) {
      EXPECT_THAT(text, HasSubstr(command)) << kind;
      const std::set<std::string> options = options_in(output({command, "--help"}));
      EXPECT_GT(options.size(), 1u) << command;
      for (const std::string& option : options) {
        if (option == "help") continue;
        const std::string written =
            kind == "man" ? std::regex_replace(option, std::regex("-"), "\\-") : option;
        const std::string before = kind == "man" ? "\\-\\-" : kind == "fish" ? "-l " : "--";
        EXPECT_THAT(text, HasSubstr(before + written)) << kind << ", " << command;
      }
    }
  }
}

TEST_F(OptionTexts, ShellsAcceptThem) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    EXPECT_TRUE(accepted_by(shell, output({"--describe", shell}))) << shell;
  }
}

TEST_F(OptionTexts, BashCompletesCommandsAndOptions) {
  const auto completed = [&](const std::string& words, int at) {
    write_text(work() / "perilink.bash", output({"--describe", "bash"}));
    const std::string script = "cd " + work().string() +
                               " && bash -c 'source ./perilink.bash; COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(at) +
                               "; _perilink 2> /dev/null; echo \"${COMPREPLY[@]}\"' > reply";
    EXPECT_EQ(std::system(script.c_str()), 0);
    return read_text(work() / "reply");
  };
  EXPECT_EQ(completed("perilink co", 1), "converge compare\n");
  EXPECT_EQ(completed("perilink run --re", 2), "--resume\n");
  EXPECT_EQ(completed("perilink plot --re", 2), "\n");
  EXPECT_EQ(completed("perilink run --set body.horizon_", 3),
            "body.horizon_level= body.horizon_ratio=\n");
  write_text(work() / "beam.toml", "");
  EXPECT_EQ(completed("perilink run bea", 2), "beam.toml\n");
}

TEST_F(OptionTexts, OtherKindsAreRefused) {
  const ProcessEnd end = run_program(work(), {"--describe", "csh"});
  EXPECT_EQ(end.exit_status, 2);
}

TEST_F(OptionTexts, CompleteKeysOfCases) {
  for (const std::string kind : {"bash", "fish"}) {
    EXPECT_THAT(output({"--describe", kind}), HasSubstr("body.spacing= ")) << kind;
  }
}

TEST_F(OptionTexts, SchemaHasTheKeysOfTheProgram) {
  EXPECT_THAT(output({"schema"}), HasSubstr("\"event_tolerance\": {"));
  EXPECT_THAT(output({"schema", "--text"}), HasSubstr("  event_tolerance: relative distance"));
}

}  // namespace
}  // namespace perilink::test
