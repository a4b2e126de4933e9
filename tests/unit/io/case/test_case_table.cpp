#include "io/case/case_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace perilink {
namespace {

class CaseTableTest : public testing::Test {
 protected:
  const TomlValue root_ = parse_toml(
      "i = 3\nn = 2.5\nneg = -1\nb = true\nt = \"word\"\nl = [1, 2.5]\nk = [1, 2]\nw = [\"a\", "
      "\"b\"]\n"
      "v3 = [1, 2, 3]\nzero = -0.0\ns = \"green\"\n",
      "case.toml");
  const CaseTable table_{root_, "table", "case.toml"};
};

TEST_F(CaseTableTest, ReadsEveryType) {
  EXPECT_EQ(table_.integer("i", 0, 5), 3);
  EXPECT_EQ(table_.number("i"), 3.0) << "integers are numbers";
  EXPECT_EQ(table_.number("n", allowed::positive), 2.5);
  EXPECT_EQ(table_.boolean("b"), true);
  EXPECT_EQ(table_.text("t"), "word");
  EXPECT_EQ(table_.choice("t", {"other", "word"}), "word");
  EXPECT_EQ(table_.choice<Strain>("s"), Strain::green);
  EXPECT_EQ(table_.numbers("l"), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(table_.integers("k", 1, 2), (std::vector<int>{1, 2}));
  EXPECT_EQ(table_.texts("w"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table_.vector("l", 2), (Vector3{1.0, 2.5, 0.0}));
  EXPECT_FALSE(std::signbit(*table_.number("zero")));
}

TEST_F(CaseTableTest, ReadsNothingWhereTheKeyIsAbsent) {
  EXPECT_EQ(table_.integer("absent", 0, 5), std::nullopt);
  EXPECT_EQ(table_.number("absent"), std::nullopt);
  EXPECT_EQ(table_.boolean("absent"), std::nullopt);
  EXPECT_EQ(table_.text("absent"), std::nullopt);
  EXPECT_EQ(table_.choice<Strain>("absent"), std::nullopt);
  EXPECT_EQ(table_.vector("absent", 2), std::nullopt);
  EXPECT_EQ(table_.texts("absent"), std::nullopt);
}

TEST_F(CaseTableTest, RefusesOtherTypesAndRanges) {
  EXPECT_THROW(table_.integer("n", 0, 5), InputError);
  EXPECT_THROW(table_.integer("i", 4, 5), InputError);
  EXPECT_THROW(table_.number("t"), InputError);
  EXPECT_THROW(table_.number("neg", allowed::positive), InputError);
  EXPECT_THROW(table_.number("zero", allowed::positive), InputError);
  EXPECT_THROW(table_.boolean("i"), InputError);
  EXPECT_THROW(table_.text("i"), InputError);
  EXPECT_THROW(table_.choice("t", {"other"}), InputError);
  EXPECT_THROW(table_.choice<Strain>("t"), InputError);
  EXPECT_THROW(table_.numbers("n"), InputError);
  EXPECT_THROW(table_.integers("l", 0, 5), InputError);
  EXPECT_THROW(table_.texts("k"), InputError);
  EXPECT_THROW(table_.vector("v3", 2), InputError);
}

TEST_F(CaseTableTest, NamesTheKeyOfAFault) {
  try {
    table_.boolean("n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, "table.n");
    EXPECT_EQ(error.where().line, 2);
    EXPECT_STREQ(error.what(),
                 "case.toml:2: table.n: is the number 2.5, but must be true or false\n"
                 "  write true or false without quotes");
  }
}

TEST_F(CaseTableTest, WantsExactlyOneOfExclusiveKeys) {
  EXPECT_NO_THROW(table_.need_one_of({"i", "absent"}));
  EXPECT_THROW(table_.need_one_of({"i", "n"}), InputError);
  EXPECT_THROW(table_.need_one_of({"absent", "missing"}), InputError);
  EXPECT_EQ(table_.need("i", table_.number("i"), "a number"), 3.0);
  EXPECT_THROW(table_.need("absent", table_.number("absent"), "a number"), InputError);
}

}  // namespace
}  // namespace perilink
