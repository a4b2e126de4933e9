#include "app/commands/plot_command.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <pugixml.hpp>

#include "base/error.hpp"
#include "io/fields/animated_png.hpp"
#include "results/history_file.hpp"
#include "support/cracked_field.hpp"
#include "support/temporary_directory.hpp"
#include "support/tiny_png.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

class Plot : public ::testing::Test {
 protected:
  Plot() {
    HistoryFile history(directory_.string(), {});
    for (int k = 0; k < 5; ++k) {
      StepRecord record;
      record.step = k;
      record.load_factor = record.load = 5.0 - k;
      record.displacement = 0.1 * (k + 1);
      history.append(record);
    }
  }

  void write_fields() const {
    VtuGrid grid = test::make_cracked_field({}, true);
    write_vtu((directory_ / "a.vtu").string(), grid);
    for (auto& [name, value] : grid.field_data) value += name == "step";
    write_vtu((directory_ / "b.vtu").string(), grid);
    write_pvd((directory_ / "fields.pvd").string(), {{5.0, "a.vtu"}, {6.0, "b.vtu"}});
  }
  std::string text(const std::string& name) const { return test::read_text(directory_ / name); }

  test::TemporaryDirectory temporary_;
  fs::path directory_ = temporary_.path();
};

TEST_F(Plot, DrawsCurveAndFields) {
  write_fields();
  std::ofstream(directory_ / "summary.json")
      << R"({"status": "completed", "title": "Beam <1>", "units": "kip, in"})";
  EXPECT_EQ(plot_results({directory_.string(), "", 0.0}), 0);
  // The second file of the series has the same number of broken bonds, in the next row.
  for (const char* name : {"load_displacement.svg", "fields_000005.svg", "fields_000006.svg"}) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_file((directory_ / name).c_str())) << name;
    EXPECT_NE(text(name).find("Beam &lt;1&gt;"), std::string::npos) << name;
  }
  EXPECT_NE(text("load_displacement.svg").find("displacement (in)"), std::string::npos);
}

/// Rows do not show whether the load vibrates, or which particles cracked before the first row.
TEST_F(Plot, TakesTheFirstPeakFromTheSummary) {
  const auto drawn = [&](const std::string& summary) {
    std::ofstream(directory_ / "summary.json") << R"({"status": "completed", )" << summary << "}";
    EXPECT_EQ(plot_results({directory_.string(), "", 0.0}), 0);
    return text("load_displacement.svg");
  };
  EXPECT_NE(drawn(R"("first_peak_load": 3, "first_peak_displacement": 0.3)")
                .find(">first peak 3 at 0.3<"),
            std::string::npos);
  EXPECT_EQ(drawn(R"("first_peak_load": 5, "first_peak_displacement": 0.1)").find("first peak"),
            std::string::npos);
  EXPECT_EQ(drawn(R"("first_peak_load": null)").find("first peak"), std::string::npos);
}

/// Rows of any run can resemble those of single breaks.
TEST_F(Plot, TakesTheKindOfTheRunFromTheSummary) {
  {
    HistoryFile history(directory_.string(), {});
    StepRecord record;
    for (record.step = 0; record.step < 300; ++record.step) {
      record.broken_bonds = record.step;
      record.displacement = 1.0 + 0.01 * record.step;
      record.load = 300.0 - record.step;
      record.strain_energy = 0.5 * record.load * record.displacement;
      history.append(record);
    }
  }
  const auto draws_envelope = [&](const std::string& summary) {
    std::ofstream(directory_ / "summary.json") << R"({"status": "completed", )" << summary << "}";
    EXPECT_EQ(plot_results({directory_.string(), "", 0.0}), 0);
    return text("load_displacement.svg").find("smoothed curve") != std::string::npos;
  };
  EXPECT_TRUE(draws_envelope(R"("analysis": "damage")"));
  EXPECT_FALSE(draws_envelope(R"("analysis": "explicit")"));
  EXPECT_FALSE(draws_envelope(R"("analysis": "relaxation")"));
  EXPECT_TRUE(draws_envelope(R"("title": "Beam")")) << "of an earlier version: the rows decide";
}

TEST_F(Plot, WritesWhereItIsToldTo) {
  const fs::path out = directory_ / "pictures" / "here";
  EXPECT_EQ(plot_results({directory_.string(), out.string(), 0.0}), 0);
  EXPECT_TRUE(fs::exists(out / "load_displacement.svg"));
  EXPECT_FALSE(fs::exists(directory_ / "load_displacement.svg"));
}

TEST_F(Plot, WithoutASummaryTheDirectoryIsTheTitle) {
  std::ofstream(directory_ / "summary.json") << "{ half a fi";
  EXPECT_THROW(plot_results({directory_.string(), "", 0.0}), FileError);
  fs::remove(directory_ / "summary.json");
  testing::internal::CaptureStderr();
  EXPECT_EQ(plot_results({directory_.string() + "/", "", 0.0}), 0);
  EXPECT_NE(
      testing::internal::GetCapturedStderr().find("note: the run is not finished or was killed"),
      std::string::npos);
  EXPECT_NE(text("load_displacement.svg").find(">" + directory_.filename().string() + "<"),
            std::string::npos);
}

TEST_F(Plot, DrawsAColumnOverAnother) {
  std::ofstream(directory_ / "summary.json") << R"({"status": "completed", "units": "kip, in"})";
  PlotOptions options{directory_.string(), "", 0.0};
  options.y = "strain_energy";
  EXPECT_EQ(plot_results(options), 0);
  const std::string drawn = text("strain_energy_over_displacement.svg");
  EXPECT_NE(drawn.find("displacement (in)"), std::string::npos);
  EXPECT_NE(drawn.find("strain energy (kip in)"), std::string::npos);
  EXPECT_FALSE(fs::exists(directory_ / "load_displacement.svg")) << "only the curve asked for";
}

