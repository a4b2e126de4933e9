// Reader and program refuse every case of malformed/text. The program refuses every case of
// malformed/body, which needs the body. The tables contain text that the message must contain.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "support/case_tables.hpp"
#include "support/process.hpp"

namespace perilink {
namespace {

using test::CaseEntry;

std::vector<CaseEntry> all_entries() {
  std::vector<CaseEntry> entries = test::read_case_tables("text");
  const std::vector<CaseEntry> more = test::read_case_tables("body");
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

void expect_message(const std::string& message, const CaseEntry& entry) {
  EXPECT_FALSE(entry.expected.empty()) << entry.name << " has no line `? ...`";
  for (const std::string& text : entry.expected) EXPECT_THAT(message, testing::HasSubstr(text));
  EXPECT_THAT(message, testing::HasSubstr(entry.name + ".toml"));
  EXPECT_LT(message.size(), 1500u) << "too long to read";
}

std::string name_of(const testing::TestParamInfo<CaseEntry>& info) { return info.param.name; }

class TableCase : public testing::TestWithParam<CaseEntry> {
 protected:
  std::filesystem::path write() const {
    const std::filesystem::path path = directory_ / (GetParam().name + ".toml");
    test::write_text(path, test::case_text(GetParam()));
    return path;
  }

  test::TemporaryDirectory directory_;
};

class MalformedCase : public TableCase {};

TEST_P(MalformedCase, IsRefusedByReader) {
  const std::filesystem::path path = write();
  try {
    read_case_file(path.string());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_message(error.what(), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Text, MalformedCase, testing::ValuesIn(test::read_case_tables("text")),
                         name_of);

class BodyCase : public TableCase {};

/// Otherwise the process test could pass for a reason unrelated to the body.
TEST_P(BodyCase, IsAcceptedByReader) { EXPECT_NO_THROW(read_case_file(write().string())); }

INSTANTIATE_TEST_SUITE_P(Text, BodyCase, testing::ValuesIn(test::read_case_tables("body")),
                         name_of);

class MalformedProcess : public TableCase {};

TEST_P(MalformedProcess, IsRefusedByProgram) {
  ASSERT_TRUE(std::filesystem::exists(PERILINK_PROGRAM)) << "the program is not built";
  const std::filesystem::path path = write();
  std::filesystem::create_directories(directory_ / "empty");
  const auto end = test::run_program(directory_ / "empty", {"check", path.string()});
  EXPECT_EQ(end.exit_status, 2);
  expect_message(end.err, GetParam());
  EXPECT_TRUE(std::filesystem::is_empty(directory_ / "empty")) << "a refused case left files";
}

INSTANTIATE_TEST_SUITE_P(Program, MalformedProcess, testing::ValuesIn(all_entries()), name_of);

class BaseCase : public testing::TestWithParam<std::filesystem::path> {};

/// The unedited case is accepted, so the edit is the cause of the refusal.
TEST_P(BaseCase, IsAcceptedByReader) { EXPECT_NO_THROW(read_case_file(GetParam().string())); }

INSTANTIATE_TEST_SUITE_P(Text, BaseCase,
                         testing::ValuesIn(test::files_of(test::malformed_folder() / "bases",
                                                          ".toml")),
                         [](const auto& base) { return base.param.stem().string(); });

}  // namespace
}  // namespace perilink
