// Host elements that constrain particles: events compared with those of free particles.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/run/damage_run.hpp"
#include "app/run/quasistatic.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "model/from_case/configure.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

/// Returns a case of a notched beam in three-point bending, with or without host elements.
std::string beam_case(const std::string& more) {
  return R"([body]
pattern = "rectangular"
spacing = 2.0
horizon_ratio = 3
[[regions]]
name = "beam"
x = [0, 160]
y = [0, 40]
[[regions]]
name = "left"
x = [10, 14]
y = [0, 0]
[[regions]]
name = "right"
x = [146, 150]
y = [0, 0]
[[regions]]
name = "load"
x = [78, 82]
y = [40, 40]
[[regions]]
name = "pads"
x = [0, 60]
y = [0, 40]
[[regions]]
name = "other pads"
x = [100, 160]
y = [0, 40]
[[regions]]
name = "top"
x = [60, 100]
y = [32, 40]
[[materials]]
region = "beam"
youngs_modulus = 30000.0
fracture_energy = 0.1
[[materials]]
regions = ["pads", "other pads", "top"]
youngs_modulus = 30000.0
fracture_energy = "infinite"
[[cracks]]
points = [[81, -1], [81, 13]]
[[supports]]
region = "left"
fix = ["x", "y"]
[[supports]]
region = "right"
fix = ["y"]
[[loads]]
region = "load"
force = [0, -100]
[stop]
broken_bonds = 120
)" + more;
}

struct Events final : StepObserver {
  std::vector<Index> elements;
  std::vector<double> load_factors;
  void on_step(const StepRecord& row, StateSource&) override {
    elements.push_back(row.element);
    load_factors.push_back(row.load_factor);
  }
};

DamageResult run_case_of(const std::string& text, Events& events) {
  const CaseFile input = parse_case(text, "beam.toml");
  const Model model = build_model(input);
  return run_damage_analysis(model, damage_options(input, 1), events);
}

TEST(Hosts, ConversionKeepsTheEventsAndTheEnergies) {
  Events free, embedded;
  const DamageResult all = run_case_of(beam_case(""), free);
  const DamageResult some = run_case_of(beam_case("[elements]\nspacings = 4\n"), embedded);
  EXPECT_EQ(some.termination, all.termination) << some.reason;
  EXPECT_GT(some.conversions, 0);
  EXPECT_EQ(some.missed_releases, 0);
  // Bonds and loads agree until the crack reaches an ambiguous event. The tolerance 0.02 is the
  // excess stiffness of such wide elements near the load.
  ASSERT_GT(embedded.elements.size(), 40u);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_EQ(embedded.elements[k], free.elements[k]) << k;
    EXPECT_NEAR(embedded.load_factors[k], free.load_factors[k], 0.02 * free.load_factors[k]) << k;
  }
  EXPECT_GT(some.elements, 0);
  EXPECT_LT(some.energy_error, 1e-9);
  // Constraint energy freed by releases is an error of the elements, which are as wide as an eighth
  // of the ligament.
  EXPECT_LT(some.last.constraint_energy, 0.01 * some.last.dissipated_energy);
  EXPECT_NEAR(some.peak_load, all.peak_load, 0.01 * all.peak_load);
}

/// The first release includes all elements. Afterwards the body equals that of free particles, and
/// the search ignores elements.
TEST(Hosts, OfWhichNoneIsLeftChangeNothing) {
  Events free, embedded;
  const DamageResult all = run_case_of(beam_case(""), free);
  const DamageResult some =
      run_case_of(beam_case("[elements]\nspacings = 4\nhalo = 1000.0\n"), embedded);
  EXPECT_EQ(some.elements, 0);
  EXPECT_EQ(embedded.elements, free.elements);
  ASSERT_EQ(embedded.load_factors.size(), free.load_factors.size());
  for (std::size_t k = 0; k < free.load_factors.size(); ++k) {
    EXPECT_NEAR(embedded.load_factors[k], free.load_factors[k], 1e-9 * free.load_factors[k]) << k;
  }
  EXPECT_EQ(some.termination, all.termination) << some.reason;
}

