#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::test {

/// Strip of 40 by 80 with 5 by 9 particles, fixed at its lower end and with the force 12 at its
/// upper end. Tests change its sections.
inline constexpr const char* strip_text = R"(title = "A strip in tension"
units = "kip, in"

[body]
problem = "plane_stress"
thickness = 2.0
spacing = 10.0
horizon = 31.0

[[regions]]
name = "strip"
x = [0, 40]
y = [0, 80]

[[regions]]
name = "lower end"
x = [0, 40]
y = [0, 20]

[[regions]]
name = "upper end"
x = [0, 40]
y = [60, 80]

[[regions]]
name = "middle"
x = [-10, 50]
y = [40, 40.5]

[[materials]]
region = "strip"
youngs_modulus = 3000.0
fracture_energy = 0.001

[[supports]]
region = "lower end"
fix = ["x", "y"]

[[loads]]
region = "upper end"
force = [0, 12]
)";

inline CaseFile strip_case() { return parse_case(strip_text, "strip.toml"); }

/// Returns a strip without supports, with balanced tension at its ends.
inline CaseFile free_strip_case() {
  CaseFile input = strip_case();
  input.supports.clear();
  LoadSection below;
  below.region = "lower end";
  below.force = Vector3{0.0, -12.0, 0.0};
  input.loads.push_back(below);
  input.analysis.rigid_body_modes = RigidBodyModes::pin;
  return input;
}

/// Bar with 4 by 4 by 8 spacings of 0.1, fixed at its lower end and with the force 3 at its upper
/// end.
inline constexpr const char* prism_text = R"(title = "A prism in tension"

[body]
problem = "three_dimensional"
spacing = 0.1
horizon_ratio = 2.0

[[regions]]
name = "prism"
x = [0, 0.4]
y = [0, 0.8]
z = [0, 0.4]

[[regions]]
name = "lower end"
x = [0, 0.4]
y = [0, 0.05]
z = [0, 0.4]

[[regions]]
name = "upper end"
x = [0, 0.4]
y = [0.75, 0.8]
z = [0, 0.4]

[[materials]]
region = "prism"
youngs_modulus = 200.0
fracture_energy = 0.001

[[supports]]
region = "lower end"
fix = ["x", "y", "z"]

[[loads]]
region = "upper end"
force = [0, 3, 0]
)";

inline CaseFile prism_case() { return parse_case(prism_text, "prism.toml"); }

/// Expects that a case is refused at a key, with a text in the message.
inline void expect_refused(const CaseFile& input, const std::string& key, const std::string& text) {
  try {
    build_model(input);
    ADD_FAILURE() << "accepted; expected a refusal of " << key;
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, key) << error.what();
    EXPECT_EQ(error.where().file, input.source.path);
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

}  // namespace perilink::test
