#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "io/fields/vtu.hpp"
#include "support/replaced.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

/// Three particles, one line; enough points to need several compressed blocks when `copies` is
/// large.
VtuGrid make_grid(int copies) {
  VtuGrid grid;
  for (int i = 0; i < 3 * copies; ++i) {
    grid.points.insert(grid.points.end(), {0.1 * i, std::sin(i), 0.0});
    grid.types.push_back(VtuCell::vertex);
    grid.connectivity.push_back(i);
    grid.offsets.push_back(i + 1);
  }
  grid.types.push_back(VtuCell::line);
  grid.connectivity.insert(grid.connectivity.end(), {0, 2});
  grid.offsets.push_back(grid.offsets.back() + 2);
  grid.point_data = {{"displacement", 3, grid.points},
                     {"damage", 1, std::vector<double>(grid.points.size() / 3, 0.25)}};
  grid.cell_data = {{"element", 1, std::vector<double>(grid.types.size(), 1.0)}};
  grid.field_data = {{"load_factor", 1.0 / 3.0}, {"step", 7.0}};
  return grid;
}

class Vtu : public ::testing::Test {
 protected:
  Vtu() : path_(testing::TempDir() + "perilink_" + std::to_string(::getpid()) + ".vtu") {}
  ~Vtu() override { std::filesystem::remove(path_); }

  std::string text() const {
    std::ifstream file(path_);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void expect_fault(const std::string& content, const std::string& fault) const {
    std::ofstream(path_) << content;
    try {
      read_vtu(path_);
      ADD_FAILURE() << "accepted: " << fault;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(fault), std::string::npos) << error.what();
    }
  }

  std::string path_;
};

TEST_F(Vtu, ComesBackAsWritten) {
  const VtuGrid grid = make_grid(20000);
  write_vtu(path_, grid);
  const VtuGrid back = read_vtu(path_);
  EXPECT_EQ(back.points, grid.points);
  EXPECT_EQ(back.types, grid.types);
  EXPECT_EQ(back.connectivity, grid.connectivity);
  EXPECT_EQ(back.offsets, grid.offsets);
  EXPECT_EQ(back.field_data, grid.field_data);
  ASSERT_NE(back.find_point_data("displacement"), nullptr);
  EXPECT_EQ(back.find_point_data("displacement")->values, grid.points);
  EXPECT_EQ(back.find_point_data("displacement")->components, 3);
  ASSERT_NE(back.find_cell_data("element"), nullptr);
  EXPECT_EQ(back.find_cell_data("element")->values, grid.cell_data[0].values);
  EXPECT_EQ(back.find_point_data("element"), nullptr);
  EXPECT_EQ(back.field("step", 0.0), 7.0);
  EXPECT_EQ(back.field("absent", -1.0), -1.0);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".part"));
}

TEST_F(Vtu, EmptyGridComesBack) {
  write_vtu(path_, VtuGrid{});
  EXPECT_TRUE(read_vtu(path_).points.empty());
}

TEST_F(Vtu, RefusesToWriteWhatParaViewCannotOpen) {
  VtuGrid short_array = make_grid(1);
  short_array.point_data[1].values.pop_back();
  EXPECT_THROW(write_vtu(path_, short_array), FileError);
  VtuGrid unknown_point = make_grid(1);
  unknown_point.connectivity[0] = 3;
  EXPECT_THROW(write_vtu(path_, unknown_point), FileError);
  VtuGrid open_end = make_grid(1);
  open_end.connectivity.push_back(0);
  EXPECT_THROW(write_vtu(path_, open_end), FileError);
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_THROW(write_vtu("/no/such/folder/x.vtu", make_grid(1)), FileError);
}

TEST_F(Vtu, FaultsNameTheFileAndTheArray) {
  write_vtu(path_, make_grid(1));
  const std::string good = text();
  expect_fault(good.substr(0, good.size() / 2), "not XML");
  expect_fault("<VTKFile type=\"PolyData\"/>", "not a VTK file of type UnstructuredGrid");
  expect_fault(replaced(good, "vtkZLibDataCompressor", "vtkLZ4DataCompressor"), "zlib");
  expect_fault(replaced(good, "Name=\"damage\" NumberOfComponents=\"1\"",
                        "Name=\"damage\" NumberOfComponents=\"2\""),
               "'damage'");
  expect_fault(replaced(good, "\"UInt8\"", "\"Int8\""), "'types'");
  // The first array holds the load factor; its data start after a header of 32 bytes, 44 letters.
  const std::size_t data = good.find("NumberOfTuples=\"1\">") + 19 + 44;
  std::string damaged = good;
  damaged.replace(data, 4, "AAAA");
  expect_fault(damaged, "'load_factor'");
  EXPECT_THROW(read_vtu("/no/such/file.vtu"), FileError);
}

TEST_F(Vtu, SeriesComesBack) {
  write_pvd(path_, {{0.0, "fields_0.vtu"}, {0.1, "a & b.vtu"}});
  const std::vector<PvdEntry> entries = read_pvd(path_);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].time, 0.1);
  EXPECT_EQ(entries[1].file, "a & b.vtu");
  EXPECT_THROW(read_vtu(path_), FileError);
}

TEST_F(Vtu, SeriesDoNotLeaveTheirFolder) {
  for (const char* file : {"/etc/passwd", "../other/a.vtu", "sub/a.vtu", "..", ".", ""}) {
    write_pvd(path_, {{0.0, "fields_0.vtu"}, {1.0, file}});
    EXPECT_THROW(read_pvd(path_), FileError) << file;
  }
}

TEST_F(Vtu, NumbersThatAreNotFiniteAreRefused) {
  for (const double value : {HUGE_VAL, std::nan("")}) {
    VtuGrid grid;
    grid.points = {0.0, value, 0.0};
    write_vtu(path_, grid);
    EXPECT_THROW(read_vtu(path_), FileError);
    grid.points = {0.0, 0.0, 0.0};
    grid.point_data = {{"damage", 1, {value}}};
    write_vtu(path_, grid);
    EXPECT_THROW(read_vtu(path_), FileError);
  }
}

}  // namespace
}  // namespace perilink
