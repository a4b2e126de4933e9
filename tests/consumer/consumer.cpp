// Builds a case from text, solves it and runs it to collapse. The first argument is the directory
// of the results.

#include <cmath>
#include <cstdio>
#include <perilink.hpp>
#include <string>

namespace {

/// A strip of 2 by 1 that an end displacement of 0.04 stretches.
std::string strip(const std::string& analysis, const std::string& strength) {
  return R"([body]
spacing = 0.125
horizon_ratio = 2.5

[[regions]]
name = "strip"
x = [0, 2]
y = [0, 1]

[[regions]]
name = "left side"
x = [0, 0]
y = [0, 1]

[[regions]]
name = "corner"
x = [0, 0]
y = [0, 0]

[[regions]]
name = "right side"
x = [2, 2]
y = [0, 1]

[[materials]]
region = "strip"
youngs_modulus = 100
)" + strength +
         R"(

[[supports]]
region = "left side"
fix = ["x"]

[[supports]]
region = "corner"
fix = ["y"]

[[displacements]]
region = "right side"
x = 0.04

[analysis]
type = ")" +
         analysis + "\"\n";
}

bool expect(bool holds, const char* what, double value) {
  std::printf("%s: %s %.17g\n", holds ? "ok" : "FAILED", what, value);
  return holds;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace perilink;
  const std::string directory = argc > 1 ? argv[1] : "results";
  bool good = true;
  try {
    // Calibrated bonds are exact in uniform strain: E A u / L.
    const CaseFile elastic =
        parse_case(strip("elastic", "fracture_energy = \"infinite\""), "elastic");
    const double load = solve(elastic, build(elastic)).row.load;
    good &= expect(std::abs(load - 100.0 * 1.0 * 0.04 / 2.0) < 1e-9, "elastic load", load);

    // In uniform tension the body fails near the strength times the section, here 1; the bond law
    // is made for this strength, and supports disturb the uniform strain.
    const CaseFile brittle =
        parse_case(strip("damage", "fracture_energy = 0.01\ntensile_strength = 1.0"), "brittle");
    RunSettings settings;
    settings.old_results = OldResults::removed;
    Index rows = 0;
    settings.callbacks.on_row = [&](const RowProgress&) { ++rows; };
    const RunEnd end = run_case(brittle, directory, settings);
    const double peak = end.summary.json["peak_load"].get<double>();
    const CsvTable history = read_csv(directory + "/history.csv");
    double highest = 0.0;
    for (const auto& row : history.rows) {
      highest = std::max(highest, row.at(static_cast<std::size_t>(history.column("load"))));
    }
    good &= expect(end.termination == Termination::collapsed, "collapse", 1.0);
    good &= expect(peak > 0.9 && peak < 1.3, "peak", peak);
    good &= expect(highest == peak, "largest load of the history", highest);
    good &= expect(rows == static_cast<Index>(history.rows.size()), "rows", rows);
  } catch (const Error& error) {
    std::printf("FAILED: %s\n", error.what());
    return 1;
  }
  try {
    parse_case("[body]\nspacing = -1\nhorizon = 3\n", "faulty");
    return 1;
  } catch (const InputError& error) {
    good &= expect(error.where().key == "body.spacing", "line of the fault", error.where().line);
  }
  return good ? 0 : 1;
}
