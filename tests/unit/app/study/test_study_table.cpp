#include "app/study/study_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "io/case/case_overrides.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct Shown {
  StudyFile study = parse_study(
      "case = \"a.toml\"\n[vary]\nspacing = [0.2, 0.1]\n[[error]]\ndisplacement = [\"x\", \"y\"]\n"
      "[[error]]\nname = \"energy\"\nquantity = \"strain_energy\"\nreference = 4\n",
      "study.toml");
  std::vector<StudySeries> series = {{"none, horizon ratio 2", {}}, {"ghost", {}}};
  std::vector<StudyMember> members;

  Shown() {
    StudyMember good;
    good.refinement = body_key("spacing", 0.2);
    good.method = "bonds";
    good.surface = "none";
    good.spacing = 0.25;
    good.horizon = 0.5;
    good.particles = 6;
    good.bonds = 9;
    good.unknowns = 10;
    good.values = {0.125, 5.0};
    good.references = {no_value, 4.0};
    good.errors = {0.125, 0.25};
    good.orders = {no_value, 1.5};
    good.note = "the load climbed again";
    good.seconds = {0.5, 0.25, 0.25, 2.0, 0.125, 3.0};
    StudyMember bad;
    bad.series = 1;
    bad.refinement = body_key("spacing", 0.1);
    bad.failure = "a.toml: \"ghost\" is refused, here\n  advice";
    members = {good, bad};
  }
};

TEST(StudyTable, HasAColumnForEveryErrorAndNoneForTheClock) {
  const Shown sample;
  EXPECT_EQ(
      study_table(sample.study, sample.series, sample.members),
      "combination,spacing,method,surface,mean_spacing,horizon,particles,bonds,unknowns,"
      "displacement_error,displacement_order,energy,energy_reference,energy_error,energy_order,"
      "failure,note\n"
      "\"none, horizon ratio 2\",0.2,bonds,none,0.25,0.5,6,9,10,0.125,,5,4,0.25,1.5,,the load "
      "climbed again\n"
      "ghost,0.1,,,,,,,,,,,,,,\"a.toml: \"\"ghost\"\" is refused, here\",\n");
}

TEST(StudyTable, TimingHasTheRowsThatRan) {
  const Shown sample;
  EXPECT_EQ(study_timing(sample.study, sample.series, sample.members),
            "combination,spacing,unknowns,set_up,calibration,assembly,factorization,"
            "solve,analysis,total\n"
            "\"none, horizon ratio 2\",0.2,10,0.5,0.25,0.25,2,0.125,3,3.75\n");
}

TEST(StudyTable, TheReportSaysWhatFailedAndWhy) {
  const Shown sample;
  const std::string report = study_report(sample.study, sample.series, sample.members);
  EXPECT_THAT(report, HasSubstr("none, horizon ratio 2\n"));
  EXPECT_THAT(report, HasSubstr("1.250e-01      -"));
  EXPECT_THAT(report, HasSubstr("             5       2.500e-01   1.50"));
  EXPECT_THAT(report, HasSubstr("  reference of displacement: closed form (x, y)\n"));
  EXPECT_THAT(report, HasSubstr("  reference of energy: 4, as given\n"));
  EXPECT_THAT(report, HasSubstr("0.1     failed\n"));
  EXPECT_THAT(report, HasSubstr("0.1: a.toml: \"ghost\" is refused, here\n"));
  EXPECT_THAT(report, HasSubstr("0.2: note: the load climbed again\n"));
  EXPECT_THAT(report, Not(HasSubstr("nan")));
}

TEST(StudyTable, TheReportSaysWhereReferencesAreFrom) {
  Shown sample;
  sample.members[0].references[1] = 3.5;
  const auto report = [&](Reference reference) {
    sample.study.errors[1].reference = reference;
    return study_report(sample.study, sample.series, sample.members);
  };
  EXPECT_THAT(report(Reference::finest), HasSubstr("energy: 3.5, the finest member's\n"));
  EXPECT_THAT(report(Reference::extrapolated), HasSubstr("energy: 3.5, extrapolated\n"));
  sample.members[0].references[1] = no_value;
  EXPECT_THAT(report(Reference::extrapolated), HasSubstr("energy: none: the finest"));
}

TEST(StudyTable, MeshesAreNamedWithoutTheirFolder) {
  EXPECT_EQ(refinement_text(body_key("mesh", std::string("../meshes/plate_2.msh"))), "plate_2.msh");
  EXPECT_EQ(refinement_text(body_key("columns", 41)), "41");
}

}  // namespace
}  // namespace perilink
