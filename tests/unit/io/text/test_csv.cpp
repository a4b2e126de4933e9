#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "io/text/csv.hpp"

namespace perilink {
namespace {

class Csv : public ::testing::Test {
 protected:
  Csv() : path_(testing::TempDir() + "perilink_" + std::to_string(::getpid()) + ".csv") {
    std::filesystem::remove(path_);
  }
  ~Csv() override { std::filesystem::remove(path_); }

  std::string text() const {
    std::ifstream file(path_);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void put(const std::string& text) const { std::ofstream(path_) << text; }

  std::string path_;
};

TEST(CsvRow, QuotesTextsThatWouldEndAField) {
  CsvRow row;
  EXPECT_EQ(row.text("plain").text("a, b").text("so \"it\" is").text("two\nlines").end(),
            "plain,\"a, b\",\"so \"\"it\"\" is\",\"two\nlines\"\n");
}

TEST(CsvRow, TextsAreNoFormulasOfASpreadsheet) {
  for (const char* text : {"=1+2", "+1", "-x", "@SUM(A1)", "\tx"}) {
    CsvRow row;
    const std::string written = row.text(text).end();
    EXPECT_TRUE(written.starts_with("\"'")) << written;
  }
  CsvRow row;
  EXPECT_EQ(row.text("=cmd|' /C calc'!A0").number(-3.0).text("a=b").end(),
            "\"'=cmd|' /C calc'!A0\",-3,a=b\n");
}

TEST(CsvRow, WritesOutWhatSteersATerminal) {
  CsvRow row;
  EXPECT_EQ(row.text("a\x1b[2Jb").end(), "a\\x1b[2Jb\n");
}

TEST(CsvRow, LeavesMissingNumbersEmpty) {
  CsvRow row;
  EXPECT_EQ(row.empty().number(0.1).number(std::nan("")).number(-3.0).end(), ",0.1,,-3\n");
}

TEST_F(Csv, WritesTheFewestDigitsThatReadBackAndWholeNumbersAsSuch) {
  {
    CsvWriter writer(path_, {"a", "b", "c"});
    writer.write_row({0.1, 100000.0, -3.0});
    writer.write_row({1e-300, 2.5e20, 1.0 / 3.0});
  }
  EXPECT_EQ(text(), "a,b,c\n0.1,100000,-3\n1e-300,2.5e+20,0.3333333333333333\n");
}

TEST_F(Csv, ReadsBackTheSameBits) {
  const std::vector<double> values = {std::nextafter(1.0, 2.0),
                                      -0.0,
                                      std::numeric_limits<double>::denorm_min(),
                                      std::numeric_limits<double>::max(),
                                      -std::numeric_limits<double>::max(),
                                      9007199254740993.0};
  {
    CsvWriter writer(path_, {"a", "b", "c", "d", "e", "f"});
    writer.write_row(values);
  }
  const CsvTable table = read_csv(path_);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], values);
  EXPECT_TRUE(std::signbit(table.rows[0][1]));
}

TEST_F(Csv, OnlyWholeRowsReachTheFile) {
  CsvWriter writer(path_, {"n", "root"});
  for (int i = 0; i < 20000; ++i) writer.write_row({static_cast<double>(i), std::sqrt(i)});
  const std::string so_far = text();  // some blocks are out, the rest waits
  EXPECT_GT(so_far.size(), 100000u);
  EXPECT_EQ(so_far.back(), '\n');
  writer.flush();
  EXPECT_EQ(read_csv(path_).rows.size(), 20000u);
}

TEST_F(Csv, FindsColumns) {
  put("step, load\r\n1, 2.5\r\n2,-1\r\n");
  const CsvTable table = read_csv(path_);
  EXPECT_EQ(table.column("load"), 1);
  EXPECT_EQ(table.column("loads"), -1);
  EXPECT_EQ(table.rows[0][1], 2.5);
  EXPECT_EQ(table.rows[1][1], -1.0);
}

TEST_F(Csv, EmptyCellsAreUnknownWhereATableMayHaveThem) {
  put("a,b\n1,\n,2\n");
  EXPECT_THROW(read_csv(path_), FileError);
  const CsvTable table = read_csv(path_, EmptyCells::unknown);
  EXPECT_EQ(table.rows[0][0], 1.0);
  EXPECT_TRUE(std::isnan(table.rows[0][1]));
  EXPECT_TRUE(std::isnan(table.rows[1][0]));
}

TEST_F(Csv, DropsTheRowThatAKilledWriterLeftUnfinished) {
  put("a,b\n1,2\n");
  EXPECT_FALSE(read_csv(path_).cut_off);
  // The last may be the beginning of 3,4.25.
  for (const char* rest : {"3", "3,", "3,4", "3,4.", "3,4e", "3,4.2"}) {
    put(std::string("a,b\n1,2\n") + rest);
    const CsvTable table = read_csv(path_);
    EXPECT_EQ(table.rows.size(), 1u) << rest;
    EXPECT_TRUE(table.cut_off) << rest;
  }
}

TEST_F(Csv, NumbersThatAreNoneAreRefusedWithTheirPlace) {
  for (const auto& [field, fault] : std::vector<std::pair<std::string, std::string>>{
           {"inf", " holds 'inf', which is not finite"},
           {"-nan", " holds '-nan', which is not finite"},
           {"1e400", " holds '1e400', which is not a number"},
           {"", " is empty where a number should be"},
           {"1 2", " holds '1 2', which is not a number"},
           {std::string("1\0", 2), " holds '1\\x00', which is not a number"}}) {
    put("a,b\n1,2\n3," + field + "\n");
    try {
      read_csv(path_);
      ADD_FAILURE() << "accepted " << field;
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), path_ + ":3: column b" + fault);
    }
  }
}

TEST_F(Csv, HeadersNameEveryColumnOnce) {
  for (const char* header : {"a,b,a", "a,,b", "a,b,"}) {
    put(std::string(header) + "\n1,2,3\n");
    EXPECT_THROW(read_csv(path_), FileError) << header;
  }
}

TEST_F(Csv, ALinkInItsPlaceIsNotFollowed) {
  const std::string victim = path_ + ".victim";
  std::ofstream(victim) << "mine";
  std::filesystem::create_symlink(victim, path_);
  CsvWriter(path_, {"a"}).write_row({1.0});
  std::ostringstream left;
  left << std::ifstream(victim).rdbuf();
  EXPECT_EQ(left.str(), "mine");
  EXPECT_EQ(text(), "a\n1\n");
  std::filesystem::remove(victim);
}

TEST_F(Csv, FaultsNameFileAndLine) {
  put("a,b\n1,2\n3,four\n");
  try {
    read_csv(path_);
    FAIL() << "accepted a word";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              path_ + ":3: column b holds 'four', which is not a number");
  }
  put("a,b\n1\n2,3\n");
  EXPECT_THROW(read_csv(path_), FileError);
  put("");
  EXPECT_THROW(read_csv(path_), FileError);
  EXPECT_THROW(read_csv("/no/such/file.csv"), FileError);
  EXPECT_THROW(CsvWriter("/no/such/folder/x.csv", {"a"}), FileError);
  CsvWriter writer(path_, {"a", "b"});
  EXPECT_THROW(writer.write_row({1.0}), FileError);
}

}  // namespace
}  // namespace perilink
