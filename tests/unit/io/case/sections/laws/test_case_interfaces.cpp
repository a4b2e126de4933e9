#include "io/case/sections/laws/case_interfaces.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;

CaseFile case_with(const std::string& section) {
  return parse_case(strip_text + std::string("\n[[interfaces]]\n") + section, "strip.toml");
}

TEST(CaseInterfaces, AreBrittleWithoutAStrength) {
  const CaseFile input = case_with("points = [[0, 25], [40, 25]]\nfracture_energy = 0.002\n");
  ASSERT_EQ(input.interfaces.size(), 1u);
  const InterfaceSection& face = input.interfaces[0];
  EXPECT_EQ(face.softening.shape.kind, Softening::brittle);
  EXPECT_EQ(face.fracture_energy, 0.002);
  EXPECT_EQ(face.points.size(), 2u);
  EXPECT_TRUE(face.between.empty());
}

TEST(CaseInterfaces, AreReadAgainAsTheyAreWritten) {
  for (const char* text :
       {"between = [\"strip\", \"lower end\"]\nfracture_energy = 0.002\ntensile_strength = 0.1\n",
        "points = [[0, 25], [40, 25]]\nsoftening_stretches = [1e-4, 1e-3]\n",
        "points = [[0, 25], [40, 25], [50, 30]]\nfracture_energy = 1\nclosing = true\n"}) {
    const std::string written = write_case(case_with(text));
    const CaseFile again = parse_case(written, "again.toml");
    ASSERT_EQ(again.interfaces.size(), 1u) << written;
    EXPECT_EQ(write_case(again), written);
  }
}

TEST(CaseInterfaces, AreRefusedBesideConcrete) {
  CaseFile input = case_with("points = [[0, 25], [40, 25]]\nfracture_energy = 0.002\n");
  input.materials[0].softening.shape.kind = Softening::concrete;
  try {
    check_interfaces(input);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, "materials[1].softening");
    EXPECT_NE(std::string(error.what()).find("[[interfaces]]"), std::string::npos);
  }
}

}  // namespace
}  // namespace perilink
