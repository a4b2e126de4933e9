// Options of `perilink plot`, and the conditions that `perilink check` prints.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

using testing::HasSubstr;

class Views : public testing::Test {
 protected:
  Views() { std::filesystem::create_directories(work()); }
  std::filesystem::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  void write_case(const std::string& name, const std::string& text) const {
    write_text(work() / name, text);
  }

  TemporaryDirectory temporary_;
};

/// Bonds are cut at x = 0, 0.25 and 0.5, half a spacing around each.
TEST_F(Views, CheckTellsWhereACrackEnds) {
  write_case("strip.toml",
             tension_strip_case + std::string("[[cracks]]\npoints = [[-1, 0.4], [0.6, 0.4]]\n"));
  EXPECT_THAT(run({"check", "strip.toml"}).out,
              HasSubstr("crack 1            ends at (0.6, 0.4) as drawn; bonds are cut up to 0.025 "
                        "ahead of it\n"));
}

TEST_F(Views, CheckTellsStages) {
  std::string text = small_ghost_case;
  text.replace(text.find("rigid_body_modes = \"pin\""), 24, "");
  text.replace(text.find("[stop]\nbroken_bonds = 30"), 24,
               "[[stages]]\nname = \"pull\"\nbroken_bonds = 30\n[[stages]]\nname = "
               "\"back\"\nloads = \"pull\"\nto = 0\n");
  text.replace(text.find("[[loads]]\nregion = \"lower cap\"\nforce = [0, -100]"), 48,
               "[[supports]]\nregion = \"lower cap\"\nfix = [\"x\", \"y\"]");
  write_case("small.toml", text);
  const ProcessEnd end = run({"check", "small.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("stage 1            pull: to 30 broken bonds, loads (0, 100)\n"));
  EXPECT_THAT(end.out, HasSubstr("stage 2            back: to load factor 0, loads of pull\n"));
}

TEST_F(Views, PlotDrawsTheFieldAtThePeakAndColumns) {
  write_case("small.toml", small_ghost_case);
  ASSERT_EQ(run({"run", "small.toml", "--out", "r", "--quiet"}).exit_status, 0);
  const ProcessEnd field =
      run({"plot", "r", "--at", "peak", "--field", "smallest principal stres"});
  EXPECT_EQ(field.exit_status, 2);
  EXPECT_THAT(field.err, HasSubstr("did you mean `smallest principal stress`?"));
  const ProcessEnd peak =
      run({"plot", "r", "--at", "peak", "--field", "principal_stress", "--range", "-1", "1"});
  EXPECT_EQ(peak.exit_status, 0) << peak.err;
  EXPECT_THAT(peak.out, testing::EndsWith("_principal_stress.svg\n"));
  const ProcessEnd curve = run({"plot", "r", "--x", "step", "--y", "broken_bonds"});
  EXPECT_EQ(curve.out, "r/broken_bonds_over_step.svg\n") << curve.err;
}

}  // namespace
}  // namespace perilink::test
