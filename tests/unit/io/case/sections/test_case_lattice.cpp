#include "io/case/sections/case_lattice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// The case without damage.
std::string elastic_case() {
  return replaced(replaced(lattice_case, "tensile_strength = 0.003\n", ""),
                  "fracture_energy = 1e-5", "fracture_energy = \"infinite\"");
}

/// In space, elastic.
std::string space_case() {
  std::string text = replaced(elastic_case(), "offset = [0.025, 0]", "offset = [0.025, 0, 0]");
  text = replaced(text, "model = ", "problem = \"three_dimensional\"\nmodel = ");
  text = replaced(text, "y = [0, 2]\n", "y = [0, 2]\nz = [0, 1]\n");
  return replaced(text, "y = [1.8, 2]\n", "y = [1.8, 2]\nz = [0, 1]\n");
}

TEST(CaseLattice, ReadsTheBody) {
  const CaseFile input = parse_case(lattice_case, "");
  EXPECT_TRUE(is_lattice(input.body));
  EXPECT_EQ(input.body.pattern, Pattern::hexagonal);
  EXPECT_EQ(input.body.spacing, 0.1);
  EXPECT_EQ(input.body.rotation, 15.0);
  EXPECT_EQ(input.body.offset, (Vector3{0.025, 0.0, 0.0}));
  EXPECT_EQ(input.body.variant, LatticeRules::least_2018);
  EXPECT_EQ(parse_case(space_case(), "").body.pattern, Pattern::face_centred);
}

TEST(CaseLattice, ReadsMeshesAndHoles) {
  std::string text =
      replaced(lattice_case, "variant", "mesh = \"disc.geo\"\nmesh_size = 2\nvariant");
  text = replaced(text, "[[materials]]\n", "[[materials]]\nholes = [\"ring\"]\n");
  text += "\n[[regions]]\nname = \"ring\"\ncenter = [0, 1]\nradius = 0.5\n";
  const CaseFile input = parse_case(text, "");
  EXPECT_EQ(input.body.mesh, "disc.geo");
  EXPECT_EQ(input.body.mesh_size, 2.0);
  EXPECT_EQ(input.body.pattern, Pattern::hexagonal) << "the lattice's, not the mesh's";
  EXPECT_EQ(input.materials[0].holes, (std::vector<std::string>{"ring"}));
  const CaseFile again = parse_case(write_case(input), "");
  EXPECT_EQ(again.body.mesh, "disc.geo");
  EXPECT_EQ(again.body.mesh_size, 2.0);
  EXPECT_EQ(again.materials[0].holes, input.materials[0].holes);
}

TEST(CaseLattice, ReadsTheMaterial) {
  const MaterialSection material = parse_case(lattice_case, "").materials.front();
  ASSERT_TRUE(material.lattice.has_value());
  EXPECT_EQ(material.poissons_ratio, 0.2);
  EXPECT_EQ(material.fracture_energy, 1e-5);
  EXPECT_EQ(material.density, 2.5);
  EXPECT_EQ(material.lattice->tensile_strength, 0.003);
  EXPECT_FALSE(material.lattice->critical_opening);
  EXPECT_EQ(material.lattice->external_damping, 0.05);
  EXPECT_EQ(material.lattice->fundamental_period, 0.7);
  EXPECT_EQ(material.lattice->internal_damping, 0.0);
}

TEST(CaseLattice, DefaultsOfTheMaterialAreThoseOfTheVariantsPaper) {
  const auto material = [](const std::string& variant) {
    const std::string text = replaced(lattice_case, "variant = \"2018\"", variant);
    return *parse_case(text, "").materials.front().lattice;
  };
  EXPECT_EQ(material("").boundary_factor, 1.0);
  EXPECT_EQ(material("").compression_threshold, 1.0 / 3.0);
  EXPECT_EQ(material("variant = \"2018\"").boundary_factor, 0.2);
  EXPECT_EQ(material("variant = \"2018\"").compression_threshold, 0.8);
  EXPECT_EQ(material("variant = \"2017\"").boundary_factor, 0.2);
  EXPECT_EQ(material("variant = \"2017\"").compression_threshold, 1.0 / 3.0);
}

TEST(CaseLattice, UnbreakableMaterialsHaveNoStrength) {
  const MaterialSection material = parse_case(elastic_case(), "").materials.front();
  EXPECT_TRUE(std::isinf(material.fracture_energy));
  EXPECT_FALSE(material.lattice->tensile_strength);
}

