#include "tests.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "model/from_case/lattice_case.hpp"

namespace perilink::verification {
namespace {

constexpr double disc_radius = 0.075, disc_spacing = 0.005;

double step_of(const std::string& variant, double printed) {
  return variant == "consistent" ? 0.0 : printed;
}

void cut_disc(CaseFile& input, double spacing) {
  const double end = disc_radius + 0.25 * spacing;
  for (Region& region : input.regions) {
    if (region.round) {
      region.round->radius = end;
      region.box = {{-end, -end, 0.0}, {end, end, 0.0}};
    } else if (region.box.lower[1] > 0.0) {
      region.box.upper[1] = end;
      region.box.lower[1] = end - spacing;
    } else {
      region.box.lower[1] = -end;
      region.box.upper[1] = -end + spacing;
    }
  }
}

double half_platen(const ExplicitModel& model, bool upper) {
  const LatticeRows& lattice = model.lattice;
  std::vector<double> columns;
  for (const auto& row : model.prescribed) {
    for (const PrescribedMotion& motion : row) {
      if ((lattice.positions[lattice.at(1, motion.slot)] > 0.0) != upper) continue;
      columns.push_back(lattice.positions[motion.slot]);
    }
  }
  std::sort(columns.begin(), columns.end());
  const auto is_same = [&](double a, double b) { return b - a < 1e-6 * lattice.spacing; };
  columns.erase(std::unique(columns.begin(), columns.end(), is_same), columns.end());
  if (columns.size() < 2) throw std::invalid_argument("the platen drives a single column");
  const double gaps = static_cast<double>(columns.size()) - 1.0;
  return 0.5 * (columns.back() - columns.front()) * (gaps + 1.0) / gaps;
}

}  // namespace

LatticeTest tension_test(const std::string& variant, double degrees) {
  LatticeTest test;
  test.case_name = "splm_tension";
  test.variant = variant;
  test.degrees = degrees;
  test.time_step = step_of(variant, printed_block_step);
  return test;
}

LatticeTest spaced_tension_test(double degrees, double spacing) {
  LatticeTest test = tension_test("consistent", degrees);
  test.spacing = spacing;
  return test;
}

double mean_section(const LatticeTest& block) {
  const ExplicitModel model = build_explicit_case(case_of(block)).model;
  const LatticeRows& lattice = model.lattice;
  double volume = 0.0, lowest = 1e300, highest = -1e300;
  for (const Index slot : lattice.particle_slot) {
    const double y = lattice.positions[lattice.at(1, slot)];
    volume += model.volume[slot];
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
  return volume / (highest - lowest);
}

LatticeTest compression_test(const std::string& variant, double degrees) {
  LatticeTest test = tension_test(variant, degrees);
  test.case_name = "splm_compression";
  return test;
}

LatticeTest disc_test(const std::string& variant, double degrees, double spacing) {
  LatticeTest test;
  test.case_name = "brazilian_disc";
  test.variant = variant;
  test.degrees = degrees;
  test.spacing = spacing;
  test.time_step = step_of(variant, printed_disc_step * spacing / disc_spacing);
  test.change = [spacing](CaseFile& input) { cut_disc(input, spacing); };
  return test;
}

LatticeTest placed_disc_test(const std::string& variant, double degrees, double spacing, double a,
                             double b) {
  LatticeTest test = disc_test(variant, degrees, spacing);
  const double along = spacing * (a + 0.5 * b), across = 0.5 * std::numbers::sqrt3 * spacing * b;
  const double angle = degrees * std::numbers::pi / 180.0;
  test.offset = {along * std::cos(angle) - across * std::sin(angle),
                 along * std::sin(angle) + across * std::cos(angle), 0.0};
  return test;
}

double half_platen(const LatticeTest& disc, bool upper) {
  return half_platen(build_explicit_case(case_of(disc)).model, upper);
}

CohesiveDisc continuum_of(const LatticeTest& disc) {
  const ExplicitModel model = build_explicit_case(case_of(disc)).model;
  const double area = model.lattice.particles() * model.lattice.cell_volume / model.thickness;
  return {std::sqrt(area / std::numbers::pi), model.thickness,
          half_platen(model, true),           model.material.youngs_modulus,
          model.material.poissons_ratio,      model.material.softening};
}

}  // namespace perilink::verification
