#include "app/process/process_pool.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <map>
#include <string>

#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

/// Waits for the end of all processes.
std::map<std::size_t, FinishedProcess> ends_of(ProcessPool& pool) {
  std::map<std::size_t, FinishedProcess> ends;
  while (!pool.idle()) {
    for (FinishedProcess& end : pool.wait(1000)) ends[end.number] = end;
  }
  return ends;
}

TEST(ProcessPool, ReportsStatusAndErrorsOfEveryProcess) {
  ProcessPool pool("/bin/sh", 3);
  pool.start(4, {"-c", "echo out; echo one >&2; exit 3"});
  pool.start(7, {"-c", "kill -9 $$"});
  EXPECT_FALSE(pool.full());
  pool.start(1, {"-c", "i=0; while [ $i -lt 9000 ]; do echo 0123456789 >&2; i=$((i+1)); done"});
  EXPECT_TRUE(pool.full());
  const auto ends = ends_of(pool);
  EXPECT_EQ(ends.at(4).exit_status, 3);
  EXPECT_EQ(ends.at(4).errors, "one\n");
  EXPECT_EQ(ends.at(7).signal, SIGKILL);
  EXPECT_EQ(ends.at(7).exit_status, -1);
  EXPECT_EQ(ends.at(1).exit_status, 0);
  EXPECT_EQ(ends.at(1).errors.size(), 65536u) << "the rest is not kept";
}

TEST(ProcessPool, ProgramsThatDoNotExistEndWithAStatus) {
  ProcessPool pool("/nowhere/program", 1);
  pool.start(0, {});
  EXPECT_EQ(ends_of(pool).at(0).exit_status, 127);
}

TEST(ProcessPool, StopsProcessesOnRequest) {
  ProcessPool pool("/bin/sh", 2);
  pool.start(0, {"-c", "echo ready >&2; exec sleep 100"});
  EXPECT_TRUE(pool.wait(10).empty());
  pool.stop();
  EXPECT_EQ(ends_of(pool).at(0).signal, SIGTERM);
}

TEST(ProcessPool, KillsProcessesAtItsEnd) {
  const test::TemporaryDirectory directory;
  const std::string note = (directory / "id").string();
  pid_t id = 0;
  {
    ProcessPool pool("/bin/sh", 1);
    pool.start(0, {"-c", "trap '' TERM; echo $$ > " + note + "; exec sleep 100"});
    for (int k = 0; id == 0 && k < 1000; ++k) {
      EXPECT_TRUE(pool.wait(10).empty());
      std::ifstream(note) >> id;
    }
    ASSERT_GT(id, 0);
    EXPECT_EQ(kill(id, 0), 0) << "it runs";
  }
  EXPECT_NE(kill(id, 0), 0);
}

}  // namespace
}  // namespace perilink
