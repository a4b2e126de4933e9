#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "homogeneous.hpp"
#include "pictures.hpp"
#include "plates.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

/// Bonds along the load break at the strain of the peak; points are taken this part before it.
constexpr double short_of_the_fall = 0.998;

const char* rule_of(bool shear_softens) { return shear_softens ? "B" : "A"; }

/// Writes homogeneous.csv.
void run_homogeneous() {
  const std::string layout = "mesh = \"cloud.geo\"\nmesh_size = 12.7\nhorizon_ratio = 4\n";
  const std::vector<ReferenceCurve> curves = read_reference();
  std::string table = "rule,across,strain,strain_across,stress,stress_across,reference\n";
  for (const ReferenceCurve& curve : curves) {
    Homogeneous specimen{.layout = layout,
                         .shear_softens = curve.shear_softens,
                         .held_across = curve.held_across,
                         .compression = curve.points.front().strain < 0.0,
                         .strains = {}};
    for (const HomogeneousPoint& point : curve.points) {
      specimen.strains.push_back(std::abs(point.strain) * short_of_the_fall);
    }
    const std::vector<HomogeneousPoint> found = strain_uniformly(specimen);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const std::string row =
          fmt::format("{},{},{:.4g},{:.5g},{:.5g},{:.4g},{:.6g}\n", rule_of(curve.shear_softens),
                      curve.held_across ? "held" : "free", found[k].strain, found[k].strain_across,
                      found[k].stress, found[k].stress_across, curve.points[k].stress);
      fmt::print("{}", row);
      table += row;
    }
    std::fflush(stdout);
    write_result(PERILINK_STUDY_DIR, table, "homogeneous.csv");
  }
}

/// Writes plates.csv.
void run_plates() {
  const struct {
    double x, y;
  } ratios[] = {{1, 0},  {1, 0.5},   {1, 1},     {0.5, -1},  {0.1, -1}, {0.05, -1},
                {0, -1}, {-0.1, -1}, {-0.2, -1}, {-0.5, -1}, {-1, -1}};
  std::string table =
      "body,x,y,strength,strain,cell_tension,cell_compression,energy_error,events,broken,ending\n";
  for (const char* body : {"lattice", "mesh", "slab"}) {
    for (const auto& ratio : ratios) {
      if (std::string(body) == "slab" && ratio.x > 0.0 && ratio.y != 0.0) continue;
      const PlateResult result = load_plate({body, ratio.x, ratio.y});
      const std::string row = fmt::format(
          "{},{},{},{:.4f},{:.4e},{:.4f},{:.4f},{:.1e},{},{},{}\n", body, ratio.x, ratio.y,
          result.strength, result.strain, result.cell_tension, result.cell_compression,
          result.energy_error, result.events, result.broken, result.termination);
      fmt::print("{}", row);
      std::fflush(stdout);
      table += row;
    }
    write_result(PERILINK_STUDY_DIR, table, "plates.csv");
  }
}

/// The fields of a table without its head, commas replaced.
std::vector<std::istringstream> rows_of(const std::string& name) {
  std::ifstream file(PERILINK_STUDY_DIR "/" + name);
  std::vector<std::istringstream> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    rows.emplace_back(line);
  }
  return rows;
}

/// Draws the tables, and the curves of plates under load along one axis, which it runs again.
void draw_pictures() {
  std::vector<UniformRow> uniform;
  for (std::istringstream& row : rows_of("homogeneous.csv")) {
    std::string rule, across;
    double strain_across = 0.0, stress_across = 0.0;
    UniformRow point;
    row >> rule >> across >> point.strain >> strain_across >> point.stress >> stress_across >>
        point.reference;
    point.shear_softens = rule == "B";
    if (across == "free") uniform.push_back(point);
  }
  draw_uniform(uniform).save(PERILINK_STUDY_DIR "/homogeneous.svg");
  std::vector<PlateRow> plates;
  for (std::istringstream& row : rows_of("plates.csv")) {
    PlateRow plate;
    row >> plate.body >> plate.x >> plate.y >> plate.strength;
    plates.push_back(plate);
  }
  draw_envelope(plates).save(PERILINK_STUDY_DIR "/envelope.svg");
  std::vector<PlateCurve> curves;
  for (const char* body : {"lattice", "mesh"}) {
    curves.push_back(
        {body, load_plate({body, 1.0, 0.0}).curve, load_plate({body, 0.0, -1.0}).curve});
  }
  draw_curves(curves).save(PERILINK_STUDY_DIR "/curves.svg");
}

}  // namespace
}  // namespace perilink::verification

/// The law of concrete with two limits in bodies: `concrete homogeneous` and `concrete plates`
/// write the tables of the study, `concrete pictures` draws them, `concrete case BODY X Y` prints
/// the case of a plate.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string part = arguments.empty() ? "" : arguments[0];
  if (part == "homogeneous") {
    run_homogeneous();
  } else if (part == "plates") {
    run_plates();
  } else if (part == "pictures") {
    draw_pictures();
  } else if (part == "case" && arguments.size() == 4) {
    fmt::print("{}", plate_case({arguments[1], std::stod(arguments[2]), std::stod(arguments[3])}));
  } else {
    throw std::invalid_argument(
        "name homogeneous, plates, pictures, or case with a body and two tractions");
  }
  return true;
}
