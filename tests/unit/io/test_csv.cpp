#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "io/csv.hpp"

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
                                      std::numeric_limits<double>::infinity(),
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
  put("step, load\r\n1, 2.5\r\n2,\r\n");
  const CsvTable table = read_csv(path_);
  EXPECT_EQ(table.column("load"), 1);
  EXPECT_EQ(table.column("loads"), -1);
  EXPECT_EQ(table.rows[0][1], 2.5);
  EXPECT_TRUE(std::isnan(table.rows[1][1]));
}

TEST_F(Csv, DropsTheRowThatAKilledWriterLeftUnfinished) {
  put("a,b\n1,2\n3");
  EXPECT_EQ(read_csv(path_).rows.size(), 1u);
}

TEST_F(Csv, FaultsNameFileAndLine) {
  put("a,b\n1,2\n3,four\n");
  try {
    read_csv(path_);
    FAIL() << "accepted a word";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()), path_ + ":3: 'four' is not a number");
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
