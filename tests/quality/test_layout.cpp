// The layout of all sources is what clang-format makes of them.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

struct CommandEnd {
  int exit_status = -1;  ///< -1 when a signal ended it
  std::string out;       ///< output and errors
};

/// Runs a command of the shell in the project's folder.
CommandEnd run(const std::string& command) {
  const std::string line = "cd '" + project_root().string() + "' && { " + command + "; } 2>&1";
  std::FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  CommandEnd end;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) end.out += static_cast<char>(c);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
  return end;
}

/// Name of the installed clang-format 14; empty where there is none. Other versions lay some lines
/// out otherwise.
std::string formatter() {
  for (const char* name : {"clang-format-14", "clang-format"}) {
    const CommandEnd end = run(std::string(name) + " --version");
    if (end.exit_status == 0 && end.out.find(" version 14.") != std::string::npos) {
      return name;
    }
  }
  return "";
}

TEST(Layout, IsThatOfClangFormat) {
  const std::string program = formatter();
  if (program.empty()) GTEST_SKIP() << "clang-format 14 is not installed";
  const CommandEnd end = run("find src tests verification -name '*.[ch]pp' -print0 | xargs -0 " +
                             program + " --dry-run -Werror --ferror-limit=20");
  EXPECT_EQ(end.exit_status, 0) << "./dev format mends this:\n" << end.out;
}

}  // namespace
}  // namespace perilink::quality