/// Returns a case of a plate with the law of concrete, torn from a pre-crack.
std::string concrete_plate(const std::string& more) {
  return R"([body]
model = "micropolar"
spacing = 2.5
horizon_ratio = 3
[[regions]]
name = "plate"
x = [0, 60]
y = [0, 120]
[[regions]]
name = "bottom"
x = [0, 60]
y = [0, 0]
[[regions]]
name = "top"
x = [0, 60]
y = [120, 120]
[[materials]]
region = "plate"
youngs_modulus = 30000.0
poissons_ratio = 0.2
softening = "concrete"
tension_limit = 1.4e-4
tension_factor = 3
compression_limit = 1e-3
compression_factor = 3
[[cracks]]
points = [[-1, 61], [20, 61]]
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[loads]]
region = "top"
force = [0, 100]
[stop]
broken_bonds = 40
)" + more;
}

TEST(Hosts, BondsOfConcreteKeepTheirLimitsWhenTheyAreFreed) {
  Events free, embedded;
  const DamageResult all = run_case_of(concrete_plate(""), free);
  const DamageResult some = run_case_of(concrete_plate("[elements]\nspacings = 4\n"), embedded);
  EXPECT_NEAR(some.peak_load, all.peak_load, 0.01 * all.peak_load);
  EXPECT_NEAR(embedded.load_factors[0], free.load_factors[0], 0.02 * free.load_factors[0]);
  EXPECT_EQ(embedded.elements[0], free.elements[0]);
}

/// The beam above with another feature of event analyses, by edits of its lines.
struct Feature {
  const char* name;
  std::vector<std::pair<std::string, std::string>> edits;
  std::string more;
  std::string elements = "";  ///< further keys of [elements]
};

void PrintTo(const Feature& feature, std::ostream* out) { *out << feature.name; }

class EmbeddedFeatures : public testing::TestWithParam<Feature> {};

/// The margins are those of ConversionKeepsTheEventsAndTheEnergies. Two of the first twenty events
/// may come later, because some nearly tie.
TEST_P(EmbeddedFeatures, AreThoseOfFreeParticles) {
  const auto with = [](const std::string& elements) {
    std::string text = beam_case(GetParam().more + elements);
    for (const auto& [from, to] : GetParam().edits) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    return text;
  };
  Events free, embedded;
  const DamageResult all = run_case_of(with(""), free);
  const DamageResult some =
      run_case_of(with("[elements]\nspacings = 4\n" + GetParam().elements), embedded);
  EXPECT_EQ(some.termination, all.termination) << some.reason << " / " << all.reason;
  EXPECT_GT(some.conversions, 0);
  EXPECT_EQ(some.missed_releases, 0);
  EXPECT_LT(some.unknowns, all.unknowns);
  EXPECT_LT(some.energy_error, 1e-9);
  EXPECT_NEAR(some.peak_load, all.peak_load, 0.01 * all.peak_load);
  ASSERT_GE(std::min(embedded.elements.size(), free.elements.size()), 20u);
  free.elements.resize(20);
  EXPECT_GE(std::count_if(embedded.elements.begin(), embedded.elements.begin() + 20,
                          [&](Index element) {
                            return std::count(free.elements.begin(), free.elements.end(), element);
                          }),
            18);
  EXPECT_NEAR(embedded.load_factors[0], free.load_factors[0], 0.02 * free.load_factors[0]);
}

const std::pair<std::string, std::string> no_stop = {"[stop]\nbroken_bonds = 120\n", ""};
const std::pair<std::string, std::string> pushed = {"force = [0, -100]",
                                                    "force = [0, -100]\nstage = \"push\""};
const std::string embedded_weight = R"([[loads]]
region = "beam"
body_force = [0, -0.001]
stage = "weight"
[[stages]]
name = "weight"
to = 1
[[stages]]
name = "push"
broken_bonds = 20
[[stages]]
name = "unload"
loads = "push"
to_load = 0
[[stages]]
name = "again"
loads = "push"
broken_bonds = 80
)";

