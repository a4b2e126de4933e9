#include "io/checkpoint/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/checkpoint/pack.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::HasSubstr;

struct Saved {
  std::vector<double> numbers;
  std::optional<int> count;
  std::map<Index, double> flow;
  std::string text;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(numbers, count, flow, text);
  }
};

TEST(Pack, RestoresEveryBit) {
  const Saved saved{{0.1, -0.0, 1e-310}, 3, {{7, 0.3}}, "row 5"};
  Saved restored;
  unpack(pack(saved, 2.5), restored);
  EXPECT_EQ(pack(restored), pack(saved));
  EXPECT_TRUE(std::signbit(restored.numbers[1]));
}

TEST(Pack, RefusesBytesThatEndEarly) {
  const std::string bytes = pack(Saved{{1.0, 2.0}, {}, {}, "text"});
  Saved restored;
  EXPECT_THROW(unpack(bytes.substr(0, bytes.size() - 3), restored), FileError);
}

class CheckpointFile : public ::testing::Test {
 protected:
  /// Returns the message with which the file is refused.
  std::string refusal() const {
    try {
      read_checkpoint(path_);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  const test::TemporaryDirectory work_;
  const std::string path_ = (work_ / "checkpoint.bin").string();
  const Checkpoint written_{"spacing = 1\n", "3 1a2b3c4d", std::string("a\0b", 3)};
};

TEST_F(CheckpointFile, IsReadAsWritten) {
  EXPECT_FALSE(read_checkpoint(path_)) << "there is none";
  write_checkpoint(path_, written_);
  const auto read = read_checkpoint(path_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->run, written_.run);
  EXPECT_EQ(read->model, written_.model);
  EXPECT_EQ(read->state, written_.state);
}

/// Every byte counts: wherever one is wrong, the file is refused.
TEST_F(CheckpointFile, IsRefusedWhereAByteIsWrong) {
  write_checkpoint(path_, written_);
  const std::string bytes = read_regular_file(path_);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string wrong = bytes;
    wrong[k] = static_cast<char>(wrong[k] ^ 0x41);
    write_whole_file(path_, wrong);
    EXPECT_THAT(refusal(), HasSubstr("--force")) << "byte " << k;
  }
  write_whole_file(path_, bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(refusal(), HasSubstr("--force")) << "half of it";
}

TEST(Fingerprint, ChangesWithAnyNumberAndWithTheSizes) {
  const std::vector<double> a = {1.0, 2.0}, b = {3.0}, c = {1.0, 2.0000000000000004},
                            all = {1, 2, 3};
  EXPECT_EQ(fingerprint(a, b), fingerprint(a, b));
  EXPECT_NE(fingerprint(a, b), fingerprint(c, b));
  EXPECT_NE(fingerprint(a, b), fingerprint(all));
  const std::vector<double> none;
  EXPECT_NE(fingerprint(a, none, b), fingerprint(c, none, b)) << "before an empty list";
}

}  // namespace
}  // namespace perilink
