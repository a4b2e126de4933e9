#include "app/commands/plot_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <pugixml.hpp>

#include "base/error.hpp"
#include "results/history_file.hpp"
#include "support/cracked_field.hpp"
#include "support/temporary_directory.hpp"

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
  for (const char* name : {"load_displacement.svg", "fields_5.svg", "fields_6.svg"}) {
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

TEST_F(Plot, FaultsAreReported) {
  EXPECT_THROW(plot_results({"/no/such/folder", "", 0.0}), FileError);
  write_fields();
  fs::remove(directory_ / "a.vtu");
  EXPECT_THROW(plot_results({directory_.string(), "", 0.0}), FileError);
}

}  // namespace
}  // namespace perilink