INSTANTIATE_TEST_SUITE_P(
    Beams, EmbeddedFeatures,
    testing::Values(
        Feature{"stages", {no_stop, pushed}, embedded_weight},
        Feature{"driven_stages",
                {no_stop,
                 {"[[loads]]\nregion = \"load\"\nforce = [0, -100]",
                  "[[displacements]]\nregion = \"load\"\ny = -0.1\nstage = \"push\""}},
                embedded_weight},
        Feature{"softening",
                {{"fracture_energy = 0.1\n", "fracture_energy = 0.1\ntensile_strength = 4\n"},
                 {"broken_bonds = 120", "load_fraction = 0.9"}},
                ""},
        Feature{"bars",
                {},
                "[[rebar]]\nfrom = [4, 4]\nto = [156, 4]\nyoungs_modulus = 2e5\narea = 4\n"
                "yield_strength = 500\n"},
        // Bonds break at 3.9e-4.
        Feature{"strains", {}, "", "alert_strain = 1e-4\n"},
        Feature{"two_tips", {}, "[[cracks]]\npoints = [[71, -1], [71, 11]]\n"}),
    [](const auto& feature) { return std::string(feature.param.name); });

/// This late release threshold without a buffer zone misses bonds beyond their limit.
const std::string missed_elements = "[elements]\nspacings = 4\nalert = 0.99\nhalo = 0.01\n";

TEST(Hosts, LateConversionsAreCounted) {
  const CaseFile input = parse_case(beam_case(missed_elements), "beam.toml");
  const Model model = build_model(input);
  DamageOptions options = damage_options(input, 1);
  Events events;
  EXPECT_EQ(run_damage_analysis(model, options, events).missed_releases, 1);
  options.begins_again = true;
  EventRun run(model, options);
  while (run.next() != nullptr) {
  }
  ASSERT_TRUE(run.missed_release()) << "began with an element too many";
  const auto whole = [](const std::vector<std::uint8_t>& flags) {
    return std::count(flags.begin(), flags.end(), 1);
  };
  EXPECT_LT(whole(*run.missed_release()), whole(model.embedded->whole));
}

/// The history equals that of the run without unneeded elements; restarted runs leave no rows.
TEST(Hosts, ARunBeginsAgainAfterALateConversion) {
  const test::TemporaryDirectory work;
  const CaseFile input =
      parse_case(beam_case(missed_elements + "[output]\nfields_every = 40\n"), "beam.toml");
  DamageRun run(input, 1, true);
  run.open(work.path(), true);
  run.analyse();
  run.files().finish();
  Events free;
  const DamageResult all = run_case_of(beam_case(""), free);
  const std::string history = (work / "history.csv").string();
  const std::vector<StepRecord> rows = history_records(read_csv(history), history);
  ASSERT_EQ(rows.size(), free.elements.size());
  double peak = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].step, static_cast<Index>(k + 1));
    peak = std::max(peak, rows[k].load);
  }
  EXPECT_NEAR(peak, all.peak_load, 0.01 * all.peak_load);
  // After 0, 40, 80 and 120, and at the peak.
  EXPECT_EQ(read_pvd((work / "fields.pvd").string()).size(), 5u);
}

/// One load step reports the missed releases of many steps, though it has one row.
TEST(Hosts, LateConversionsOfTheFirstLoadStepAreCounted) {
  const auto late_in = [](const std::string& factors) {
    const CaseFile input =
        parse_case(beam_case(missed_elements + "[analysis]\ncontrol = \"steps\"\nload_factors = [" +
                             factors + "]\n"),
                   "beam.toml");
    const Model model = build_model(input);
    Events events;
    return run_damage_analysis(model, damage_options(input, 1), events).missed_releases;
  };
  EXPECT_GE(late_in("13.0"), 1);
}

TEST(Hosts, StepsConvertWhatTheyReachAlone) {
  std::string steps = beam_case(
      "[elements]\nspacings = 4\nalert = 0.9\n[analysis]\n"
      "control = \"steps\"\nload_factors = [1e-4, 2e-4]\n");
  Events events;
  const DamageResult result = run_case_of(steps, events);
  EXPECT_EQ(result.conversions, 0);
}

}  // namespace
}  // namespace perilink
