#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "comparison.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

/// For the relaxation that is compared with the implicit solution.
constexpr double tolerance = 1e-6;

constexpr const char* scaled_fibres = "fibres, axial calibration";

/// The bonds of the fibres times what makes the beam's axial stiffness right.
Specimen scaled(Specimen specimen, double factor) {
  for (double& k : specimen.model.network.stiffness) k *= factor;
  specimen.joined = scaled_fibres;
  return specimen;
}

class Study {
 public:
  void run() {
    add("structure,joined,bonds,deflection,over_reference,shape_error,implicit_seconds,iterations,"
        "explicit_seconds,explicit_over_implicit,green_over_implicit\n");
    const Sizes beam = sizes_of(Structure::cantilever);
    const double axial =
        youngs_modulus / axial_modulus(make_specimen(Structure::cantilever, beam, "fibres"));
    fmt::print("axial calibration of the fibres: {:.4f}\n", axial);
    for (const Structure structure :
         {Structure::cantilever, Structure::clamped, Structure::plate}) {
      const Sizes sizes = sizes_of(structure);
      const double reference =
          structure == Structure::plate
              ? plate_reference()
              : timoshenko(structure, sizes,
                           structure == Structure::clamped ? 0.5 * sizes.x() : sizes.x());
      for (const char* joined : {"fibres", "none", "energy", "calibrated", "linear elements"}) {
        const Specimen specimen = make_specimen(structure, sizes, joined);
        compare(specimen, reference);
        if (specimen.in_cells) compare(scaled(specimen, axial), reference);
      }
    }
    write_result(PERILINK_STUDY_DIR, table_);
  }

 private:
  void add(const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    table_ += line;
  }

  void compare(const Specimen& specimen, double reference) {
    if (specimen.structure != Structure::plate && specimen.in_cells) {
      // The last section of cells is half a cell before the end; the middle is between two.
      const double x = specimen.structure == Structure::clamped
                           ? 0.5 * (specimen.sizes.x() - specimen.sizes.cell)
                           : specimen.sizes.x() - 0.5 * specimen.sizes.cell;
      reference = timoshenko(specimen.structure, specimen.sizes, x);
    }
    const Solution implicit = solve(specimen);
    std::string line =
        fmt::format("{},\"{}\",{},{:.6e},{:.4f},", to_string(specimen.structure), specimen.joined,
                    specimen.model.elements ? 0 : specimen.model.network.num_elements(),
                    implicit.deflection, implicit.deflection / reference);
    if (specimen.structure != Structure::plate) {
      line += fmt::format("{:.4f}", normalized_shape_error(specimen, implicit));
    }
    line += fmt::format(",{:.2f},", implicit.seconds);
    if (specimen.model.elements || specimen.joined == scaled_fibres) {
      add(line + ",,,\n");  // scaled fibres move like the others
      return;
    }
    const Solution small = relaxed(specimen, Strain::small);
    line += fmt::format("{},{:.2f},{:.1e},", small.iterations, small.seconds,
                        largest_difference(small, implicit));
    if (specimen.in_cells || specimen.joined == "calibrated") {
      const Solution green = relaxed(specimen, Strain::green);
      line += fmt::format("{:.6f}", green.deflection / implicit.deflection);
    }
    add(line + "\n");
  }

  static Solution relaxed(const Specimen& specimen, Strain strain) {
    Solution solution = relax(specimen, strain, tolerance, 1);
    if (solution.termination == Termination::completed) return solution;
    throw std::runtime_error(specimen.joined + " do not come to rest");
  }

  std::string table_;
};

}  // namespace
}  // namespace perilink::verification

/// How far are explicit runs of bonds in space off the deflections of beams and a plate, and off
/// the implicit mode? Writes result.csv.
bool perilink::verification::run_program(const std::vector<std::string>& /*arguments*/) {
  Study().run();
  return true;
}
