#include "base/files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// No file may grow beyond a size while this lives, as on a disk that is full.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int) = nullptr;
};

class Files : public testing::Test {
 protected:
  std::string place(const std::string& name) const { return (work_ / name).string(); }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(work_.path())) {
      found.insert(entry.path().filename().string());
    }
    return found;
  }
  std::string refusal(const std::string& name) const {
    try {
      read_regular_file(place(name));
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  }

  test::TemporaryDirectory work_;
};

TEST_F(Files, AreReplacedAsAWhole) {
  test::write_text(place("a"), "a long old text");
  write_whole_file(place("a"), "new");
  EXPECT_EQ(test::read_text(place("a")), "new");
  EXPECT_EQ(names(), std::set<std::string>{"a"}) << "no temporary is left";
}

TEST_F(Files, WithoutRoomTheOldOneStaysAndNothingElse) {
  test::write_text(place("a"), "old");
  const SizeLimit limit(1000);
  EXPECT_THROW(write_whole_file(place("a"), std::string(2000, 'x')), DiskFull);
  EXPECT_EQ(test::read_text(place("a")), "old");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(Files, ALinkInTheirPlaceIsReplacedNotFollowed) {
  test::write_text(place("victim"), "mine");
  fs::create_symlink("victim", place("whole"));
  fs::create_symlink("victim", place("lines"));
  write_whole_file(place("whole"), "new");
  LineFile file(place("lines"));
  std::string line = "a line\n";
  file.append(line);
  EXPECT_EQ(test::read_text(place("victim")), "mine");
  EXPECT_FALSE(fs::is_symlink(place("whole")));
  EXPECT_EQ(test::read_text(place("lines")), "a line\n");
}

TEST_F(Files, AFolderInTheirPlaceIsAFault) {
  fs::create_directories(place("folder/full"));
  EXPECT_THROW(write_whole_file(place("folder"), "x"), FileError);
  EXPECT_THROW(LineFile(place("folder")), FileError);
  EXPECT_THROW(write_whole_file(place("nowhere/a"), "x"), FileError);
  EXPECT_EQ(names(), std::set<std::string>{"folder"});
}

TEST_F(Files, TemporariesAreKnownByTheirNames) {
  EXPECT_TRUE(is_temporary_of("a.vtu", "a.vtu.0123abcd.part"));
  for (const char* other : {"a.vtu", "a.vtu.part", "a.vtu.0123abc.part", "a.vtu.0123abcg.part",
                            "b.vtu.0123abcd.part", "a.vtu.0123abcd.text", "a.vtu-0123abcd.part"}) {
    EXPECT_FALSE(is_temporary_of("a.vtu", other)) << other;
  }
}

TEST_F(Files, LinesAreWholeWithoutRoomToo) {
  LineFile file(place("lines"));
  const SizeLimit limit(25);
  std::string lines = "123456789\n123456789\n123456789\n";
  EXPECT_THROW(file.append(lines), DiskFull);
  EXPECT_EQ(test::read_text(place("lines")), "123456789\n123456789\n");
  EXPECT_EQ(lines, "123456789\n") << "what is not in the file";
  lines = "12\n";
  file.append(lines);
  EXPECT_EQ(test::read_text(place("lines")), "123456789\n123456789\n12\n");
}

TEST_F(Files, LinesAreCutByAKillAtAPageOfMemoryOnly) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::string line(99, 'x'), path = place("lines");
  for (int kill = 0; kill < 30; ++kill) {
    fs::remove(path);
    const pid_t writer = ::fork();
    if (writer == 0) {
      LineFile file(path);
      for (int write = 0; write < 2000; ++write) {
        std::string lines;
        for (int row = 0; row < 600; ++row) lines += line + '\n';
        file.append(lines);
      }
      ::_exit(0);
    }
    // Some of its writes are done; the kill falls into whichever is under way.
    while (!fs::exists(path)) ::usleep(100);
    ::usleep(100 * static_cast<useconds_t>(kill));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    const std::size_t size = fs::file_size(path);
    EXPECT_TRUE(size % (line.size() + 1) == 0 || size % page == 0) << size;
  }
}

TEST_F(Files, WithoutALineAreNotLeft) {
  LineFile file(place("lines"));
  const SizeLimit limit(5);
  std::string line = "123456789\n";
  EXPECT_THROW(file.append(line), DiskFull);
  EXPECT_TRUE(names().empty());
}

TEST_F(Files, ReadWhatIsThereUpToALimit) {
  std::string text(200001, 'x');
  text.back() = '\0';
  test::write_text(place("a"), text);
  EXPECT_EQ(read_regular_file(place("a")), text);
  EXPECT_EQ(read_regular_file(place("a"), 1000), text.substr(0, 1000));
  EXPECT_EQ(read_regular_file(place("a"), 0), "");
  EXPECT_FALSE(read_regular_file("/proc/self/stat").empty()) << "its size is given as none";
}

TEST_F(Files, ThatCannotBeReadAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo(place("pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal("pipe"), place("pipe") + ": is a named pipe, not a file");
  EXPECT_EQ(refusal("."), place(".") + ": is a directory, not a file");
  EXPECT_EQ(refusal("none"), place("none") + ": cannot be opened: No such file or directory");
  EXPECT_THROW(read_regular_file("/dev/zero"), FileError);
}

TEST_F(Files, AFaultInReadingIsNoFullDisk) {
  try {
    read_regular_file("/proc/self/mem");  // nothing is mapped at its beginning
    FAIL() << "accepted";
  } catch (const DiskFull& error) {
    FAIL() << error.what();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "/proc/self/mem: cannot be read: Input/output error");
  }
}

TEST_F(Files, LargerThanMemoryAreRefusedBeforeTheyAreRead) {
  test::write_text(place("huge"), "");
  fs::resize_file(place("huge"), std::uintmax_t{1} << 42);  // takes no room on the disk
  EXPECT_NE(refusal("huge").find(": has 4398 GB, reading it takes"), std::string::npos)
      << refusal("huge");
  test::write_text(place("large"), std::string(1000, 'x'));
  EXPECT_THROW(read_regular_file(place("large"), 1000, 1e15), FileError);
}

}  // namespace
}  // namespace perilink
