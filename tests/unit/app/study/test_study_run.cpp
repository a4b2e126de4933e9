#include "app/study/study_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "base/error.hpp"
#include "io/case/case_overrides.hpp"
#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

StudyFile study_of(const std::string& vary, const std::string& error) {
  return parse_study("case = \"strip.toml\"\n[vary]\n" + vary + error, "study.toml");
}

const std::string energy = "[error]\nquantity = \"strain_energy\"\nreference = ";

TEST(StudySeries, AreTheProductOfTheOptions) {
  const auto series = study_series(
      study_of("spacing = [2, 1]\nhorizon_ratio = [2, 3]\nsurface = [\"none\", \"ghost\"]\n",
               energy + "1\n"));
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(series[0].name, "none, horizon ratio 2");
  EXPECT_EQ(series[3].name, "ghost, horizon ratio 3");
  ASSERT_EQ(series[3].keys.size(), 2u);
  EXPECT_EQ(series[3].keys[0].text, "ghost");
  EXPECT_EQ(series[3].keys[1].number, 3.0);
}

TEST(StudySeries, LinearElementsHaveNoHorizonAndNoSurface) {
  const auto series = study_series(study_of(
      "spacing = [2, 1]\nhorizon_ratio = [2, 3]\nmethod = [\"bonds\", \"linear_elements\"]\n",
      energy + "1\n"));
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[2].name, "linear elements");
}

TEST(StudySeries, WithoutOptionsThereIsOne) {
  const auto series = study_series(study_of("spacing = [2, 1]\n", energy + "1\n"));
  ASSERT_EQ(series.size(), 1u);
  EXPECT_EQ(series[0].name, "bonds");
  EXPECT_TRUE(series[0].keys.empty());
}

class StudyRun : public testing::Test {
 protected:
  StudyRun() {
    const std::string text = std::string(test::strip_text) + "[analysis]\ntype = \"elastic\"\n";
    test::write_text(directory_ / "strip.toml", text);
  }
  StudyFile study(const std::string& error) const {
    StudyFile study = study_of("spacing = [10, 5]\nhorizon_ratio = [2]\n", error);
    study.case_path = (directory_ / "strip.toml").string();
    return study;
  }
  StudyMember run(const StudyFile& file, const TomlValue& key) const {
    return run_member(file, study_series(file).front(), key, 1);
  }
  Model model(double spacing) const {
    return build_model(
        read_case_file((directory_ / "strip.toml").string(), {},
                       {body_key("horizon_ratio", 2.0), body_key("spacing", spacing)}));
  }
  test::TemporaryDirectory directory_;
};

TEST_F(StudyRun, AMemberIsTheCaseWithItsKeys) {
  const StudyFile file = study(energy + "1\n");
  const StudyMember member = run(file, body_key("spacing", 5.0));
  ASSERT_FALSE(member.failed()) << member.failure;
  EXPECT_EQ(member.spacing, 5.0);
  EXPECT_EQ(member.horizon, 10.0);
  EXPECT_EQ(member.particles, 9 * 17);
  EXPECT_EQ(member.surface, "calibrated");
  EXPECT_EQ(member.values, std::vector<double>{run_elastic_analysis(model(5.0)).strain_energy});
}

TEST_F(StudyRun, PhasesAreTimed) {
  StudyFile file = study(energy + "1\n");
  file.repeats = 2;
  const StudyMember member = run(file, body_key("spacing", 5.0));
  EXPECT_GT(member.seconds.set_up, 0.0);
  EXPECT_GT(member.seconds.factorization, 0.0);
  const MemberSeconds& s = member.seconds;
  EXPECT_GE(s.analysis, s.assembly + s.factorization + s.solve);
  EXPECT_GT(s.calibration, 0.0);
  EXPECT_EQ(s.total(), s.set_up + s.calibration + s.analysis);
}

TEST_F(StudyRun, AMemberThatFailsSaysWhy) {
  const StudyFile file = study(energy + "1\n");
  const StudyMember member = run(file, body_key("mesh", std::string("a.msh")));
  EXPECT_TRUE(member.bad_input);
  EXPECT_NE(member.failure.find("body.mesh"), std::string::npos) << member.failure;
}

