// The concrete tests of Nikravesh & Gerstle (2018) by explicit lattices: peak forces, energies and
// their balance by all three sets of rules. Writes one table for every kind of test, or
// only those whose names are given.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "problems/program.hpp"
#include "problems/result.hpp"
#include "tests.hpp"

namespace {

using namespace perilink::verification;

std::vector<LatticeTest> tension_tests() {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (const double degrees : {0.0, 15.0, 30.0}) tests.push_back(tension_test(variant, degrees));
  }
  return tests;
}

std::vector<LatticeTest> compression_tests() {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (const double degrees : {0.0, 15.0, 30.0}) {
      tests.push_back(compression_test(variant, degrees));
    }
  }
  return tests;
}

/// Blocks in tension by the consistent rules beside their own sections: does the strength, and the
/// energy that a crack takes, follow the spacing or the rotation?
std::string spacing_table(int threads) {
  std::vector<LatticeTest> tests;
  for (const double spacing : {0.01, 0.005, 0.0025}) {
    for (const double degrees : {0.0, 15.0, 30.0}) {
      tests.push_back(spaced_tension_test(degrees, spacing));
    }
  }
  const std::vector<LatticeTestRun> runs = run_side_by_side(tests, threads);
  std::string table =
      "degrees,spacing,particles,section,peak_force,over_strength,softening,open,fractured,"
      "over_fracture_energy,largest_surplus\n";
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const double section = mean_section(tests[k]);
    const perilink::ExplicitResult& result = runs[k].result;
    const double fractured = result.last.energy.fractured;
    table += fmt::format("{:g},{:g},{},{:.6f},{:.1f},{:.4f},{},{},{:.4f},{:.3f},{:.1e}\n",
                         tests[k].degrees, tests[k].spacing, runs[k].particles, section,
                         runs[k].peak_force, runs[k].peak_force / (tension_strength * section),
                         result.last.cracked_particles, runs[k].cracked.size(), fractured,
                         fractured / (fracture_energy * section), result.largest_surplus);
  }
  return table;
}

/// All whole degrees that differ, to the peak force.
std::vector<LatticeTest> rotation_tests() {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (int degrees = 0; degrees <= 30; ++degrees) {
      tests.push_back(compression_test(variant, degrees));
      tests.back().only_to_peak = true;
    }
  }
  return tests;
}

std::vector<LatticeTest> disc_tests() {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (const double degrees : {0.0, 15.0, 30.0}) {
      tests.push_back(disc_test(variant, degrees, 0.005));
    }
    for (const double spacing : {0.01, 0.0025}) tests.push_back(disc_test(variant, 0.0, spacing));
  }
  for (const double degrees : {15.0, 30.0}) {
    for (const double spacing : {0.01, 0.0025}) {
      tests.push_back(disc_test("consistent", degrees, spacing));
    }
  }
  return tests;
}

/// A lattice point off the centre by parts of the two lattice vectors.
struct Placement {
  double a = 0.0, b = 0.0;
};

/// Discs that differ in nothing but where the lattice lies.
std::string placement_table(int threads) {
  std::vector<LatticeTest> tests;
  std::vector<Placement> placements;
  for (const std::string variant : {"2018", "consistent"}) {
    for (const double degrees : {0.0, 15.0, 30.0}) {
      for (const double a : {0.0, 0.25, 0.5, 0.75}) {
        for (const double b : {0.0, 0.25, 0.5, 0.75}) {
          tests.push_back(placed_disc_test(variant, degrees, 0.005, a, b));
          tests.back().only_to_peak = true;
          placements.push_back({a, b});
        }
      }
    }
  }
  const std::vector<LatticeTestRun> runs = run_side_by_side(tests, threads);
  std::string table =
      "rules,degrees,a,b,particles,upper_half_platen,lower_half_platen,peak_force,"
      "peak_displacement\n";
  for (std::size_t k = 0; k < tests.size(); ++k) {
    table += fmt::format("{},{:g},{:g},{:g},{},{:.5f},{:.5f},{:.1f},{:.4g}\n", tests[k].variant,
                         tests[k].degrees, placements[k].a, placements[k].b, runs[k].particles,
                         half_platen(tests[k], true), half_platen(tests[k], false),
                         runs[k].peak_force, runs[k].peak_displacement);
  }
  return table;
}

/// What the discs of the consistent rules should bear.
std::string continuum_table() {
  std::string table =
      "degrees,spacing,a,b,radius,half_platen,cells,first_crack,peak,displacement,opening,ending\n";
  std::vector<LatticeTest> tests = disc_tests();
  std::vector<Placement> placements(tests.size());
  // Those of the placements at 30 degrees that differ and whose platens are alike.
  for (const Placement place :
       {Placement{0.0, 0.25}, {0.0, 0.5}, {0.25, 0.0}, {0.5, 0.0}, {0.5, 0.25}}) {
    tests.push_back(placed_disc_test("consistent", 30.0, 0.005, place.a, place.b));
    placements.push_back(place);
  }
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const LatticeTest& test = tests[k];
    if (test.variant != "consistent") continue;
    const CohesiveDisc disc = continuum_of(test);
    for (const int cells : {24, 48, 96}) {
      const SplittingLoad load = splitting_load(disc, cells);
      table += fmt::format("{:g},{:g},{:g},{:g},{:.5f},{:.5f},{},{:.1f},{:.1f},{:.4g},{:.3g},{}\n",
                           test.degrees, test.spacing, placements[k].a, placements[k].b,
                           disc.radius, disc.half_platen, cells, load.first_crack, load.peak,
                           load.displacement, load.opening, load.sudden ? "sudden" : "falling");
    }
  }
  return table;
}

}  // namespace

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  constexpr int threads = 2;
  const auto is_wanted = [&](const std::string& name) {
    return arguments.empty() || std::ranges::find(arguments, name) != arguments.end();
  };
  const auto run = [&](const std::string& name, const std::vector<LatticeTest>& tests) {
    if (!is_wanted(name)) return;
    write_result(PERILINK_STUDY_DIR, run_lattice_tests(tests, threads), name + ".csv");
  };
  run("tension", tension_tests());
  if (is_wanted("spacings")) {
    write_result(PERILINK_STUDY_DIR, spacing_table(threads), "spacings.csv");
  }
  run("compression", compression_tests());
  run("rotations", rotation_tests());
  run("disc", disc_tests());
  if (is_wanted("placements")) {
    write_result(PERILINK_STUDY_DIR, placement_table(threads), "placements.csv");
  }
  if (is_wanted("cohesive")) write_result(PERILINK_STUDY_DIR, continuum_table(), "cohesive.csv");
  return true;
}
