#include "app/run/run_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ExplicitResult sound() {
  ExplicitResult result;
  result.peak_load = -100.0;
  result.largest_surplus = 1e-5;
  return result;
}

TEST(RunWarnings, AreNoneWhereEnergyAndForcesBalance) {
  EXPECT_THAT(warnings_about(sound(), {104.0}), IsEmpty());
}

TEST(RunWarnings, NameEnergyThatIsTooMuch) {
  ExplicitResult result = sound();
  result.largest_surplus = 0.13;
  EXPECT_THAT(warnings_about(result, {100.0}), ElementsAre(HasSubstr("up to 13 % of the work")));
}

TEST(RunWarnings, NameALoadThatTheSupportsDoNotFeel) {
  EXPECT_THAT(warnings_about(sound(), {107.0}), ElementsAre(HasSubstr("differ by 7 %")));
  EXPECT_THAT(warnings_about(sound(), {94.0}), ElementsAre(HasSubstr("differ by 6 %")));
  EXPECT_THAT(warnings_about(sound(), {250.0}), ElementsAre(HasSubstr("differ by 150 %")));
}

/// 30 of its energy of 100 are motion.
ExplicitResult moving() {
  ExplicitResult result = sound();
  result.last.energy = {30.0, 20.0, 5.0, 15.0, 20.0, 100.0, 10.0};
  return result;
}

TEST(RunWarnings, NameWorkThatIsStillMotion) {
  ExplicitResult result = moving();
  EXPECT_THAT(warnings_about(result, {100.0}),
              ElementsAre(HasSubstr("30 % of the work is kinetic energy at the end: the body, or "
                                    "pieces of it, move freely")));
  EXPECT_THAT(warnings_about(result, {100.0, false, 0.0, 1}),
              ElementsAre(HasSubstr("a piece of the body is unsupported")));
  EXPECT_THAT(warnings_about(result, {100.0, false, 0.0, 2}),
              ElementsAre(HasSubstr("2 pieces of the body are unsupported")));
  result.last.energy.kinetic = 7.0;  // 77 in all
  EXPECT_THAT(warnings_about(result, {100.0}), IsEmpty());
}

TEST(RunWarnings, NameCompressionBeyondTenTimesTheTensileStrength) {
  Network network;
  network.particles.material = {0, 1, no_index, 0, 0};
  network.report.strengths = {{4.0}, {}};  // the second material cannot break
  const std::vector<double> principal = {1.0, -41.0, 0.0, 0.0,  -90.0, 0.0,   0.0, -80.0,
                                         0.0, 2.0,   0.0, -8.0, 0.0,   -50.0, 0.0};
  const std::vector<double> damage = {0.4, 0.0, 0.0, 0.0, 0.6};  // the last one is a loose piece
  const Compression at_peak = largest_compression(network, principal, damage);
  EXPECT_EQ(at_peak.stress, 41.0);
  EXPECT_EQ(at_peak.times, 10.25);
  EXPECT_THAT(warning_about_compression(at_peak).value(),
              AllOf(HasSubstr("no crushing law"), HasSubstr("is 41, 10.2 times the tensile")));
  EXPECT_FALSE(warning_about_compression({39.0, 9.75}));
  network.laws = {BondLaw::brittle().crushing({{1.0, 1.0}}, 1.0, false)};
  EXPECT_EQ(largest_compression(network, principal, damage).stress, 0.0) << "it can crush";
}