TEST_F(StudyRun, TheErrorOfAFieldIsMeasuredAgainstItsFormulas) {
  const StudyFile file = study("[error]\ndisplacement = [\"3\", \"4*1\"]\n");
  const StudyMember member = run(file, body_key("spacing", 10.0));
  ASSERT_FALSE(member.failed()) << member.failure;
  const Model strip = model(10.0);
  const ElasticResult elastic = run_elastic_analysis(strip);
  double square = 0.0, volume = 0.0;
  for (Index i = 0; i < strip.network.particles.size(); ++i) {
    const double v = strip.network.particles.volumes[i];
    square += v * (std::pow(elastic.displacement[2 * i] - 3.0, 2) +
                   std::pow(elastic.displacement[2 * i + 1] - 4.0, 2));
    volume += v;
  }
  EXPECT_NEAR(member.values[0], std::sqrt(square / (25.0 * volume)), 1e-14 * member.values[0]);
}

TEST_F(StudyRun, AFormulaThatIsNotFiniteFailsTheMember) {
  const StudyFile file = study("[error]\ndisplacement = [\"1/x\", \"0\"]\n");
  const StudyMember member = run(file, body_key("spacing", 10.0));
  EXPECT_NE(member.failure.find("gives inf at the particle at (0, 0)"), std::string::npos)
      << member.failure;
}

TEST_F(StudyRun, GaugesAreValues) {
  const std::string text = std::string(test::strip_text) +
                           "[[gauges]]\nname = \"other\"\nat = [0, 0]\naxis = \"x\"\n"
                           "[[gauges]]\nname = \"top\"\nregion = \"upper end\"\naxis = \"y\"\n"
                           "[analysis]\ntype = \"elastic\"\n";
  test::write_text(directory_ / "strip.toml", text);
  const StudyFile file = study("[error]\ngauge = \"top\"\nreference = 1\n");
  const StudyMember member = run(file, body_key("spacing", 10.0));
  ASSERT_TRUE(member.failure.empty()) << member.failure;
  const double energy_stored = run_elastic_analysis(model(10.0)).strain_energy;
  // The load acts on the region in proportion to the volumes, so its work is that of the mean.
  EXPECT_NEAR(member.values[0], 2.0 * energy_stored / 12.0, 1e-12 * member.values[0]);
  EXPECT_NO_THROW(check_study(file, read_case_file(file.case_path)));
}

void expect_check_refused(const StudyFile& file, const std::string& key, const std::string& says) {
  try {
    check_study(file, read_case_file(file.case_path));
    ADD_FAILURE() << "accepted; expected " << says;
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().file, "study.toml");
    EXPECT_EQ(error.where().key, key);
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST_F(StudyRun, ErrorsThatTheCaseCannotHaveAreRefused) {
  expect_check_refused(study("[error]\ndisplacement = [\"x\", \"y\", \"z\"]\n"),
                       "error.displacement", "2 dimensions");
  expect_check_refused(study("[error]\ngauge = \"mouth\"\nreference = 1\n"), "error.gauge",
                       "no gauge of that name");
  test::write_text(directory_ / "strip.toml", test::strip_text);
  expect_check_refused(study("[error]\ndisplacement = [\"x\", \"y\"]\n"), "error.displacement",
                       "damage analysis");
  EXPECT_NO_THROW(
      check_study(study(energy + "1\n"), read_case_file((directory_ / "strip.toml").string())));
}

TEST_F(StudyRun, ExplicitAnalysesAreRefused) {
  CaseFile input = read_case_file((directory_ / "strip.toml").string());
  for (const AnalysisType type : {AnalysisType::explicit_, AnalysisType::relaxation}) {
    input.analysis.type = type;
    try {
      check_study(study(energy + "1\n"), input);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().key, "case");
      EXPECT_NE(std::string(error.what()).find(word_of(type)), std::string::npos);
    }
  }
}