TEST(CaseLattice, ElasticAnalysesNeedNoFractureEnergy) {
  const std::string text = replaced(lattice_case, "fracture_energy = 1e-5\n", "");
  EXPECT_THAT(message_of(text), HasSubstr("has none of `fracture_energy` or `critical_opening`"));
  const CaseFile input = parse_case(replaced(text, "\"explicit\"", "\"elastic\""), "");
  EXPECT_TRUE(std::isinf(input.materials[0].fracture_energy));
  EXPECT_FALSE(input.materials[0].lattice->tensile_strength) << "of a law that nothing follows";
  EXPECT_THAT(message_of(write_case(input)), HasSubstr("accepted"));
}

TEST(CaseLattice, ReadsTheAnalysis) {
  const CaseFile input = parse_case(lattice_case, "");
  EXPECT_EQ(input.analysis.type, AnalysisType::explicit_);
  EXPECT_EQ(input.analysis.duration, 4.0);
  EXPECT_EQ(input.analysis.ramp_time, 4.0) << "the default";
  EXPECT_EQ(input.analysis.time_step, 0.001);
  EXPECT_EQ(input.analysis.rows, 500);
  EXPECT_EQ(input.output.fields_times, (std::vector<double>{0.5, 4.0}));
  const std::string ramped =
      replaced(lattice_case, "time_step = 0.001", "ramp_time = 1\nsafety = 0.5\nrows = 20");
  const AnalysisSection analysis = parse_case(ramped, "").analysis;
  EXPECT_FALSE(analysis.time_step);
  EXPECT_EQ(analysis.ramp_time, 1.0);
  EXPECT_EQ(analysis.safety, 0.5);
  EXPECT_EQ(analysis.rows, 20);
}

TEST(CaseLattice, IsWrittenSoThatItReadsBack) {
  const std::string opening =
      replaced(lattice_case, "fracture_energy = 1e-5", "critical_opening = 0.02");
  for (const std::string& text : {std::string(lattice_case), elastic_case(), space_case(), opening,
                                  replaced(lattice_case, "time_step = 0.001", "safety = 0.5")}) {
    const CaseFile input = parse_case(text, "");
    const std::string written = write_case(input);
    const CaseFile again = parse_case(written, "");
    EXPECT_EQ(write_case(again), written);
    EXPECT_EQ(again.body.offset, input.body.offset);
    EXPECT_EQ(again.body.rotation, input.body.rotation);
    EXPECT_EQ(again.body.variant, input.body.variant);
    EXPECT_EQ(again.materials[0].fracture_energy, input.materials[0].fracture_energy);
    EXPECT_EQ(again.materials[0].density, input.materials[0].density);
    const LatticeMaterialSection &a = *again.materials[0].lattice, &b = *input.materials[0].lattice;
    EXPECT_EQ(a.tensile_strength, b.tensile_strength);
    EXPECT_EQ(a.critical_opening, b.critical_opening);
    EXPECT_EQ(a.boundary_factor, b.boundary_factor);
    EXPECT_EQ(a.fundamental_period, b.fundamental_period);
    EXPECT_EQ(again.analysis.duration, input.analysis.duration);
    EXPECT_EQ(again.analysis.time_step, input.analysis.time_step);
    EXPECT_EQ(again.analysis.safety, input.analysis.safety);
    EXPECT_EQ(again.output.fields_times, input.output.fields_times);
  }
}

/// A change of the case and what the refusal says.
struct Refusal {
  const char* from;
  const char* to;
  std::vector<std::string> texts;
};

void expect_refusals(const std::string& text, const std::vector<Refusal>& refusals) {
  for (const Refusal& refusal : refusals) {
    const std::string message = message_of(replaced(text, refusal.from, refusal.to));
    for (const std::string& part : refusal.texts) {
      EXPECT_THAT(message, HasSubstr(part)) << refusal.to;
    }
  }
}

