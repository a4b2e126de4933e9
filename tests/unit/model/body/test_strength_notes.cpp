#include "model/body/strength_notes.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Concrete in N and mm: E = 30 000, f_t = 3, G_F = 0.1, E G_F / f_t^2 = 333 mm.
constexpr double modulus = 30000.0;

MaterialStrength softening(double strength, double fracture_energy = 0.1) {
  MaterialStrength result;
  result.tensile_strength = strength;
  result.process_zone = modulus * fracture_energy / (strength * strength);
  result.segments = 10;
  return result;
}

MaterialStrength brittle(double strength) {
  MaterialStrength result = softening(strength);
  result.segments = 1;
  return result;
}

TEST(StrengthNotes, SayNothingOfConcreteOnLaboratoryBodies) {
  EXPECT_THAT(strength_notes(softening(3.0), modulus, 15.0, 100.0), IsEmpty());
  EXPECT_THAT(strength_notes(brittle(20.0), modulus, 15.0, 100.0), IsEmpty());
  EXPECT_THAT(strength_notes(MaterialStrength{}, modulus, 15.0, 100.0), IsEmpty()) << "unbreakable";
}

/// A strength in Pa with a modulus in MPa is a million times too large, and vice versa.
TEST(StrengthNotes, DoubtUnitsOfDifferentSystems) {
  EXPECT_THAT(strength_notes(softening(3e6, 1e11), modulus, 15.0, 100.0),
              ElementsAre(HasSubstr("is 1e+02 of Young's modulus, above 0.01: are the numbers")));
  EXPECT_THAT(strength_notes(softening(3e-6, 1e-13), modulus, 15.0, 100.0),
              ElementsAre(HasSubstr("below 1e-06: are the numbers")));
}

TEST(StrengthNotes, TellWhereTheHorizonMakesBrittleBondsTooStrong) {
  EXPECT_THAT(strength_notes(brittle(61.0), modulus, 0.4, 100.0),
              ElementsAre(HasSubstr(
                  "above 0.002: the strength of brittle bonds follows from fracture_energy and "
                  "horizon and grows as the horizon shrinks")));
  EXPECT_THAT(strength_notes(brittle(59.0), modulus, 0.4, 100.0), IsEmpty());
}

/// l = 3000 / 15^2 = 13.3 in a body of 40: a horizon of 25 * 10 / 13.3 makes it a quarter.
TEST(StrengthNotes, TellWhereBrittleBondsReachThroughTheBody) {
  EXPECT_THAT(
      strength_notes(brittle(15.0), modulus, 25.0, 40.0),
      ElementsAre(testing::AllOf(HasSubstr("more than a quarter of the body's longest side 40"),
                                 HasSubstr("take a horizon below 18.8"))));
}

TEST(StrengthNotes, TellWhereAProcessZoneIsOutOfProportion) {
  EXPECT_THAT(strength_notes(softening(15.0), modulus, 15.0, 100.0),
              ElementsAre(HasSubstr("13.33 is shorter than the horizon 15")));
  EXPECT_THAT(strength_notes(softening(3.0), modulus, 3.0, 33.0),
              ElementsAre(HasSubstr("more than 10 times the body's longest side 33")));
  EXPECT_THAT(strength_notes(softening(3.0), modulus, 12.0, 34.0), IsEmpty());
}

/// E G_F / f_t^2 = 333.3: a thirtieth is 11.11.
TEST(StrengthNotes, TellWhereTheHorizonIsTooShortForTheProcessZone) {
  EXPECT_THAT(strength_notes(softening(3.0), modulus, 11.2, 100.0), IsEmpty());
  EXPECT_THAT(strength_notes(softening(3.0), modulus, 11.0, 100.0),
              ElementsAre(testing::AllOf(HasSubstr("the horizon 11 is below a thirtieth"),
                                         HasSubstr(horizon_advice))));
}

TEST(PathNote, IsAboutBondsThatCanBreakAnywhere) {
  CaseFile input = strip_case();
  Model model = build_model(input);
  EXPECT_THAT(path_note(input, model).value(),
              testing::AllOf(HasSubstr("rows of a lattice"), HasSubstr("\"unstructured\""),
                             HasSubstr("\"micropolar\"")));
  EXPECT_THAT(model.notes, testing::Contains(HasSubstr("rows of a lattice")));
  input.interfaces.emplace_back();
  EXPECT_FALSE(path_note(input, model)) << "it prescribes the path";
  input.interfaces.clear();
  model.lattice.pattern = Pattern::irregular;
  EXPECT_THAT(path_note(input, model).value(), HasSubstr("too straight under shear"));
  input.body.mesh = "strip.msh";
  EXPECT_FALSE(path_note(input, model));
  input.body.mesh.reset();
  input.body.model = BodyModel::micropolar;
  EXPECT_FALSE(path_note(input, model));
  model.lattice.pattern = Pattern::rectangular;
  EXPECT_THAT(path_note(input, model).value(), testing::Not(HasSubstr("micropolar")));
  std::ranges::fill(model.network.critical_stretch, infinity);
  EXPECT_FALSE(path_note(input, model)) << "nothing breaks";
}

