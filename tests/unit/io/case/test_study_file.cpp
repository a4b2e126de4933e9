#include "io/case/study_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace perilink {
namespace {

const std::string vary = "[vary]\nspacing = [0.2, 0.1, 0.05]\n";
const std::string energy_error = "[error]\nquantity = \"strain_energy\"\nreference = 2.5\n";

StudyFile parse(const std::string& text) { return parse_study(text, "studies/a.toml"); }

StudyFile valid() { return parse("case = \"b.toml\"\n" + vary + energy_error); }

struct StudyRefusal {
  const char* name;
  std::string text;
  std::string key;
  std::string says;
};
void PrintTo(const StudyRefusal& refusal, std::ostream* stream) { *stream << refusal.name; }

class StudyRefusals : public testing::TestWithParam<StudyRefusal> {};

TEST_P(StudyRefusals, NameTheKeyAndTheFault) {
  try {
    parse(GetParam().text);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, GetParam().key) << error.what();
    EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos) << error.what();
  }
}

const std::string head = "case = \"b.toml\"\n";

INSTANTIATE_TEST_SUITE_P(
    Keys, StudyRefusals,
    testing::Values(
        StudyRefusal{"noCase", vary + energy_error, "case", "is missing"},
        StudyRefusal{"noVary", head + energy_error, "", "no [vary]"},
        StudyRefusal{"noError", head + vary, "", "no [error]"},
        StudyRefusal{"unknownKey", head + "[vary]\nspacings = [1, 2]\n" + energy_error,
                     "vary.spacings", "did you mean `spacing`?"},
        StudyRefusal{"unknownTable", head + vary + energy_error + "[loads]\nspacing = 1\n", "loads",
                     "a study has no such table"},
        StudyRefusal{"noRefinement", head + "[vary]\nhorizon_ratio = [2, 3]\n" + energy_error,
                     "vary", "has none of"},
        StudyRefusal{"twoRefinements", head + vary + "columns = [2, 3]\n" + energy_error,
                     "vary.columns", "together with `spacing`"},
        StudyRefusal{"oneValue", head + "[vary]\nspacing = [0.1]\n" + energy_error, "vary.spacing",
                     "holds one value"},
        StudyRefusal{"twice", head + "[vary]\nspacing = [0.1, 0.2, 0.1]\n" + energy_error,
                     "vary.spacing", "holds 0.1 twice"},
        StudyRefusal{"negative", head + "[vary]\nspacing = [0.1, -0.2]\n" + energy_error,
                     "vary.spacing", "greater than zero"},
        StudyRefusal{"smallRatio", head + vary + "horizon_ratio = [0.5, 2]\n" + energy_error,
                     "vary.horizon_ratio", "less than 1"},
        StudyRefusal{"emptyList", head + vary + "surface = []\n" + energy_error, "vary.surface",
                     "is empty"},
        StudyRefusal{"misspeltSurface", head + vary + "surface = [\"gost\"]\n" + energy_error,
                     "vary.surface", "did you mean `ghost`?"},
        StudyRefusal{"misspeltMethod", head + vary + "method = [\"linear\"]\n" + energy_error,
                     "vary.method", "not one of the choices"},
        StudyRefusal{"aCase", head + "[body]\nspacing = 0.1\n", "body", "perilink run"},
        StudyRefusal{"noMeasure", head + vary + "[error]\nreference = 1\n", "error", "has none of"},
        StudyRefusal{"twoMeasures", head + vary + energy_error + "gauge = \"mouth\"\n",
                     "error.quantity", "together with `gauge`"},
        StudyRefusal{"emptyGauge", head + vary + "[error]\ngauge = \"\"\nreference = \"finest\"\n",
                     "error.gauge", "is empty"},
        StudyRefusal{"noReference", head + vary + "[error]\nquantity = \"peak_load\"\n",
                     "error.reference", "is missing"},
        StudyRefusal{"zeroReference",
                     head + vary + "[error]\nquantity = \"peak_load\"\nreference = 0\n",
                     "error.reference", "is zero"},
        StudyRefusal{"unknownQuantity",
                     head + vary + "[error]\nquantity = \"load\"\nreference = 1\n",
                     "error.quantity", "not one of the choices"},
        StudyRefusal{"extrapolationOfTwo",
                     head + "[vary]\nspacing = [0.2, 0.1]\n[error]\nquantity = \"peak_load\"\n" +
                         "reference = \"extrapolated\"\n",
                     "error.reference", "needs three"},
        StudyRefusal{"oneFormula", head + vary + "[error]\ndisplacement = [\"x\"]\n",
                     "error.displacement", "has 1 formula"},
        StudyRefusal{"emptyFormula", head + vary + "[error]\ndisplacement = [\"x\", \"\"]\n",
                     "error.displacement", "nothing at character 1"},
        StudyRefusal{"badFormula", head + vary + "[error]\ndisplacement = [\"x\", \"sinus(y)\"]\n",
                     "error.displacement", "\"sinus(y)\""},
        StudyRefusal{"fieldWithReference",
                     head + vary + "[error]\ndisplacement = [\"x\", \"y\"]\nreference = 1\n",
                     "error.reference", "is the reference itself"},
        StudyRefusal{"rigidMotionOfANumber",
                     head + vary + energy_error + "rigid_motion = \"removed\"\n",
                     "error.rigid_motion", "only a displacement field"},
        StudyRefusal{"equalNames",
                     head + vary + "[" + energy_error.substr(0, 7) + "]" + energy_error.substr(7) +
                         "[" + energy_error.substr(0, 7) + "]" + energy_error.substr(7),
                     "error[2].name", "the name of another error"},
        StudyRefusal{"noRepeats", "repeats = 0\n" + head + vary + energy_error, "repeats",
                     "from 1"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(StudyFile, ReadsEveryKey) {
  const StudyFile study = parse(R"(title = "Beam"
case = "../cases/beam.toml"
repeats = 3

[vary]
columns = [11, 21]
horizon_ratio = [2, 3.5]
surface = ["none", "ghost"]
method = ["bonds", "linear_elements"]

[[error]]
name = "field"
displacement = ["x*y", "0"]
rigid_motion = "removed"

[[error]]
gauge = "tip"
reference = "finest"
)");
  EXPECT_EQ(study.title, "Beam");
  EXPECT_EQ(study.case_path, "cases/beam.toml") << "relative to the study";
  EXPECT_EQ(study.repeats, 3);
  EXPECT_EQ(study.vary.refinement, Refinement::columns);
  ASSERT_EQ(study.vary.values.size(), 2u);
  EXPECT_EQ(study.vary.values[1].integer, 21);
  EXPECT_EQ(study.vary.horizon_ratio, (std::vector<double>{2.0, 3.5}));
  EXPECT_EQ(study.vary.surface, (std::vector{Surface::none, Surface::ghost}));
  EXPECT_EQ(study.vary.method, (std::vector{BodyMethod::bonds, BodyMethod::linear_elements}));
  ASSERT_EQ(study.errors.size(), 2u);
  EXPECT_TRUE(study.errors[0].is_field());
  EXPECT_EQ(study.errors[0].rigid_motion, RigidMotion::removed);
  EXPECT_EQ(study.errors[0].name, "field");
  EXPECT_EQ(study.errors[1].name, "tip") << "named after the gauge";
  EXPECT_EQ(study.errors[1].reference, Reference::finest);
}

TEST(StudyFile, DefaultsAreOneRepeatAndAnErrorNamedAfterWhatItMeasures) {
  const StudyFile study = valid();
  EXPECT_EQ(study.repeats, 1);
  EXPECT_EQ(study.errors.front().name, "strain_energy");
  EXPECT_EQ(study.errors.front().reference_value, 2.5);
  EXPECT_TRUE(study.vary.surface.empty());
}

TEST(StudyFile, WhatIsWrittenReadsBackFromAnotherFolder) {
  const StudyFile study = parse(
      std::string(
          "case = \"../cases/b.toml\"\nrepeats = 2\n[vary]\nmesh = [\"m/a.msh\", \"m/b.msh\"]\n") +
      "surface = [\"none\"]\n[error]\ndisplacement = [\"x\", \"y\"]\n");
  const std::string text = write_study(study, "results/a", study.case_path);
  const StudyFile again = parse_study(text, "results/a/study.toml");
  EXPECT_EQ(again.case_path, study.case_path);
  ASSERT_EQ(again.vary.values.size(), 2u);
  EXPECT_EQ(again.vary.values[1].text, "../studies/m/b.msh") << "from the folder of the case";
  EXPECT_EQ(write_study(again, "results/a", again.case_path), text);
}

}  // namespace
}  // namespace perilink
