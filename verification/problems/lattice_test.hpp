#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "io/case/case_file.hpp"

namespace perilink::verification {

/// A laboratory test by explicit lattices: a case of meshes/ with its lattice turned, and with
/// other rules, spacing, size or material.
struct LatticeTest {
  std::string case_name;  ///< "brazilian_disc" is meshes/brazilian_disc.toml
  std::string variant = "consistent";
  double degrees = 0.0;
  double spacing = 0.0;                   ///< zero: the case's [length]
  Vector3 offset{};                       ///< from the case's lattice point [length]
  double time_step = 0.0;                 ///< zero: nine tenths of the critical one [time]
  double speed = 1.0;                     ///< factor on the case's speed of loading
  bool only_to_peak = false;              ///< ends where the force has fallen to half of its peak
  std::function<void(CaseFile&)> change;  ///< whatever else differs from the case; may be empty
};

struct LatticeTestRun {
  Index particles = 0;
  double peak_force = 0.0;         ///< between the ends of the body [force]
  double peak_displacement = 0.0;  ///< displacement of one driven end [length]
  ExplicitResult result;
  std::vector<Vector3> cracked;  ///< particles with more damage than 0.9 [length]
  double seconds = 0.0;
};

/// The case of a test.
/// \throws InputError where the case does not allow what differs
CaseFile case_of(const LatticeTest& test);

LatticeTestRun run_lattice_test(const LatticeTest& test);

/// Runs tests side by side, `threads` at a time; prints a row for each when it ends.
/// \returns what they gave, in the order of the tests
std::vector<LatticeTestRun> run_side_by_side(const std::vector<LatticeTest>& tests, int threads);

/// The same, as a table.
std::string run_lattice_tests(const std::vector<LatticeTest>& tests, int threads);

}  // namespace perilink::verification
