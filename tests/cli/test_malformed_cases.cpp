// Every file of malformed/ is refused by the reader and by the program, every file of
// malformed_body/ by the program, which has the body before it. The first lines of each file say
// what the message must contain: `# expect: text`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "io/case/case_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(fs::path(PERILINK_SOURCE_DIR) / "tests/cli" / folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> all_files() {
  std::vector<fs::path> files = files_of("malformed");
  const std::vector<fs::path> more = files_of("malformed_body");
  files.insert(files.end(), more.begin(), more.end());
  return files;
}

std::vector<std::string> expectations(const fs::path& path) {
  const std::string mark = "# expect: ";
  std::vector<std::string> result;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with(mark);) {
    result.push_back(line.substr(mark.size()));
  }
  return result;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_message(const std::string& message, const fs::path& path) {
  const std::vector<std::string> texts = expectations(path);
  EXPECT_FALSE(texts.empty()) << path << " has no line `# expect: ...`";
  for (const std::string& text : texts) EXPECT_THAT(message, testing::HasSubstr(text));
  EXPECT_THAT(message, testing::HasSubstr(path.filename().string()));
  EXPECT_LT(message.size(), 1500u) << "nobody reads that much";
}

std::string name_of(const testing::TestParamInfo<fs::path>& info) {
  return info.param.stem().string();
}

class MalformedCase : public testing::TestWithParam<fs::path> {};

TEST_P(MalformedCase, IsRefusedByReader) {
  const fs::path& path = GetParam();
  try {
    read_case_file(path.string());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_message(error.what(), path);
  }
}

INSTANTIATE_TEST_SUITE_P(Text, MalformedCase, testing::ValuesIn(files_of("malformed")), name_of);

class BodyCase : public testing::TestWithParam<fs::path> {};

/// Otherwise the process test would pass for a reason that has nothing to do with the body.
TEST_P(BodyCase, IsAcceptedByReader) { EXPECT_NO_THROW(read_case_file(GetParam().string())); }

INSTANTIATE_TEST_SUITE_P(Text, BodyCase, testing::ValuesIn(files_of("malformed_body")), name_of);

class MalformedProcess : public testing::TestWithParam<fs::path> {};

TEST_P(MalformedProcess, IsRefusedByProgram) {
  ASSERT_TRUE(fs::exists(PERILINK_PROGRAM)) << "the program is not built";
  const fs::path& path = GetParam();
  const fs::path work =
      fs::path(testing::TempDir()) / ("perilink_malformed_" + path.stem().string());
  fs::remove_all(work);
  fs::create_directories(work / "empty");
  const std::string command = "cd '" + (work / "empty").string() +
                              "' && '" PERILINK_PROGRAM "' check '" + path.string() +
                              "' >../out 2>../err";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  expect_message(content(work / "err"), path);
  EXPECT_TRUE(fs::is_empty(work / "empty")) << "a refused case left files behind";
  fs::remove_all(work);
}

INSTANTIATE_TEST_SUITE_P(Program, MalformedProcess, testing::ValuesIn(all_files()), name_of);

}  // namespace
}  // namespace perilink
