#include "problems/block.hpp"

#include <fmt/format.h>

#include "base/timer.hpp"
#include "io/case_file.hpp"

namespace perilink::verification {

std::string block_case(int columns, const std::string& surface) {
  return fmt::format(R"(title = "Refined tension block, {0} columns"
units = "kip, in"
[body]
problem = "plane_stress"
thickness = 1.0
pattern = "hexagonal"
surface = "{1}"
columns = {0}
horizon_ratio = 3.0
[[regions]]
name = "specimen"
x = [0, 100]
y = [0, 200]
[[regions]]
name = "lower cap"
x = [0, 100]
y = [-50, 0]
[[regions]]
name = "upper cap"
x = [0, 100]
y = [200, 250]
[[regions]]
name = "weak patch"
x = [35, 65]
y = [85, 115]
[[materials]]
region = "specimen"
youngs_modulus = 3604.0
fracture_energy = 0.001
[[materials]]
regions = ["lower cap", "upper cap"]
youngs_modulus = 3604.0
fracture_energy = "infinite"
[[materials]]
region = "weak patch"
youngs_modulus = 3604.0
fracture_energy = 0.00095
[[loads]]
region = "lower cap"
force = [0, -100]
[[loads]]
region = "upper cap"
force = [0, 100]
[analysis]
rigid_body_modes = "pin"
)",
                     columns, surface);
}

Model make_block(int columns, const std::string& surface) {
  return build_model(parse_case(block_case(columns, surface), "block"));
}

BlockRun run_block(const Model& model, FactorRoute route, Index broken_bonds, int threads) {
  DamageOptions options;
  options.engine.route = route;
  options.engine.threads = threads;
  options.stop.broken_bonds = broken_bonds;
  RowRecorder recorder;
  BlockRun run;
  const Timer timer;
  run.result = run_damage_analysis(model.network, model.unknowns, model.loads, model.reference,
                                   options, recorder);
  run.seconds = timer.seconds();
  run.rows = std::move(recorder.rows);
  return run;
}

}  // namespace perilink::verification