TEST(CaseLattice, RefusesBodiesThatHaveNoLattice) {
  for (const char* key : {"columns = 11", "surface = \"calibrated\"", "horizon = 1",
                          "horizon_level = 2", "horizon_ratio = 3", "micromodulus = \"lattice\"",
                          "critical_stretch = \"lattice\"", "torsion = 1"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(' '));
    const std::string with_key = std::string(key) + "\nvariant";
    expect_refusals(lattice_case,
                    {{"variant", with_key.c_str(), {"body." + name, "model = \"lattice\""}}});
  }
  expect_refusals(lattice_case,
                  {{"spacing = 0.1\n", "", {"body.spacing", "missing"}},
                   {"spacing = 0.1",
                    "spacing = 0.1\npattern = \"rectangular\"",
                    {"body.pattern", "Allowed here: hexagonal"}},
                   {"rotation = 15", "rotation = 400", {"body.rotation", "from -360 to 360"}},
                   {"offset = [0.025, 0]", "offset = [1]", {"body.offset"}},
                   {"\"2018\"", "\"2019\"", {"body.variant", "consistent"}},
                   {"model = \"lattice\"",
                    "method = \"linear_elements\"\nmodel = \"lattice\"",
                    {"body.model", "linear elements have no bonds"}}});
  expect_refusals(space_case(), {{"spacing = 0.1",
                                  "spacing = 0.1\npattern = \"cubic\"",
                                  {"body.pattern", "Allowed here: face_centred"}}});
  for (const char* key : {"rotation = 1", "offset = [0, 0]", "variant = \"2018\""}) {
    const std::string with_key = std::string(key) + "\nhorizon_ratio";
    expect_refusals(small_case, {{"horizon_ratio", with_key.c_str(), {"model is \"bond_based\""}}});
  }
}

TEST(CaseLattice, RefusesMaterials) {
  expect_refusals(
      lattice_case,
      {{"poissons_ratio = 0.2\n", "", {"materials[1].poissons_ratio", "missing"}},
       {"poissons_ratio = 0.2", "poissons_ratio = 0.5", {"below 1/2"}},
       {"tensile_strength = 0.003\n", "", {"materials[1].tensile_strength", "missing"}},
       {"fracture_energy = 1e-5\n", "", {"fracture_energy", "critical_opening"}},
       {"fracture_energy = 1e-5",
        "fracture_energy = 1e-5\ncritical_opening = 1",
        {"critical_opening", "fracture_energy"}},
       {"density", "knee_stress_ratio = 1\ndensity", {"must be less than 1"}},
       {"density", "knee_opening_ratio = 2\ndensity", {"must be less than 1"}},
       {"density", "compression_threshold = 1\ndensity", {"must be less than 1"}},
       {"density", "internal_damping = -0.1\ndensity", {"must not be negative"}},
       {"[[displacements]]",
        "[[materials]]\nregion = \"top\"\nyoungs_modulus = 1\npoissons_ratio = 0.2\ndensity = 1\n"
        "fracture_energy = \"infinite\"\n[[displacements]]",
        {"materials[2]", "is a second material"}}});
  expect_refusals(elastic_case(),
                  {{"density",
                    "tensile_strength = 1\ndensity",
                    {"materials[1].tensile_strength", "is unbreakable"}},
                   {"density", "boundary_factor = 1\ndensity", {"is unbreakable"}}});
  expect_refusals(small_case, {{"fracture_energy",
                                "compression_ratio = 1\nfracture_energy",
                                {"materials[1].compression_ratio", "model = \"lattice\""}}});
}

TEST(CaseLattice, RefusesAnalyses) {
  expect_refusals(
      lattice_case,
      {{"duration = 4\n", "", {"analysis.duration", "missing"}},
       {"duration = 4", "duration = 3", {"output.fields_times", "holds 4", "duration 3"}},
       {"time_step", "safety = 0.5\ntime_step", {"analysis.safety", "together with `time_step`"}},
       {"time_step = 0.001", "safety = 1.01", {"analysis.safety", "unstable"}},
       {"time_step", "rigid_body_modes = \"pin\"\ntime_step", {"analysis.rigid_body_modes"}},
       {"time_step", "masses = \"uniform\"\ntime_step", {"analysis.masses", "lattice"}},
       {"fields_times = [0.5, 4]", "fields_times = [2, 1]", {"has 1 after 2"}},
       {"fields_times = [0.5, 4]", "fields_times = [0]", {"is 0, but must be greater than zero"}}});
  const std::string elastic = replaced(lattice_case, "[output]\nfields_times = [0.5, 4]", "");
  EXPECT_EQ(message_of(replaced(elastic, "type = \"explicit\"\nduration = 4\ntime_step = 0.001",
                                "type = \"elastic\"")),
            "accepted");
  const std::string explicit_bonds =
      std::string(small_case) + "[analysis]\ntype = \"explicit\"\nduration = 1\n";
  EXPECT_THAT(message_of(explicit_bonds), HasSubstr("has no density"));
}