/// Two bonds of length 2 and stiffness 3 with segments that take 0.05 and 0.95 of 10 (their areas
/// over the square of the critical stretch).
TEST(RunWarnings, NameEnergyThatSofteningTakesBesideTheCracks) {
  const BondLaw law = BondLaw::saw_tooth({{1.0, 1.0}, {0.5, std::sqrt(19.0)}});
  Network network;
  network.laws = {law};
  network.stiffness = {3.0, 3.0, 3.0};
  network.critical_stretch = {0.1, 0.1, 0.1};
  network.bonds.first = network.bonds.second = {0, 0, 0};
  network.bonds.lengths = {2.0, 2.0, 2.0};
  network.first_slip_spring = 3;
  const std::vector<double> secants = {0.5, 0.0, 1.0};
  const SoftenedEnergy energy = softened_energy(network, secants);
  const double scale = 0.5 * 3.0 * 0.2 * 0.2;
  EXPECT_NEAR(energy.diffuse, scale * 0.5, 1e-14);
  EXPECT_NEAR(energy.cracks, scale * 10.0, 1e-14);
  EXPECT_FALSE(warning_about_diffuse_softening(energy, true));
  EXPECT_THAT(warning_about_diffuse_softening({10.0, 1.5, 14.0}, true).value(),
              AllOf(HasSubstr("dissipated 1.5, 15 % of"), HasSubstr("a twentieth to a thirtieth")));
  EXPECT_THAT(warning_about_diffuse_softening({10.0, 1.5, 14.0}, false).value(),
              HasSubstr("too large; make bonds breakable only"));
  EXPECT_FALSE(warning_about_diffuse_softening({0.0, 1.5, 0.0}, true)) << "nothing has cracked";
  EXPECT_FALSE(warning_about_diffuse_softening({10.0, 1.5, 25.0}, true)) << "a process zone";
}

TEST(RunWarnings, LeaveImpactsAndRunsThatWereCutShortAlone) {
  ExplicitResult result = moving();
  EXPECT_THAT(warnings_about(result, {100.0, true, 1.0}), IsEmpty());
  result.termination = Termination::interrupted;
  EXPECT_THAT(warnings_about(result, {100.0, false, 1.0}), IsEmpty());
}

TEST(RunWarnings, NameRunsThatEndBeforeAWaveIsBack) {
  ExplicitResult result = sound();
  result.last.time = 0.3;
  EXPECT_THAT(warnings_about(result, {100.0, false, 0.29}), IsEmpty());
  EXPECT_THAT(
      warnings_about(result, {100.0, false, 0.5}),
      ElementsAre(HasSubstr("before an elastic wave has crossed the body and returned (0.5)")));
}

TEST(RunWarnings, TakeTheFastestMaterialForWaves) {
  CaseFile input;
  input.materials.resize(2);
  input.materials[0].youngs_modulus = 9.0;
  input.materials[0].density = 1.0;
  input.materials[1].youngs_modulus = 4.0;
  input.materials[1].density = 1.0;
  EXPECT_DOUBLE_EQ(run_facts(input, 6.0, 0.0).wave_time, 4.0);
  EXPECT_FALSE(run_facts(input, 6.0, 0.0).impact);
  input.velocities.emplace_back();
  EXPECT_TRUE(run_facts(input, 6.0, 0.0).impact);
}

TEST(RunWarnings, LeaveSupportsOfSymmetryAlone) {
  ExplicitResult result = sound();
  EXPECT_THAT(warnings_about(result, {1001.0}), IsEmpty());
  result.peak_load = 0.0;
  EXPECT_THAT(warnings_about(result, {0.0}), IsEmpty());
  EXPECT_THAT(warnings_about(result, {50.0}), IsEmpty());
}

TEST(RunWarnings, AreNoneWhereEquilibriaAreExactButForRoundOff) {
  EXPECT_THAT(warnings_of_balance(1e-9, 1e-9), IsEmpty());
}

TEST(RunWarnings, NameEnergiesAndForcesOutOfBalance) {
  EXPECT_THAT(warnings_of_balance(0.99, 0.0), ElementsAre(HasSubstr("up to 0.99 of the work")));
  EXPECT_THAT(warnings_of_balance(0.99, 3e-6),
              ElementsAre(HasSubstr("of the work"), HasSubstr("up to 3e-06 of the load")));
}

