#include <fmt/format.h>
#include <cstdlib>
#include <string>
#include "homogeneous.hpp"
#include "plates.hpp"
using namespace perilink::verification;
int main(int /*argc*/, char** argv) {
  const std::string what = argv[1];
  if (what == "text") { fmt::print("{}", plate_case({argv[2], atof(argv[3]), atof(argv[4])})); return 0; }
  if (what == "plate") {
    const auto r = load_plate({argv[2], atof(argv[3]), atof(argv[4])});
    fmt::print("{} {} {}: {:.4f} at {:.4e} cells {:.4f} {:.4f} err {:.1e} events {} broken {} {}\n", argv[2], argv[3], argv[4], r.strength, r.strain, r.cell_tension, r.cell_compression, r.energy_error, r.events, r.broken, r.ending);
    return 0;
  }
  const std::string layout = argv[1];
  for (const bool held : {true, false})
    for (const bool B : {false, true})
      for (const bool compression : {false, true}) {
        if (held && compression) continue;
        std::vector<double> strains = compression ? std::vector<double>{6e-4,9e-4,15e-4,29.9e-4,30e-4,36e-4} : std::vector<double>{1e-4,1.8e-4,2.3e-4,2.795e-4,2.8e-4,3.6e-4};
        for (const auto& p : strain_uniformly({layout, B, held, compression, strains})) fmt::print("{} {} {:.3e} {:.4e} {:.4f} {:.4f}\n", held, B, p.strain, p.strain_across, p.stress, p.stress_across);
      }
}
