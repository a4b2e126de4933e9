// The concrete tests of Nikravesh (2017) by explicit lattices: peak forces, energies and their
// balance. Writes one table for every kind of test, or only those whose names are given.

#include <algorithm>
#include <string>
#include <vector>

#include "problems/program.hpp"
#include "problems/result.hpp"
#include "tests.hpp"

namespace {

using namespace perilink::verification;

const std::vector<std::string> variants = {"2017", "consistent"};

std::vector<LatticeTest> turned(LatticeTest (*test)(const std::string&, double)) {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (const double degrees : {0.0, 15.0, 30.0}) tests.push_back(test(variant, degrees));
  }
  return tests;
}

std::vector<LatticeTest> dog_bones() {
  std::vector<LatticeTest> tests;
  for (const std::string& variant : variants) {
    for (const double spacing : {0.008, 0.004}) {
      tests.push_back(dog_bone_test(variant, 'B', spacing));
    }
    for (const double spacing : {0.016, 0.008}) {
      tests.push_back(dog_bone_test(variant, 'D', spacing));
    }
  }
  return tests;
}

}  // namespace

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  constexpr int threads = 2;
  const auto run = [&](const std::string& name, const std::vector<LatticeTest>& tests) {
    if (!arguments.empty() && std::ranges::find(arguments, name) == arguments.end()) return;
    write_result(PERILINK_STUDY_DIR, run_lattice_tests(tests, threads), name + ".csv");
  };
  run("tension", turned(tension_test));
  run("compression", turned(compression_test));
  run("cylinder", turned(cylinder_test));
  run("dog_bone", dog_bones());
  return true;
}
