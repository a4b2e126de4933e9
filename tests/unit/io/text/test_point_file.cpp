#include "io/text/point_file.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/files.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

class PointFile : public testing::Test {
 protected:
  PointValues read(const std::string& text, int dim = 2, const std::string& column = "factor") {
    write_whole_file(path_, text);
    return read_point_file(path_, dim, column);
  }
  /// Expects a message with this text at the line and column.
  void refuses(const std::string& text, int line, const std::string& key, const std::string& fault,
               int dim = 2) {
    try {
      read(text, dim);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().file, path_);
      EXPECT_EQ(error.where().line, line) << error.what();
      EXPECT_EQ(error.where().key, key) << error.what();
      EXPECT_NE(std::string(error.what()).find(fault), std::string::npos) << error.what();
    }
  }

  const test::TemporaryDirectory folder_;
  const std::string path_ = (folder_.path() / "strength.csv").string();
};

TEST_F(PointFile, HoldsAPointPerRow) {
  const PointValues points = read("x,y,factor\n0,0.5,1.25\n\n-1e2, 3 ,2\n");
  EXPECT_EQ(points.positions, (std::vector<double>{0, 0.5, -100, 3}));
  EXPECT_EQ(points.values, (std::vector<double>{1.25, 2}));
  EXPECT_EQ(points.lines, (std::vector<int>{2, 4}));
}

/// Windows' line ends, a mark of UTF-8, no line end at the end; numpy's "# ", R's quotes.
TEST_F(PointFile, MayComeFromOtherPrograms) {
  for (const char* text :
       {"\xef\xbb\xbfx,y,factor\r\n1,2,3\r\n4,5,6\r\n", "x,y,factor\n1,2,3\n4,5,6",
        "# x,y,factor\n1,2,3\n4,5,6\n", "\"x\",\"y\",\"factor\"\n1,2,3\n4,5,6\n",
        "factor,y,other,x\n3,2,none,1\n6,5,,4\n"}) {
    const PointValues points = read(text);
    EXPECT_EQ(points.positions, (std::vector<double>{1, 2, 4, 5})) << text;
    EXPECT_EQ(points.values, (std::vector<double>{3, 6})) << text;
  }
}

TEST_F(PointFile, HasANamedColumnOfValuesAndAThirdCoordinate) {
  const PointValues points = read("x,y,z,strength,energy\n1,2,3,4,5\n6,7,8,9,10\n", 3, "energy");
  EXPECT_EQ(points.positions, (std::vector<double>{1, 2, 3, 6, 7, 8}));
  EXPECT_EQ(points.values, (std::vector<double>{5, 10}));
}

TEST_F(PointFile, IsRefusedAtItsHeader) {
  refuses("", 0, "", "is empty\n  write the header x,y,factor");
  refuses("\xef\xbb\xbf\n\n", 0, "", "is empty");
  refuses("0,0,1\n1,1,2\n", 1, "", "has the header '0,0,1' without the column x");
  refuses("\nx,y,strength\n", 2, "", "without the column factor");
  refuses("\nx,y,strength\n", 2, "", "; `column` in the case names another one");
  refuses("x;y;factor\n", 1, "", "separated by commas: x,y,factor");
  refuses("x,y,x,factor\n", 1, "", "has 2 columns with the name x");
  refuses("x,y,factor\n0,0,1\n1,1,2\n", 1, "", "without the column z", 3);
  refuses("x,y,z,factor\n0,0,0,1\n", 1, "", "a column z, but the body is two-dimensional");
}

TEST_F(PointFile, IsRefusedAtARow) {
  refuses("x,y,factor\n0,0,1\n1,1\n", 3, "", "has 2 fields, but the header names 3");
  refuses("x,y,factor\n0,0,1,5\n", 2, "", "has 4 fields, but the header names 3");
  refuses("x,y,factor\n0,0,one\n", 2, "factor", "is 'one', which is not a number");
  refuses("x,y,factor\n0,0,1 2\n", 2, "factor", "is '1 2', which is not a number");
  refuses("x,y,factor\n\n0,,1\n", 3, "y", "is empty");
  for (const char* value : {"0", "-1", "nan", "inf", "1e51", "1e999"}) {
    refuses(std::string("x,y,factor\n0,0,1\n1,1,") + value + "\n", 3, "factor",
            std::string("is '") + value + "'\n  write positive numbers up to 1e50");
  }
  refuses("x,y,factor\nnan,0,1\n", 2, "x", "is 'nan'\n  write numbers between -1e50 and 1e50");
}

TEST_F(PointFile, HasTwoPointsOrMore) {
  refuses("x,y,factor\n", 0, "", "has 0 points\n  give at least two");
  refuses("x,y,factor\n1,2,3", 0, "", "has 1 point\n");
}

TEST_F(PointFile, ExistsAndIsAFile) {
  EXPECT_THROW(read_point_file(path_ + ".missing", 2, "factor"), FileError);
  EXPECT_THROW(read_point_file(folder_.path().string(), 2, "factor"), FileError);
}

}  // namespace
}  // namespace perilink
