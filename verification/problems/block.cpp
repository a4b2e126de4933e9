#include "problems/block.hpp"

#include <fmt/format.h>

#include "base/timer.hpp"
#include "io/case/case_file.hpp"

namespace perilink::verification {

namespace {

std::string line(const char* key, double value) {
  return value > 0.0 ? fmt::format("{} = {}\n", key, value) : "";
}

}  // namespace

std::string block_case(const BlockLattice& lattice) {
  const Vector3 &low = block_weak_patch.lower, &high = block_weak_patch.upper;
  return fmt::format(
      R"(title = "{title}"
units = "kip, in"
[body]
problem = "plane_stress"
thickness = 1.0
surface = "{surface}"
critical_stretch = "lattice"
model = "{model}"
{layout}
[[regions]]
name = "specimen"
x = [0, 100]
y = [0, 200]
[[regions]]
name = "lower cap"
x = [0, 100]
y = [{bottom}, 0]
[[regions]]
name = "upper cap"
x = [0, 100]
y = [200, {top}]
[[regions]]
name = "weak patch"
x = [{left}, {right}]
y = [{below}, {above}]
[[materials]]
region = "specimen"
youngs_modulus = 3604.0
fracture_energy = {fracture_energy}
{elastic}{law}[[materials]]
regions = ["lower cap", "upper cap"]
youngs_modulus = 3604.0
fracture_energy = "infinite"
{elastic}[[materials]]
region = "weak patch"
youngs_modulus = 3604.0
fracture_energy = {weak_fracture_energy}
{elastic}{weak_law}[[loads]]
region = "lower cap"
force = [0, -100]
[[loads]]
region = "upper cap"
force = [0, 100]
[analysis]
rigid_body_modes = "pin"
)",
      fmt::arg("title", lattice.title), fmt::arg("surface", lattice.surface),
      fmt::arg("layout", lattice.layout),
      fmt::arg("model", lattice.poissons_ratio > 0.0 ? "micropolar" : "bond_based"),
      fmt::arg("bottom", -50 + lattice.inset), fmt::arg("top", 250 - lattice.inset),
      fmt::arg("left", low[0]), fmt::arg("right", high[0]), fmt::arg("below", low[1]),
      fmt::arg("above", high[1]), fmt::arg("fracture_energy", block_fracture_energy),
      fmt::arg("weak_fracture_energy", block_weak_fracture_energy),
      fmt::arg("elastic", line("poissons_ratio", lattice.poissons_ratio)),
      fmt::arg("law", line("tensile_strength", lattice.tensile_strength)),
      fmt::arg("weak_law", line("tensile_strength", 0.95 * lattice.tensile_strength)));
}

std::string block_case(int columns, const std::string& surface) {
  return block_case(
      {fmt::format("Refined tension block, {} columns", columns),
       fmt::format("pattern = \"hexagonal\"\ncolumns = {}\nhorizon_ratio = 3.0", columns),
       surface});
}

Model make_block(int columns, const std::string& surface) {
  return build_model(parse_case(block_case(columns, surface), "block"));
}

BlockRun run_block(const Model& model, FactorRoute route, Index broken_bonds, int threads,
                   int check_interval, std::size_t rows) {
  DamageOptions options;
  options.check_interval = check_interval;
  options.engine.route = route;
  options.engine.threads = threads;
  options.stop.broken_bonds = broken_bonds;
  RowRecorder recorder(rows);
  BlockRun run;
  const Timer timer;
  run.result = run_damage_analysis(model, options, recorder);
  run.seconds = timer.seconds();
  run.seconds_per_event = recorder.seconds_per_row();
  run.rows = std::move(recorder.rows);
  return run;
}

}  // namespace perilink::verification
