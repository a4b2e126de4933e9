#include "app/plot/plot_labels.hpp"

#include <gtest/gtest.h>

#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

TEST(PlotLabels, ComeFromTheSummary) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "summary.json",
                   R"({"status": "completed", "title": "Beam", "units": "kip,  in "})");
  const PlotLabels labels = read_labels(directory / "");
  EXPECT_EQ(labels.title, "Beam");
  EXPECT_EQ(labels.force, "kip");
  EXPECT_EQ(labels.length, "in");
  EXPECT_EQ(with_unit("load", labels.force), "load (kip)");
  EXPECT_EQ(in_unit("3", labels.length), "3 in");
}

TEST(PlotLabels, KnowAThirdUnitThatOfTime) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "summary.json",
                   R"({"status": "completed", "title": "Beam", "units": "N, mm, s"})");
  const PlotLabels labels = read_labels(directory / "");
  EXPECT_EQ(labels.force, "N");
  EXPECT_EQ(labels.length, "mm");
}

TEST(PlotLabels, WithoutASummaryTheTitleIsThatOfTheDirectory) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "beam");
  const PlotLabels labels = read_labels(directory / "beam");
  EXPECT_EQ(labels.title, "beam");
  EXPECT_EQ(labels.force, "");
  EXPECT_EQ(with_unit("load", labels.force), "load");
}

TEST(PlotLabels, SteerNoTerminal) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "summary.json",
                   R"({"status": "completed", "title": "\u001b[2JBeam", "units": "N,\u0007mm"})");
  const PlotLabels labels = read_labels(directory / "");
  EXPECT_EQ(labels.title, "\\x1b[2JBeam");
  EXPECT_EQ(labels.length, "\\x07mm");
}

TEST(PlotLabels, ADirectoryIsNamedByTheLastPartOfItsPath) {
  EXPECT_EQ(directory_name("results/beam"), "beam");
  EXPECT_EQ(directory_name("results/beam/"), "beam");
  EXPECT_EQ(directory_name("results/beam/."), "beam");
}

}  // namespace
}  // namespace perilink
