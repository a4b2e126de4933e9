// Values of the option --set from outside: run, check and converge.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Settings : public testing::Test {
 protected:
  Settings() {
    fs::create_directories(work());
    write_text(work() / "strip.toml", tension_strip_case);
  }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& words) const { return run_program(work(), words); }
  std::string file(const std::string& name) const { return read_text(work() / name); }

  TemporaryDirectory temporary_;
};

TEST_F(Settings, RunTheCaseThatTheFileWouldGive) {
  write_text(work() / "edited.toml",
             replaced(replaced(tension_strip_case, "spacing = 0.25", "columns = 17"), "x = 0.04",
                      "x = 0.08"));
  ASSERT_EQ(run({"run", "edited.toml"}).exit_status, 0);
  const ProcessEnd end = run({"run", "--set", "body.columns=17", "strip.toml", "--set",
                              "displacements[1].x=0.08", "--out", "set"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(file("set/history.csv"), file("results/edited/history.csv"));
  EXPECT_EQ(file("set/case.toml"), file("results/edited/case.toml"));
}

TEST_F(Settings, AreRefusedWithThePlaceTheValueAndTheRemedy) {
  for (const std::string command : {"run", "check"}) {
    const auto refused = [&](const std::string& setting) {
      const ProcessEnd end = run({command, "strip.toml", "--set", setting});
      EXPECT_EQ(end.exit_status, 2) << setting;
      return end.err;
    };
    EXPECT_THAT(refused("body.spacng=1"),
                AllOf(HasSubstr("perilink: bad input: --set body.spacng: [body] has no such key"),
                      HasSubstr("did you mean `spacing`?")));
    EXPECT_THAT(refused("body.horizon=0.1"),
                HasSubstr("--set body.horizon: is 0.1, "));  // found with the body
    EXPECT_THAT(refused("materials[7].youngs_modulus=1"),
                HasSubstr("there is no materials[7]: the list has 1 entry"));
  }
  EXPECT_FALSE(fs::exists(work() / "results"));
}

TEST_F(Settings, OfAStudyAreThoseOfItsCase) {
  write_text(work() / "study.toml",
             "case = \"strip.toml\"\n[vary]\nspacing = [0.25, 0.125]\n[error]\n"
             "quantity = \"strain_energy\"\nreference = 0.04\n");
  const std::vector<std::string> words = {"converge", "study.toml", "--quiet", "--set"};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> all = words;
    all.push_back(setting);
    return run(all);
  };
  EXPECT_THAT(with("body.columns=9").err, HasSubstr("--set body.columns: is given, but the study"));
  ASSERT_EQ(with("materials[1].youngs_modulus=200").exit_status, 0);
  const std::string table = file("results/study/table.csv");
  ASSERT_EQ(run({"converge", "study.toml", "--quiet", "--out", "plain"}).exit_status, 0);
  EXPECT_NE(file("plain/table.csv"), table);
  EXPECT_FALSE(fs::exists(work() / "plain/case.toml"));
  // The written study has the values.
  const ProcessEnd again =
      run({"converge", "results/study/study.toml", "--quiet", "--out", "again"});
  ASSERT_EQ(again.exit_status, 0) << again.err;
  EXPECT_EQ(file("again/table.csv"), table);
}

}  // namespace
}  // namespace perilink::test
