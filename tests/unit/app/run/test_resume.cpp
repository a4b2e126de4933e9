#include "app/run/resume.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "app/run/run_case.hpp"
#include "app/run/run_kind.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "results/summary_file.hpp"
#include "support/case_texts.hpp"
#include "support/gmsh_texts.hpp"
#include "support/replaced.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::string strip = std::string(test::strip_text) + R"(
[stop]
broken_bonds = 12
[output]
checkpoint_every = 4
)";

class Resume : public ::testing::Test {
 protected:
  /// Runs a case in the directory, from the checkpoint if there is one.
  std::string run(const std::string& text) {
    const CaseFile input = parse_case(text, "strip.toml");
    const Resumed found = find_results(input, work_.path());
    const auto run = make_run(input, 1, true);
    if (found.checkpoint) {
      require_same_model(*found.checkpoint, run->model_fingerprint(), work_.path());
    }
    write_whole_file((work_ / "case.toml").string(), write_case(input));
    run->open(work_.path(), true, found.checkpoint ? found.checkpoint->state : "");
    run->analyse();
    run->files().finish();
    write_summary_file(work_.path(), summary_of(*run, work_.path()).json);
    return read_regular_file((work_ / "history.csv").string());
  }
  std::string refusal(const std::string& text) const {
    try {
      find_results(parse_case(text, "strip.toml"), work_.path());
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  const test::TemporaryDirectory work_;
};

TEST_F(Resume, BeginsWhereThereAreNoResults) {
  const Resumed found = find_results(parse_case(strip, "strip.toml"), work_.path());
  EXPECT_FALSE(found.is_finished);
  EXPECT_FALSE(found.checkpoint);
}

TEST_F(Resume, KnowsARunThatHasEnded) {
  run(strip);
  EXPECT_TRUE(find_results(parse_case(strip, "strip.toml"), work_.path()).is_finished);
}

TEST_F(Resume, TakesADamagedSummaryForNoEnd) {
  run(strip);
  write_whole_file((work_ / "summary.json").string(), "");
  EXPECT_FALSE(find_results(parse_case(strip, "strip.toml"), work_.path()).is_finished);
}

TEST_F(Resume, KnowsARunFromOtherResults) {
  EXPECT_TRUE(holds_a_run(work_ / "nowhere"));
  write_whole_file((work_ / "summary.json").string(), "{}");
  EXPECT_TRUE(holds_a_run(work_.path())) << "killed as it began";
  write_whole_file((work_ / "history.csv").string(), "load\n");
  EXPECT_FALSE(holds_a_run(work_.path())) << "of another program";
  write_whole_file((work_ / "case.toml").string(), "");
  EXPECT_TRUE(holds_a_run(work_.path()));
  write_whole_file((work_ / "study.toml").string(), "");
  EXPECT_FALSE(holds_a_run(work_.path())) << "a study";
}

/// A run that goes on after its stop rule was raised has the bytes of one that was never stopped.
TEST_F(Resume, GoesOnWithARaisedStopRule) {
  const std::string more = replaced(strip, "broken_bonds = 12", "broken_bonds = 25");
  run(strip);
  const Resumed found = find_results(parse_case(more, "strip.toml"), work_.path());
  EXPECT_FALSE(found.is_finished);
  ASSERT_TRUE(found.checkpoint);
  const std::string gone_on = run(more);
  std::filesystem::remove_all(work_.path());
  std::filesystem::create_directories(work_.path());
  EXPECT_EQ(gone_on, run(more));
}

TEST_F(Resume, RefusesAnotherCaseAndSaysWhatDiffers) {
  run(strip);
  EXPECT_THAT(refusal(replaced(strip, "youngs_modulus = 3000.0", "youngs_modulus = 2000.0")),
              HasSubstr("`youngs_modulus = 3000` there, `youngs_modulus = 2000` here"));
}

/// Rows beyond a lowered rule would stay in the history.
TEST_F(Resume, RefusesALoweredStopRule) {
  run(strip);
  EXPECT_THAT(refusal(replaced(strip, "broken_bonds = 12", "broken_bonds = 11")),
              HasSubstr("stop.broken_bonds"));
  EXPECT_THAT(refusal(replaced(strip, "broken_bonds = 12", "broken_bonds = 12\ndisplacement = 1")),
              HasSubstr("stop.displacement"));
}

TEST_F(Resume, RefusesResultsWithoutTheirHistory) {
  const std::string more = replaced(strip, "broken_bonds = 12", "broken_bonds = 25");
  run(strip);
  std::filesystem::remove(work_ / "history.csv");
  for (const std::string& text : {strip, more}) {
    EXPECT_THAT(refusal(text), HasSubstr("history.csv: is missing")) << text;
    EXPECT_THAT(refusal(text), HasSubstr("begin it again with --force"));
  }
}

TEST_F(Resume, LeavesFilesThatItRefuses) {
  const CaseFile more =
      parse_case(replaced(strip, "broken_bonds = 12", "broken_bonds = 25"), "strip.toml");
  const auto contents = [&] {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(work_.path())) {
      files[entry.path().filename()] = read_regular_file(entry.path().string());
    }
    return files;
  };
  for (const char* name : {"timing.csv", "history.csv"}) {
    run(strip);
    std::filesystem::resize_file(work_ / name, 40);
    const auto before = contents();
    EXPECT_THAT(
        [&] {
          run_case(more, work_.path(), {1, OldResults::kept, true});
        },
        ThrowsMessage<FileError>(HasSubstr(std::string(name) + ": is shorter")));
    EXPECT_EQ(contents(), before) << name;
    std::filesystem::remove(work_ / "checkpoint.bin");
  }
}

/// A mesh may move; its contents may not change.
TEST_F(Resume, ComparesTheContentsOfMeshes) {
  const auto place_mesh = [&](const char* name, const std::string& text) {
    write_whole_file((work_ / name).string(), text);
    return fmt::format(
        "[body]\nproblem = \"plane_stress\"\nmesh = \"{}\"\nhorizon = 2\n"
        "[[regions]]\nname = \"plate\"\ngroup = \"plate\"\n"
        "[[regions]]\nname = \"lower\"\ngroup = \"lower\"\n"
        "[[regions]]\nname = \"top\"\nx = [0, 2]\ny = [2, 2]\n"
        "[[materials]]\nregion = \"plate\"\nyoungs_modulus = 1\n"
        "[[supports]]\nregion = \"lower\"\nfix = [\"x\", \"y\"]\n"
        "[[loads]]\nregion = \"top\"\nforce = [0, 1]\n[analysis]\ntype = \"elastic\"\n",
        (work_ / name).string());
  };
  run(place_mesh("first.msh", test::square_mesh));
  const std::string moved = place_mesh("second.msh", test::square_mesh);
  std::filesystem::remove(work_ / "first.msh");
  EXPECT_TRUE(find_results(parse_case(moved, "strip.toml"), work_.path()).is_finished);
  const std::string other = replaced(test::square_mesh, "0.5 1 0", "0.6 1 0");
  EXPECT_THAT(refusal(place_mesh("second.msh", other)),
              HasSubstr("contents of a mesh or field have changed"));
}

/// A file of a field may move; its contents may not change.
TEST_F(Resume, ComparesTheContentsOfFields) {
  const auto place_field = [&](const char* name, const char* value) {
    write_whole_file((work_ / name).string(),
                     std::string("x,y,factor\n0,0,1\n0,80,") + value + "\n");
    return strip + fmt::format("[[graded]]\nproperty = \"fracture_energy\"\nfile = \"{}\"\n",
                               (work_ / name).string());
  };
  const std::string history = run(place_field("first.csv", "2"));
  const std::string moved = place_field("second.csv", "2");
  std::filesystem::remove(work_ / "first.csv");
  EXPECT_TRUE(find_results(parse_case(moved, "strip.toml"), work_.path()).is_finished);
  const std::string more = run(replaced(moved, "broken_bonds = 12", "broken_bonds = 25"));
  EXPECT_EQ(more.substr(0, history.size()), history);
  EXPECT_THAT(refusal(place_field("second.csv", "3")),
              HasSubstr("contents of a mesh or field have changed"));
}

TEST_F(Resume, RefusesAnotherModel) {
  run(strip);
  const Resumed found = find_results(
      parse_case(replaced(strip, "broken_bonds = 12", "broken_bonds = 25"), "strip.toml"),
      work_.path());
  ASSERT_TRUE(found.checkpoint);
  EXPECT_THROW(require_same_model(*found.checkpoint, "another", work_.path()), FileError);
}

}  // namespace
}  // namespace perilink
