#include "app/report/report_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "app/report/report_assets.hpp"
#include "support/decompressed.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page(bool is_running = false) {
  ReportStreams streams;
  streams.add("rows");
  const nlohmann::ordered_json runs = {{{"title", "</script><img src=x onerror=alert(1)>&'\""}}};
  return report_page(runs, streams, is_running);
}

TEST(ReportPage, TextsOfUsersCannotEndTheirElement) {
  EXPECT_EQ(json_for_page("</script>&\u00e9\xff"), R"("\u003c/script\u003e\u0026\u00e9\ufffd")");
  EXPECT_THAT(page(), Not(HasSubstr("<img src=x")));
}

// Only the page's own scripts end: the data, one stream, the library and the program.
TEST(ReportPage, HasAsManyScriptEndsAsBeginnings) {
  const std::string text = page();
  const auto count = [&](const char* pattern) {
    const std::regex word(pattern);
    return std::distance(std::sregex_iterator(text.begin(), text.end(), word), {});
  };
  EXPECT_EQ(count("</script>"), 4);
  EXPECT_EQ(count("<script[ >]"), 4);
}

TEST(ReportPage, NeedsNoOtherFile) {
  const std::regex outside(
      R"((src|href)\s*=\s*["']?(https?:)?//|url\((?!#)|@import|sourceMappingURL)");
  EXPECT_FALSE(std::regex_search(page(), outside));
}

TEST(ReportPage, HoldsTheStreams) {
  const std::string text = page(), begin = "id=\"stream-0\">";
  const std::size_t at = text.find(begin) + begin.size();
  EXPECT_EQ(test::decompressed(text.substr(at, text.find('<', at) - at)), "rows");
}

TEST(ReportPage, LoadsItselfAgainWhileTheRunGoesOn) {
  EXPECT_THAT(page(true), HasSubstr("http-equiv=\"refresh\""));
  EXPECT_THAT(page(false), Not(HasSubstr("http-equiv=\"refresh\"")));
}

TEST(ReportPage, ListsTheLicenceOfTheLibrary) {
  if (report_assets().dygraphs.empty()) GTEST_SKIP() << "built without dygraphs";
  EXPECT_THAT(std::string(report_assets().dygraphs_licence),
              HasSubstr("Permission is hereby granted, free of charge"));
  EXPECT_THAT(page(), HasSubstr("Permission is hereby granted, free of charge"));
}

}  // namespace
}  // namespace perilink
