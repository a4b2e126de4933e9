#include "app/report/report_body.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.hpp"
#include "io/fields/vtu.hpp"
#include "support/cracked_field.hpp"
#include "support/decompressed.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::size_t>;

TEST(ReportBody, FewFilesAreAllShown) {
  EXPECT_EQ(shown_files(4, 10, 2), (Rows{0, 1, 2, 3}));
  EXPECT_EQ(shown_files(1, 10, 0), (Rows{0}));
  EXPECT_TRUE(shown_files(0, 10, 0).empty());
}

TEST(ReportBody, OfManyFilesFirstPeakAndLastStay) {
  EXPECT_EQ(shown_files(101, 5, 50), (Rows{0, 25, 50, 75, 100}));
  EXPECT_EQ(shown_files(101, 5, 60), (Rows{0, 25, 60, 75, 100}));
  EXPECT_EQ(shown_files(101, 0, 99), (Rows{0, 99, 100})) << "at least three";
}

class ReportBodies : public ::testing::Test {
 protected:
  void write(const std::string& name, const VtuGrid& grid) const {
    write_vtu((directory_ / name).string(), grid);
  }
  void list(const std::vector<PvdEntry>& entries) const {
    write_pvd((directory_ / "fields.pvd").string(), entries);
  }
  nlohmann::ordered_json body(std::size_t most = 1000000) {
    streams_ = {};
    return report_body(directory_, 5.0, most, UnitNames::of("N, mm"), streams_);
  }

  test::TemporaryDirectory temporary_;
  fs::path directory_ = temporary_.path();
  ReportStreams streams_;
};

TEST_F(ReportBodies, WithoutFieldsThereIsNone) {
  EXPECT_TRUE(body().is_null());
  list({});
  EXPECT_TRUE(body().is_null());
}

TEST_F(ReportBodies, HoldsParticlesBrokenBondsAndFields) {
  const VtuGrid grid = test::make_cracked_field({}, true);
  write("a.vtu", grid);
  list({{5.0, "a.vtu"}});
  const auto json = body();
  EXPECT_EQ(json["dimension"], 2);
  EXPECT_EQ(json["particles"], 25 * 8 + 2 * 25);
  EXPECT_EQ(json["broken"], 4);
  EXPECT_EQ(json["segments"], 24);
  EXPECT_EQ(json["fields"][0]["unit"], "mm");
  EXPECT_EQ(json["fields"][2]["name"], "damage");
  EXPECT_EQ(json["fields"][2]["shown"], (nlohmann::ordered_json{0, 1}));
  ASSERT_EQ(json["frames"].size(), 1u);
  EXPECT_EQ(json["frames"][0]["step"], 5.0);

  const std::size_t n = grid.points.size() / 3;
  const std::string stays = test::decompressed(streams_.texts().at(json["stream"]));
  ASSERT_EQ(stays.size(), 4 * (4 * n + 2 * 4 + 2 * 24 + 4));
  std::vector<float> x(n);
  std::memcpy(x.data(), stays.data(), 4 * n);
  std::vector<std::int32_t> broken(8);
  std::memcpy(broken.data(), stays.data() + 4 * 4 * n, 4 * 8);
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(x[i], static_cast<float>(grid.points[3 * i]));
  EXPECT_EQ(broken, (std::vector<std::int32_t>{12, 37, 62, 87, 13, 38, 63, 88}));
  EXPECT_EQ(test::decompressed(streams_.texts().at(json["frames"][0]["stream"])).size(), 2 * 3 * n);
}

TEST_F(ReportBodies, RangesAreThoseOfAllFiles) {
  VtuGrid grid = test::make_cracked_field({}, false);
  write("b.vtu", grid);
  for (double& u : grid.point_data[0].values) u *= 0.1;
  write("a.vtu", grid);
  list({{1.0, "a.vtu"}, {5.0, "b.vtu"}});
  const auto json = body();
  const double largest = 1e-4 * 0.5 * 2.0 * 8;  // opening at the lower edge
  EXPECT_FLOAT_EQ(json["fields"][0]["range"][1].get<float>(), static_cast<float>(largest));
  EXPECT_EQ(json["frames"].size(), 2u);
  EXPECT_EQ(json["files"], 2);
}

TEST_F(ReportBodies, FilesBeyondTheSizeAreLeftOut) {
  const VtuGrid grid = test::make_cracked_field({}, false);
  std::vector<PvdEntry> entries;
  for (int k = 0; k < 9; ++k) {
    entries.push_back({1.0 * k, std::to_string(k) + ".vtu"});
    write(entries.back().file, grid);
  }
  list(entries);
  EXPECT_EQ(body(100).at("frames").size(), 3u);
  EXPECT_EQ(body(100).at("files"), 9);
  EXPECT_EQ(body().at("frames").size(), 9u);
}

TEST_F(ReportBodies, OtherParticlesAreRefused) {
  write("a.vtu", test::make_cracked_field({}, true));
  write("b.vtu", test::make_cracked_field({}, false));
  list({{1.0, "a.vtu"}, {5.0, "b.vtu"}});
  EXPECT_THROW(body(), FileError);
}

}  // namespace
}  // namespace perilink