TEST(UnnotchedNote, IsAboutSofteningBoxesWithoutACrack) {
  const auto note = [](const std::string& material, const std::string& tables) {
    std::string text = strip_text + tables;
    const std::string energy = "fracture_energy = 0.001\n";
    text.replace(text.find(energy), energy.size(), energy + material);
    const CaseFile input = parse_case(text, "strip.toml");
    return unnotched_note(input, build_model(input));
  };
  const std::string softens = "tensile_strength = 0.15\n";
  EXPECT_THAT(note(softens, "").value(), HasSubstr("no notch, hole or pre-crack"));
  EXPECT_FALSE(note("", "")) << "brittle";
  EXPECT_FALSE(note(softens, "[[cracks]]\npoints = [[-1, 45], [15, 45]]\n"));
  EXPECT_FALSE(note(softens + "holes = [\"gap\"]\n",
                    "[[regions]]\nname = \"gap\"\nx = [20, 40]\ny = [30, 50]\n"));
  EXPECT_FALSE(note(softens,
                    "[[random]]\nproperty = \"tensile_strength\"\ndistribution = \"weibull\"\n"
                    "variation = 0.1\ncorrelation_length = 50\n"));
}

/// A fracture energy a hundred million times too large makes bonds ten thousand times too strong.
TEST(StrengthNotes, NameTheMaterial) {
  CaseFile input = strip_case();
  input.materials[0].name = "concrete";
  input.materials[0].fracture_energy = 1e5;
  EXPECT_THAT(draft_model(input).notes,
              testing::Contains(HasSubstr("material \"concrete\": the tensile strength")));
  input.analysis.type = AnalysisType::elastic;
  EXPECT_THAT(draft_model(input).notes, testing::Not(testing::Contains(HasSubstr("strength"))));
}

CaseFile with_bar(double youngs_modulus, double yield_strength) {
  CaseFile input;
  input.materials.resize(2);
  input.materials[0].youngs_modulus = modulus;
  input.materials[1].youngs_modulus = 30.0 * modulus;  // a loading plate
  RebarSection bar;
  bar.youngs_modulus = youngs_modulus;
  bar.yield_strength = yield_strength;
  input.rebar = {bar};
  return input;
}

TEST(BarNotes, SayNothingOfWhatIsLaidIntoConcrete) {
  EXPECT_THAT(bar_notes(with_bar(200e3, 500.0)), IsEmpty());
  EXPECT_THAT(bar_notes(with_bar(195e3, 1800.0)), IsEmpty()) << "a tendon";
  EXPECT_THAT(bar_notes(with_bar(40e3, 800.0)), IsEmpty()) << "glass fibres";
}

TEST(BarNotes, TellOfOtherUnits) {
  EXPECT_THAT(bar_notes(with_bar(200.0, 0.5)),
              ElementsAre(HasSubstr("bar 1: Young's modulus 200 is 0.0067 times")));
  EXPECT_THAT(bar_notes(with_bar(200e9, 500e6)),
              ElementsAre(HasSubstr("is 2.2e+05 times that of the solid, 9e+05")));
  EXPECT_THAT(bar_notes(with_bar(200e3, 500e6)),
              ElementsAre(HasSubstr("it yields at 5e+08, which is 2.5e+03 of")));
  EXPECT_THAT(bar_notes(with_bar(200e3, 0.5)), ElementsAre(HasSubstr("2.5e-06 of")));
}

/// Brittle bonds have the square root of the factor in their critical stretch.
TEST(StrengthNotes, TellTheScatterOverTheBonds) {
  const Model even = build_model(strip_case());
  const CaseFile input =
      parse_case(strip_text + std::string("[[random]]\nproperty = \"fracture_energy\"\nseed = 4\n"
                                          "distribution = \"weibull\"\nvariation = 0.2\n"
                                          "correlation_length = 20\n"),
                 "strip.toml");
  const Model model = build_model(input);
  double sum = 0.0, squares = 0.0, least = 1e300, most = 0.0;
  const auto count = static_cast<double>(model.network.bonds.size());
  for (std::size_t b = 0; b < even.network.critical_stretch.size(); ++b) {
    const double ratio = model.network.critical_stretch[b] / even.network.critical_stretch[b];
    const double factor = ratio * ratio;
    sum += factor;
    squares += factor * factor;
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  const double mean = sum / count;
  EXPECT_THAT(model.notes,
              testing::Contains(fmt::format(
                  "random fracture_energy with seed 4: over {} bonds the factor has mean {:.4g}, "
                  "standard deviation {:.4g}, least {:.4g}, largest {:.4g}; correlation_length is "
                  "below the horizon, over which bonds average: take at least one horizon",
                  count, mean, std::sqrt(squares / count - mean * mean), least, most)));
}

}  // namespace
}  // namespace perilink
