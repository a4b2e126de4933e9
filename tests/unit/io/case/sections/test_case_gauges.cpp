#include "io/case/sections/case_gauges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string elastic = std::string(small_case) + "[analysis]\ntype = \"elastic\"\n";

std::string with_gauge(const std::string& keys) { return elastic + "[[gauges]]\n" + keys; }

TEST(CaseGauges, ReadBackFromWhatIsWritten) {
  const std::string text = with_gauge(
      "name = \"mouth\"\nbetween = [[0, 0], [1, 0]]\n"
      "[[gauges]]\nname = \"slip-2\"\nbetween = [[0, 0], [1, 0]]\naxis = \"y\"\n"
      "[[gauges]]\nname = \"tip\"\nat = [1, 2]\naxis = \"x\"\n"
      "[[gauges]]\nname = \"mean\"\nregion = \"surface\"\nstress = \"xy\"\n");
  for (const CaseFile& input :
       {parse_case(text, ""), parse_case(write_case(parse_case(text, "")), "")}) {
    ASSERT_EQ(input.gauges.size(), 4u);
    EXPECT_EQ(input.gauges[0].name, "mouth");
    EXPECT_EQ(input.gauges[0].between[1], (Vector3{1.0, 0.0, 0.0}));
    EXPECT_FALSE(input.gauges[0].axis);
    EXPECT_EQ(input.gauges[1].axis, 1);
    EXPECT_EQ(input.gauges[2].at, (Vector3{1.0, 2.0, 0.0}));
    EXPECT_EQ(input.gauges[2].axis, 0);
    EXPECT_EQ(input.gauges[3].region, "surface");
    EXPECT_EQ(input.gauges[3].stress, (std::array{0, 1}));
  }
}

TEST(CaseGauges, RefuseWhatCannotBeMeasured) {
  EXPECT_THAT(message_of(with_gauge("at = [0, 0]\naxis = \"x\"\n")),
              HasSubstr("heading of its column"));
  for (const std::string name : {"a b", "-1", "=a", ""}) {
    EXPECT_THAT(message_of(with_gauge("name = \"" + name + "\"\nat = [0, 0]\naxis = \"x\"\n")),
                HasSubstr("use letters, digits, _ and -"));
  }
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\naxis = \"x\"\n")),
              HasSubstr("none of `between`, `at`, `region`, `reaction` or `cracks`"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nat = [0, 0]\n")),
              HasSubstr("none of `axis` or `stress`"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nat = [0, 0]\naxis = \"z\"\n")),
              HasSubstr("Allowed: x, y"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nat = [0, 0]\nstress = \"yx\"\n")),
              HasSubstr("Allowed: xx, yy, xy"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nbetween = [[0, 0]]\n")),
              HasSubstr("holds 1 point"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nbetween = [[0, 0], [1, 1]]\nstress = \"xx\"\n")),
              HasSubstr("measure a stress `at` a point"));
  EXPECT_THAT(message_of(with_gauge("name = \"a\"\nregion = \"blok\"\naxis = \"x\"\n")),
              HasSubstr("did you mean `block`?"));
  const std::string twice = "name = \"a\"\nat = [0, 0]\naxis = \"x\"\n";
  EXPECT_THAT(message_of(with_gauge(twice + "[[gauges]]\n" + twice)),
              HasSubstr("gauges[2].name: is \"a\", the name of another gauge"));
  EXPECT_THAT(message_of(std::string(small_case) +
                         "[analysis]\ntype = \"relaxation\"\nstrain = \"green\"\n"
                         "[[gauges]]\nname = \"a\"\nat = [0, 0]\nstress = \"xx\"\n"),
              HasSubstr("whose forces turn with the body"));
}

TEST(CaseGauges, SpellComponentsByTheirAxes) {
  EXPECT_EQ(stress_name({0, 2}), "xz");
  EXPECT_EQ(stress_name({1, 1}), "yy");
}

}  // namespace
}  // namespace perilink
