#include "tests.hpp"

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

}  // namespace

LatticeTest tension_test(const std::string& variant, double degrees) {
  LatticeTest test;
  test.case_name = "splm_tension";
  test.variant = variant;
  test.degrees = degrees;
  test.time_step = step_of(variant, printed_block_step);
  return test;
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

}  // namespace perilink::verification