TEST_F(Plot, UnknownNamesAreRefusedWithASuggestion) {
  write_fields();
  const auto fault = [&](PlotOptions options) {
    options.directory = directory_.string();
    try {
      plot_results(options);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  PlotOptions options;
  options.x = "displacment";
  EXPECT_NE(fault(options).find("--x displacment: history.csv has no such column\n"
                                "  did you mean `displacement`?"),
            std::string::npos);
  options.x.clear();
  options.field = "damages";
  EXPECT_NE(fault(options).find("did you mean `damage`?"), std::string::npos);
  options.field.clear();
  options.range = {2.0, 1.0};
  EXPECT_NE(fault(options).find("--range 2 1: the first number must be below"), std::string::npos);
  options.range.clear();
  options.at = "3";
  EXPECT_NE(fault(options).find("there is no file of fields of row 3"), std::string::npos);
}

TEST_F(Plot, DrawsTheFieldOfARow) {
  const VtuGrid grid = test::make_cracked_field({}, true);
  write_vtu((directory_ / "fields_000000.vtu").string(), grid);
  write_vtu((directory_ / "fields_000002.vtu").string(), grid);
  write_pvd((directory_ / "fields.pvd").string(),
            {{0.0, "fields_000000.vtu"}, {2.0, "fields_000002.vtu"}});
  PlotOptions options{directory_.string(), "", 0.0};
  options.at = "peak";  // the first row has the largest load
  options.field = "displacement_x";
  options.range = {0.0, 300.0};
  EXPECT_EQ(plot_results(options), 0);
  const std::string drawn =
      text("fields_000005_displacement_x.svg");  // the file says that it is row 5
  EXPECT_NE(drawn.find(">displacement x<"), std::string::npos);
  EXPECT_NE(drawn.find(">200<"), std::string::npos) << "a tick of the range";
  EXPECT_FALSE(fs::exists(directory_ / "load_displacement.svg"));
}

TEST_F(Plot, PngNeedsItsProgram) {
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  setenv("PATH", directory_.c_str(), 1);
  PlotOptions options{directory_.string(), "", 0.0};
  options.png = true;
  EXPECT_THROW(plot_results(options), FileError);
  EXPECT_FALSE(fs::exists(directory_ / "load_displacement.svg"));
  std::ofstream(directory_ / "rsvg-convert")
      << "#!/bin/sh\necho \"$@\" > " << directory_.string() << "/words\n";
  fs::permissions(directory_ / "rsvg-convert", fs::perms::owner_all);
  setenv("PATH", (directory_.string() + ":" + before).c_str(), 1);
  EXPECT_EQ(plot_results(options), 0);
  setenv("PATH", before.c_str(), 1);
  EXPECT_NE(text("words").find("load_displacement.png"), std::string::npos);
}

/// All frames have one view and scale, also that before the body moved.
TEST_F(Plot, AnimatesAllFilesOfFields) {
  VtuGrid grid = test::make_cracked_field({}, true);
  const auto value = [&](const char* name) -> double& {
    return std::ranges::find(grid.field_data, name, &std::pair<std::string, double>::first)->second;
  };
  std::vector<PvdEntry> series;
  for (const int row : {1, 2, 4, 100}) {
    value("step") = row;
    for (VtuArray& field : grid.point_data) {
      if (field.name == "displacement") {
        for (double& u : field.values) u = row == 1 ? 0.0 : u + 1.0;
      }
    }
    const std::string name = fmt::format("fields_{:06}.vtu", row);
    write_vtu((directory_ / name).string(), grid);
    series.push_back({1.0 * row, name});
  }
  write_pvd((directory_ / "fields.pvd").string(), series);
  test::write_text(directory_ / "frame.png", test::tiny_png(2, "pixels"));
  std::ofstream(directory_ / "rsvg-convert")
      << "#!/bin/sh\n/bin/cp " << (directory_ / "frame.png").string() << " \"$6\"\n";
  fs::permissions(directory_ / "rsvg-convert", fs::perms::owner_all);
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  setenv("PATH", directory_.c_str(), 1);
  PlotOptions options{directory_.string(), "", 0.0};
  options.animation = true;
  options.whole = true;
  EXPECT_EQ(plot_results(options), 0);
  setenv("PATH", before.c_str(), 1);

  const std::vector<std::string> frames(3, test::tiny_png(2, "pixels"));
  EXPECT_EQ(text("animation.png"), animated_png(frames, 200)) << "row 100 is not in the history";
  EXPECT_FALSE(fs::exists(directory_ / "load_displacement.svg"));
  const auto head = [&](const char* name) {
    const std::string drawn = text(name);
    return drawn.substr(0, drawn.find('>'));  // size of the page
  };
  EXPECT_EQ(head("fields_000001.svg"), head("fields_000004.svg"));
  const std::string scale = "displacements × ";
  const auto scale_of = [&](const char* name) {
    const std::string drawn = text(name);
    return drawn.substr(drawn.find(scale), scale.size() + 4);
  };
  EXPECT_EQ(scale_of("fields_000001.svg"), scale_of("fields_000004.svg"));
}

TEST_F(Plot, FaultsAreReported) {
  EXPECT_THROW(plot_results({"/no/such/folder", "", 0.0}), FileError);
  write_fields();
  fs::remove(directory_ / "a.vtu");
  EXPECT_THROW(plot_results({directory_.string(), "", 0.0}), FileError);
}

}  // namespace
}  // namespace perilink