/// A smaller tolerance helps only where the tolerance ended the iterations.
TEST(RunWarnings, TellRoundOffFromIterationsThatEndedEarly) {
  EXPECT_THAT(
      warnings_of_balance(0.0, 1e-3, 1e-4),
      ElementsAre(AllOf(HasSubstr("up to 0.001 of the load"), HasSubstr("an error of 0.0001"),
                        HasSubstr("a smaller `tolerance`"))));
  EXPECT_THAT(warnings_of_balance(0.0, 1e-3, 1e-10), ElementsAre(HasSubstr("nearly singular")));
  EXPECT_THAT(warnings_of_balance(0.0, 1e-8, 1e-10), IsEmpty());
}

/// Work is summed over load steps; what breaks between them may take more.
TEST(RunWarnings, SeeEnergyThatNoLoadStepBroughtIn) {
  ExplicitRecord last;
  last.energy.external_work = 2.8;
  last.energy.stored = 2.8;
  EXPECT_THAT(warnings_at_rest(last), IsEmpty());
  last.energy.fractured = 9.2;
  EXPECT_THAT(warnings_at_rest(last),
              ElementsAre(AllOf(HasSubstr("the stored and dissipated energy 12"),
                                HasSubstr("the work of the load steps 2.8: it is counted with"))));
  last.broken_bonds = 3;
  EXPECT_THAT(warnings_at_rest(last), ElementsAre(HasSubstr("bonds broke at larger loads")));
}

TEST(RunWarnings, NameARampThatDoesNotEnd) {
  ExplicitResult result;
  result.termination = Termination::completed;
  result.last.load_factor = 0.25;
  CaseFile input;
  input.analysis.duration = 1.0;
  input.analysis.ramp_time = 2.0;
  EXPECT_THAT(warnings_about(result, run_facts(input, 1.0, 0.0)),
              ElementsAre(HasSubstr("ends at load factor 0.25: ramp_time is longer")));
  input.analysis.ramp_time = 1.0;
  EXPECT_THAT(warnings_about(result, run_facts(input, 1.0, 0.0)), IsEmpty());
}

TEST(RunWarnings, SeePeaksThatLieBeyondSmallDisplacements) {
  EXPECT_EQ(warning_about_size({9.0, 500.0}, 100.0), std::nullopt);
  EXPECT_EQ(warning_about_size({-10.0, 500.0}, 100.0), std::nullopt);
  const auto warning = warning_about_size({-198.0, 5e6}, 100.0);
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, AllOf(HasSubstr("5e+06 at displacement -198"),
                              HasSubstr("displacement is 2 of the body's longest side")));
}

TEST(RunWarnings, SeeBodiesThatHaveMovedFartherThanTheyAreLong) {
  EXPECT_EQ(warning_about_end(-100.0, 100.0), std::nullopt);
  EXPECT_THAT(warning_about_end(-3700.0, 100.0).value(),
              HasSubstr("37 of the body's longest side"));
}

TEST(RunWarnings, SeeMotionThatIsNotSmall) {
  EXPECT_EQ(warning_about_motion(0.01), std::nullopt);
  const auto warning = warning_about_motion(0.25);
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("25 % of the body is stretched or rotated by more than a tenth"));
}

TEST(RunWarnings, NameWhatIsNotANumber) {
  EXPECT_THAT(warnings_of_balance(NAN, 0.0), ElementsAre(HasSubstr("out of balance")));
}

/// Work of 1.03 over an area of 1; elastic steps have the work of their area.
TEST(RunWarnings, TellEnergiesOfLargeSteps) {
  StepRecord last;
  last.external_work = 1.03;
  last.dissipated_energy = 0.5;
  const auto text = warning_about_steps(last, 1.0);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("0.03 too large, 3 % of the area 1 under the curve"));
  EXPECT_EQ(warning_about_steps(last, 1.02), std::nullopt);
  last.dissipated_energy = 0.0;
  EXPECT_EQ(warning_about_steps(last, 1.0), std::nullopt);
}

}  // namespace
}  // namespace perilink