TEST_F(StudyRun, RefinementsThatTheBodyCannotHaveAreRefusedOnce) {
  const StudyFile finer = study(energy + "1\n");
  CaseFile input = read_case_file(finer.case_path);
  const auto expect = [&](const StudyFile& file, const std::string& says) {
    try {
      check_study(file, input);
      ADD_FAILURE() << "accepted; expected " << says;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().file, "study.toml");
      EXPECT_EQ(error.where().line, 3);
      EXPECT_EQ(error.where().key, "vary." + std::string(word_of(file.vary.refinement)));
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  const StudyFile sizes = study_of("mesh_size = [2, 1]\n", energy + "1\n");
  expect(sizes, "refine with `spacing`");
  expect(study_of("mesh = [\"a.msh\", \"b.msh\"]\n", energy + "1\n"),
         "the body of the case has no mesh");
  input.body.mesh = "plate.msh";
  expect(study_of("columns = [2, 4]\n", energy + "1\n"), "refine with `mesh`, a list of meshes");
  expect(sizes, "\"plate.msh\", is a mesh file, not a geometry");
  input.body.mesh = "plate.geo";
  expect(study_of("spacing = [2, 1]\n", energy + "1\n"), "refine with `mesh_size`");
  EXPECT_NO_THROW(check_study(sizes, input));
}

/// One that the case accepts is enough, whatever the others are.
TEST_F(StudyRun, StudiesWithoutAMemberThatTheCaseAcceptsAreRefusedOnce) {
  const StudyFile file = study(energy + "1\n");
  StudySeries good = study_series(file).front(), bad = good;
  bad.keys.push_back(body_key("surface", std::string("glass")));
  EXPECT_NO_THROW(check_members(file, {bad, good}));
  try {
    check_members(file, {bad, bad});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().file, "study.toml");
    EXPECT_EQ(error.where().key, "vary");
    EXPECT_NE(std::string(error.what()).find("body.surface: is \"glass\""), std::string::npos)
        << error.what();
  }
}

/// Members of one series with values 1 + 3 h^2, in the wrong order and with a failed one.
std::vector<StudyMember> parabola(const std::vector<double>& spacings) {
  std::vector<StudyMember> members;
  for (const double spacing : spacings) {
    StudyMember member;
    member.spacing = spacing;
    if (spacing == 0.0)
      member.failure = "too fine";
    else
      member.values = {1.0 + 3.0 * spacing * spacing};
    members.push_back(member);
  }
  return members;
}

TEST(CompareMembers, SortsFromCoarseToFineWithFailuresLast) {
  std::vector<StudyMember> members = parabola({0.1, 0.0, 0.4, 0.2});
  members.push_back(members.front());
  members.back().series = 1;
  compare_members(study_of("spacing = [2, 1]\n", energy + "1\n"), members);
  ASSERT_EQ(members.size(), 5u);
  EXPECT_EQ(members[0].spacing, 0.4);
  EXPECT_EQ(members[2].spacing, 0.1);
  EXPECT_TRUE(members[3].failed());
  EXPECT_EQ(members[4].series, 1u);
  EXPECT_TRUE(std::isnan(members[4].orders[0])) << "the first of its series";
}

TEST(CompareMembers, AgainstANumber) {
  std::vector<StudyMember> members = parabola({0.4, 0.2, 0.1});
  compare_members(study_of("spacing = [2, 1]\n", energy + "1\n"), members);
  EXPECT_NEAR(members[1].errors[0], 0.12, 1e-15);
  EXPECT_NEAR(members[2].orders[0], 2.0, 1e-13);  // from errors of 0.03 with 15 digits of 1
}

TEST(CompareMembers, AgainstTheFinest) {
  std::vector<StudyMember> members = parabola({0.4, 0.2, 0.1});
  compare_members(study_of("spacing = [2, 1]\n", energy + "\"finest\"\n"), members);
  EXPECT_DOUBLE_EQ(members[0].errors[0], (1.48 - 1.03) / 1.03);
  EXPECT_EQ(members[2].errors[0], 0.0);
  EXPECT_TRUE(std::isnan(members[2].orders[0]));
}

TEST(CompareMembers, ASeriesMayFailAsAWhole) {
  for (const char* reference : {"1\n", "\"finest\"\n", "\"extrapolated\"\n"}) {
    std::vector<StudyMember> members = parabola({0.0, 0.0});
    compare_members(study_of("spacing = [3, 2, 1]\n", energy + reference), members);
    EXPECT_TRUE(members[0].errors.empty());
  }
}

TEST(CompareMembers, AgainstTheLimit) {
  std::vector<StudyMember> members = parabola({0.5, 0.4, 0.2, 0.1});
  compare_members(study_of("spacing = [3, 2, 1]\n", energy + "\"extrapolated\"\n"), members);
  EXPECT_NEAR(members[0].errors[0], 0.75, 1e-12);
  EXPECT_NEAR(members[3].orders[0], 2.0, 1e-10);
}

TEST(CompareMembers, HaveNoErrorWithoutALimit) {
  std::vector<StudyMember> members = parabola({0.4, 0.2, 0.1});
  members[1].values = {3.0};
  compare_members(study_of("spacing = [3, 2, 1]\n", energy + "\"extrapolated\"\n"), members);
  EXPECT_TRUE(std::isnan(members[0].errors[0]));
  EXPECT_TRUE(std::isnan(members[2].orders[0]));
}

}  // namespace
}  // namespace perilink