TEST(CaseLattice, RefusesTablesThatOnlyImplicitBodiesHave) {
  for (const char* table :
       {"[[tractions]]\nregion = \"top\"\npressure = 1\n", "[[symmetry]]\naxis = \"x\"\nat = 0\n",
        "[[springs]]\nregion = \"top\"\ntotal = [0, 1]\n",
        "[[cracks]]\npoints = [[0, 1], [1, 1]]\n",
        "[[rebar]]\nfrom = [0, 0]\nto = [0, 1]\nyoungs_modulus = 1\narea = 1\n"}) {
    const std::string name = std::string(table).substr(2, std::string(table).find(']') - 2);
    EXPECT_THAT(message_of(std::string(lattice_case) + table), HasSubstr(name + "[1]: is given"));
  }
  expect_refusals(
      lattice_case,
      {{"region = \"top\"\ny", "region = \"surface\"\ny", {"does not end on the surface"}},
       {"[[displacements]]",
        "[[supports]]\nregion = \"surface\"\nfix = [\"x\"]\n[[displacements]]",
        {"supports[1].region", "does not end on the surface"}},
       {"y = \"0.001*x\"", "rotation = 1", {"a lattice body do not rotate"}},
       {"y = \"0.001*x\"", "y = 0", {"the case has no load"}},
       {"[output]",
        "[[gauges]]\nname = \"a\"\nat = [0, 1]\nstress = \"xx\"\n[output]",
        {"gauges[1].stress", "elastic"}},
       {"[output]",
        "[[loads]]\nregion = \"surface\"\nforce = [0, 1]\n[output]",
        {"loads[1].region", "does not end on the surface"}}});
}

TEST(CaseLattice, TakesLoadsAndGauges) {
  const CaseFile input = parse_case(std::string(lattice_case) +
                                        "[[loads]]\nregion = \"top\"\nforce = [0, 1]\n"
                                        "[[point_loads]]\nat = [0, 1]\nforce = [0, 1]\n"
                                        "[[gauges]]\nname = \"a\"\nat = [0, 1]\naxis = \"x\"\n",
                                    "");
  EXPECT_EQ(input.loads.size() + input.point_loads.size() + input.gauges.size(), 3U);
}

const std::string yielding =
    "yield_strength = 0.02\nultimate_strength = 0.03\nultimate_plastic_strain = 0.003\n";

/// The lattice case by the consistent rules, with these keys in its material.
std::string yielding_case(const std::string& keys, const std::string& variant = "consistent") {
  const std::string text =
      replaced(lattice_case, "variant = \"2018\"", "variant = \"" + variant + "\"");
  return replaced(text, "tensile_strength", keys + "tensile_strength");
}

std::string yielding_refusal(const std::string& text) {
  try {
    parse_case(text, "");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CaseLatticeYielding, ReadsAndWritesTheCurve) {
  for (const std::string energy : {"0.4", "\"infinite\""}) {
    const CaseFile input =
        parse_case(yielding_case(yielding + "crushing_energy = " + energy + "\n"), "");
    const CaseFile again = parse_case(write_case(input), "");
    for (const CaseFile* each : {&input, &again}) {
      const LatticeMaterialSection& section = *each->materials.front().lattice;
      EXPECT_EQ(section.yield_strength, 0.02);
      EXPECT_EQ(section.ultimate_strength, 0.03);
      EXPECT_EQ(section.ultimate_plastic_strain, 0.003);
      EXPECT_EQ(std::isinf(*section.crushing_energy), energy != "0.4");
    }
  }
  EXPECT_FALSE(
      parse_case(yielding_case(""), "").materials.front().lattice->yield_strength.has_value());
  EXPECT_FALSE(parse_case(yielding_case(yielding, "2018"), "")
                   .materials.front()
                   .lattice->crushing_energy.has_value());
}

TEST(CaseLatticeYielding, RefusesWhatMakesNoSense) {
  EXPECT_THAT(yielding_refusal(yielding_case("ultimate_strength = 0.03\n")),
              HasSubstr("is given without `yield_strength`"));
  EXPECT_THAT(yielding_refusal(yielding_case("yield_strength = 0.02\n")),
              HasSubstr("ultimate_strength"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding)), HasSubstr("crushing_energy"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding + "crushing_energy = \"much\"\n")),
              HasSubstr("neither a number nor"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding + "crushing_energy = 1\n", "2017")),
              HasSubstr("have their own softening"));
  EXPECT_THAT(
      yielding_refusal(yielding_case(replaced(yielding, "0.03", "0.01") + "crushing_energy = 1\n")),
      HasSubstr("less than the yield strength"));
}

}  // namespace
}  // namespace perilink
