#include "io/text/input_text.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

TEST(InputText, IsReadByteForByte) {
  const test::TemporaryDirectory directory;
  const std::string text = "a = 1\r\n# \xc3\xa9\n";
  test::write_text(directory / "a.toml", text);
  EXPECT_EQ(read_input_text((directory / "a.toml").string()), text);
}

TEST(InputText, AMissingFileIsNamed) {
  try {
    read_input_text("nowhere/a.toml");
    ADD_FAILURE() << "read";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere/a.toml"), std::string::npos);
  }
}

TEST(InputText, SixteenMebibytesAreTheLimit) {
  std::string text(std::size_t{16} << 20, '#');
  EXPECT_NO_THROW(refuse_large_input(text, "a.toml"));
  text += '#';
  EXPECT_THROW(refuse_large_input(text, "a.toml"), InputError);
}

TEST(InputText, IsReadNoFurtherThanTheLimit) {
  const test::TemporaryDirectory directory;
  const std::string path = (directory / "a.toml").string();
  test::write_text(path, "");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);  // takes no room on the disk
  EXPECT_THROW(refuse_large_input(read_input_text(path), path), InputError);
}

TEST(InputText, DevicesAreNotWaitedFor) { EXPECT_THROW(read_input_text("/dev/zero"), FileError); }

TEST(InputText, IsTrimmedAtBothEnds) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed(" \n"), "");
}

TEST(InputText, PathsAreThoseOfTheFolderOfAFile) {
  EXPECT_EQ(beside("a/b.toml", "../c.toml"), "c.toml");
  EXPECT_EQ(beside("b.toml", "c/d.toml"), "c/d.toml");
}

}  // namespace
}  // namespace perilink
