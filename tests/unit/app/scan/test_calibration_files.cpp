#include "app/scan/calibration_files.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/checkpoint/pack.hpp"
#include "model/from_case/configure.hpp"
#include "support/process.hpp"
#include "support/replaced.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

class KeptCalibrations : public testing::Test {
 protected:
  fs::path directory() const { return temporary_ / "calibrations"; }
  int number_of_files() const {
    int number = 0;
    for (const auto& entry : fs::directory_iterator(directory())) number += entry.is_regular_file();
    return number;
  }
  /// Builds a model with the directory. \return number of solutions of the calibration
  int build(const std::string& text, Model& model) {
    CalibrationFiles files(directory());
    int searches = 0;
    model = build_model(parse_case(text, "case.toml"), {[&](int, double) { ++searches; }, &files});
    return searches;
  }

  test::TemporaryDirectory temporary_;
};

constexpr const char* calibrated = "[body]\nsurface = \"calibrated\"\n";

TEST_F(KeptCalibrations, ServeBodiesThatDifferInStrengthOnly) {
  const std::string plane = replaced(test::strip_text, "[body]\n", calibrated);
  const std::string micropolar =
      replaced(replaced(plane, "[body]\n", "[body]\nmodel = \"micropolar\"\n"), "youngs_modulus",
               "poissons_ratio = 0.2\nyoungs_modulus");
  const std::string space = replaced(test::prism_text, "[body]\n", calibrated);
  int kept = 0;
  for (const std::string& text : {plane, micropolar, space}) {
    const std::string tough = replaced(text, "fracture_energy = 0.001", "fracture_energy = 0.004");
    const Model fresh = build_model(parse_case(tough, "case.toml"));
    Model first, second;
    EXPECT_GT(build(text, first), 0);
    EXPECT_EQ(number_of_files(), ++kept);
    EXPECT_EQ(build(tough, second), 0) << "taken from the files";
    EXPECT_EQ(number_of_files(), kept);
    EXPECT_EQ(second.network.stiffness, fresh.network.stiffness);
    EXPECT_EQ(second.network.bending, fresh.network.bending);
    EXPECT_EQ(second.network.inflection, fresh.network.inflection);
    EXPECT_EQ(second.network.facets.shares, fresh.network.facets.shares);
    EXPECT_EQ(second.network.critical_stretch, fresh.network.critical_stretch);
    EXPECT_EQ(second.network.report.calibration->iterations,
              fresh.network.report.calibration->iterations);
    EXPECT_NE(second.network.critical_stretch, first.network.critical_stretch);
  }
}

TEST_F(KeptCalibrations, DoNotServeOtherBodies) {
  const std::string plane = replaced(test::strip_text, "[body]\n", calibrated);
  Model model;
  build(plane, model);
  EXPECT_GT(build(replaced(plane, "youngs_modulus = 3000", "youngs_modulus = 3001"), model), 0);
  EXPECT_GT(build(replaced(plane, "thickness = 2.0", "thickness = 2.5"), model), 0);
  EXPECT_EQ(number_of_files(), 3);
}

TEST_F(KeptCalibrations, DamagedFilesAreReplaced) {
  const std::string plane = replaced(test::strip_text, "[body]\n", calibrated);
  Model model;
  build(plane, model);
  const std::string path = fs::directory_iterator(directory())->path().string();
  std::string bytes = read_regular_file(path);
  bytes[bytes.size() / 2] ^= 1;
  write_whole_file(path, bytes);
  EXPECT_GT(build(plane, model), 0);
  EXPECT_EQ(build(plane, model), 0);
}

TEST_F(KeptCalibrations, AreComparedByTheWholeKey) {
  CalibrationFiles files(directory());
  const KeptCalibration one{{}, {1.0}, {}}, another{{}, {2.0}, {}};
  files.keep("one body", one);
  EXPECT_EQ(files.find("one body")->shares, one.shares);
  files.keep("another", another);
  fs::copy_file(directory() / "one body.calibration", directory() / "another.calibration",
                fs::copy_options::overwrite_existing);
  EXPECT_FALSE(files.find("another")) << "a file with the right name and another body";
}

TEST_F(KeptCalibrations, HaveTheSameBytesInEveryRun) {
  const std::string plane = replaced(test::strip_text, "[body]\n", calibrated);
  std::vector<std::string> contents;
  for (int run = 0; run < 2; ++run) {
    Model model;
    build(plane, model);
    const fs::path path = fs::directory_iterator(directory())->path();
    KeptCalibration kept = *CalibrationFiles(directory()).find(path.stem().string());
    kept.report.seconds = 0.0;
    contents.push_back(path.stem().string() + pack(kept));
    fs::remove(path);
  }
  EXPECT_EQ(contents[0], contents[1]);
}

TEST_F(KeptCalibrations, NeedADirectory) {
  write_whole_file((temporary_ / "file").string(), "");
  fs::create_symlink("loop", temporary_ / "loop");
  for (const fs::path& bad : {temporary_ / "file", temporary_ / "loop", fs::path()}) {
    EXPECT_THROW(CalibrationFiles{bad}, FileError) << bad;
  }
}

TEST_F(KeptCalibrations, ThatCannotBeReadOrWrittenAreMadeAgain) {
  CalibrationFiles files(directory());
  fs::create_symlink("key.calibration", directory() / "key.calibration");
  EXPECT_FALSE(files.find("key"));
  fs::remove_all(directory());
  EXPECT_NO_THROW(files.keep("key", {}));
  EXPECT_FALSE(files.find(std::string(300, 'k')));
}

}  // namespace
}  // namespace perilink
