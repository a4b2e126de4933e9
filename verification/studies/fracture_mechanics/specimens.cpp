#include "specimens.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "problems/handbook.hpp"

namespace perilink::verification {
namespace {

using Range = std::array<double, 2>;

std::string region(const std::string& name, Range x, Range y) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, x[0], x[1],
                     y[0], y[1]);
}

std::string body(const Make& make, double width, double height) {
  return fmt::format("[body]\nmodel = \"{}\"\n{}", make.micropolar ? "micropolar" : "bond_based",
                     body_keys(make.arrangement, make.spacing, make.horizon_ratio, width, height)) +
         region("whole", {0.0, width}, {0.0, height});
}

/// Only the region "zone" breaks, which the caller defines.
std::string materials(const Make& make) {
  std::string elastic = fmt::format("youngs_modulus = {}\n", youngs_modulus);
  if (make.micropolar) elastic += fmt::format("poissons_ratio = {}\n", make.poissons_ratio());
  std::string law = fmt::format("fracture_energy = {}\n", fracture_energy);
  if (make.softens) {
    const double zone = make.zone * make.horizon();
    law += fmt::format("tensile_strength = {}\nsoftening = \"bilinear\"\nsoftening_error = 0.03\n",
                       std::sqrt(youngs_modulus * fracture_energy / zone));
  }
  return "[[materials]]\nregion = \"whole\"\n" + elastic +
         "fracture_energy = \"infinite\"\n[[materials]]\nregion = \"zone\"\n" + elastic + law;
}

std::string crack(double from, double to, double y) {
  return fmt::format("[[cracks]]\npoints = [[{0}, {2}], [{1}, {2}]]\n", from, to, y);
}

std::string driven(const std::string& name, const std::string& keys) {
  return fmt::format("[[displacements]]\nregion = \"{}\"\n{}", name, keys);
}

/// Between two columns of a lattice along the axes.
double between_columns(const Make& make, double x) {
  return make.spacing * (std::floor(x / make.spacing + 1e-9) + 0.5);
}

/// Between two rows of a lattice along the axes, above the one in the middle.
double between_rows(const Make& make, double height) {
  return 0.5 * (height + row_of(make.arrangement) * make.spacing);
}

/// Such a height that there are an even number of rows: hexagonal lattices need it.
double rounded(const Make& make, double height) {
  const double row = row_of(make.arrangement) * make.spacing;
  return 2.0 * row * std::round(0.5 * height / row);
}

constexpr double width = 100.0;

/// Two supports below, which bear what the ragged ends of turned lattices leave out of balance, do
/// not keep the plate from bending.
std::string tension(const Make& make, double height) {
  const double h = make.spacing, left = 0.21 * width, right = 0.79 * width;
  return body(make, width, height) + region("zone", {0.0, width}, {0.25 * height, 0.75 * height}) +
         region("left", {left - h, left + h}, {0.0, 1.2 * h}) +
         region("right", {right - h, right + h}, {0.0, 1.2 * h}) +
         region("upper", {0.0, width}, {height, height}) + materials(make) +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
         "[[supports]]\nregion = \"right\"\nfix = [\"y\"]\n"
         "[[tractions]]\nregion = \"upper\"\ntraction = [0, 1]\n[stop]\nload_fraction = 0.5\n";
}

/// Load on the width at which K = stress sqrt(pi a) factor is critical.
double tension_load(double crack, double factor) {
  return width * std::sqrt(youngs_modulus * fracture_energy / (std::numbers::pi * crack)) / factor;
}

void set_loads(Specimen& specimen, const Make& make, const std::function<double(double)>& form) {
  specimen.load = form(0.0);
  specimen.later_load = form(ahead * make.horizon());
}

/// Displacement about the tip of a crack in an infinite body, along x and along y, as a formula.
std::array<std::string, 2> field_of(const Make& make, double mixity, std::array<double, 2> tip) {
  const double nu = make.poissons_ratio(), kappa = (3.0 - nu) / (1.0 + nu);
  const double scale = std::sqrt(youngs_modulus * fracture_energy / (2.0 * std::numbers::pi)) *
                       (1.0 + nu) / youngs_modulus;
  const double one = scale * std::cos(mixity), two = scale * std::sin(mixity);
  const double along = std::cos(make.turned), across = std::sin(make.turned);
  const std::string half =
      fmt::format("0.5*atan2((y - {1})*{2} - (x - {0})*{3}, (x - {0})*{2} + (y - {1})*{3})", tip[0],
                  tip[1], along, across);
  const std::string root = fmt::format("((x - {0})^2 + (y - {1})^2)^0.25", tip[0], tip[1]);
  const std::string s = fmt::format("sin({})", half), c = fmt::format("cos({})", half);
  const std::string u = fmt::format("{4}*({0}*{3}*({5} + 2*{2}^2) + {1}*{2}*({6} + 2*{3}^2))", one,
                                    two, s, c, root, kappa - 1.0, kappa + 1.0);
  const std::string v = fmt::format("{4}*({0}*{2}*({6} - 2*{3}^2) - {1}*{3}*({5} - 2*{2}^2))", one,
                                    two, s, c, root, kappa - 1.0, kappa + 1.0);
  if (make.turned == 0.0) return {u, v};
  return {fmt::format("{}*{} - {}*{}", along, u, across, v),
          fmt::format("{}*{} + {}*{}", across, u, along, v)};
}

/// A crack through crack_tip_field() ends three horizons before its side; with three spacings and
/// eight horizons it has broken so many bonds there. Bonds across a horizon of growth are in
/// proportion to the fourth power of the horizon in spacings.
int bonds_to_break(const Make& make) {
  return static_cast<int>(280.0 * std::pow(make.horizon_ratio / 3.0, 4) * (make.radius - 3.0) /
                          5.0);
}

}  // namespace

std::string bonds_of(const Make& make) {
  return fmt::format("{},{}", make.micropolar ? "micropolar" : "bond_based",
                     make.softens ? "bilinear" : "brittle");
}

Specimen edge_crack(const Make& make) {
  const double height = rounded(make, 2.0 * width), y = between_rows(make, height);
  const double a = between_columns(make, 0.4 * width);
  Specimen specimen{tension(make, height) + crack(-9.0, a, y), {a, y}};
  set_loads(specimen, make, [&](double growth) {
    return tension_load(a + growth, edge_crack_factor((a + growth) / width));
  });
  return specimen;
}

Specimen centre_crack(const Make& make) {
  const double height = rounded(make, 2.0 * width), y = between_rows(make, height);
  const double left = between_columns(make, 0.25 * width), right = width - left;
  Specimen specimen{tension(make, height) + crack(left, right, y), {right, y}};
  set_loads(specimen, make, [&](double growth) {
    const double a = 0.5 * (right - left) + growth;
    return tension_load(a, centre_crack_factor(2.0 * a / width));
  });
  return specimen;
}

Specimen bent_beam(const Make& make) {
  const double h = make.spacing, span = 4.0 * width, overhang = 0.2 * width;
  const double length = span + 2.0 * overhang, middle = between_columns(make, 0.5 * length);
  const double height = rounded(make, width), row = row_of(make.arrangement) * h;
  const double a = row * (std::floor(0.4 * height / row + 1e-9) + 0.5);  // between two rows
  const double left = middle - 0.5 * span, right = middle + 0.5 * span;
  Specimen specimen;
  specimen.tip = {middle, a};
  set_loads(specimen, make, [&](double growth) {
    return three_point_peak_load(youngs_modulus, fracture_energy, height, 1.0, a + growth);
  });
  specimen.text =
      body(make, length, height) +
      region("zone", {middle - 0.5 * width, middle + 0.5 * width}, {0.0, height - 2.0 * h}) +
      region("left", {left - h, left + h}, {0.0, 0.0}) +
      region("right", {right - h, right + h}, {0.0, 0.0}) +
      region("load", {middle - 2.0 * h, middle + 2.0 * h}, {height, height}) + materials(make) +
      fmt::format("[[cracks]]\npoints = [[{0}, -9], [{0}, {1}]]\n", middle, a) +
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
      "[[supports]]\nregion = \"right\"\nfix = [\"y\"]\n" +
      "[[loads]]\nregion = \"load\"\nforce = [0, -1]\n[stop]\nload_fraction = 0.5\n";
  return specimen;
}

Specimen double_cantilever(const Make& make) {
  const double arm = 0.5 * rounded(make, 2.0 * width), height = 2.0 * arm;
  const double y = between_rows(make, height), a = between_columns(make, 2.5 * width);
  const double length = make.spacing * std::round(5.0 * width / make.spacing);
  Specimen specimen;
  specimen.tip = {a, y};
  set_loads(specimen, make, [&](double growth) {
    return double_cantilever_load(youngs_modulus, fracture_energy, arm, 1.0, a + growth);
  });
  const double band = 1.01 * make.horizon();
  specimen.text =
      body(make, length, height) + region("zone", {0.0, 4.2 * width}, {y - band, y + band}) +
      region("lower arm", {0.0, 0.0}, {0.0, y}) + region("upper arm", {0.0, 0.0}, {y, height}) +
      region("end", {length, length}, {0.0, height}) + materials(make) + crack(-9.0, a, y) +
      driven("lower arm", "y = -1.0\n") + driven("upper arm", "y = 1.0\n") +
      "[[supports]]\nregion = \"end\"\nfix = [\"x\", \"y\"]\n"
      "[stop]\nload_fraction = 0.85\n";
  return specimen;
}

Specimen crack_tip_field(const Make& make, double mixity) {
  const double h = make.spacing, radius = make.radius * make.horizon();
  const bool seeded = make.arrangement.kind == Arrangement::Kind::unstructured;
  const double wider = seeded ? 0.0 : 0.4 * make.arrangement.sample;
  const double side = h * (2.0 * std::round(radius / h) + 1.0 + wider);
  const double height = rounded(make, side);
  const double rim = 1.1 * make.horizon();
  const std::array<double, 2> tip = {between_columns(make, 0.5 * side), between_rows(make, height)};
  const auto [u, v] = field_of(make, mixity, tip);
  const std::string field = fmt::format("x = \"{}\"\ny = \"{}\"\n", u, v);
  const double edge = 1.01 * rim;
  const double behind = make.turned == 0.0 ? tip[0] - rim : 2.0 * rim;
  const double outside_x = tip[0] - 2.0 * side * std::cos(make.turned);
  const double outside_y = tip[1] - 2.0 * side * std::sin(make.turned);
  const std::string slit = make.turned == 0.0
                               ? crack(-9.0, tip[0], tip[1])
                               : fmt::format("[[cracks]]\npoints = [[{}, {}], [{}, {}]]\n",
                                             outside_x, outside_y, tip[0], tip[1]);
  return {body(make, side, height) +
              region("zone", {behind, side - 2.0 * rim}, {2.0 * rim, height - 2.0 * rim}) +
              region("lower", {0.0, side}, {0.0, rim}) +
              region("upper", {0.0, side}, {height - rim, height}) +
              region("left", {0.0, rim}, {edge, height - edge}) +
              region("right", {side - rim, side}, {edge, height - edge}) + materials(make) + slit +
              driven("lower", field) + driven("upper", field) + driven("left", field) +
              driven("right", field) +
              fmt::format("[stop]\nbroken_bonds = {}\n", bonds_to_break(make)),
          tip};
}

std::array<double, 3> tips_of_strip(const Make& make) {
  const double h = make.spacing, beside = h * std::ceil(6.0 * make.horizon() / h);
  const double skipped = h * std::ceil(5.0 * make.horizon() / h);
  return {beside, beside + skipped, beside + skipped + 18.0 * h};
}

std::string clamped_strip(const Make& make, double tip) {
  const double clamp = 1.1 * make.horizon();
  const double height = rounded(make, 8.0 * make.horizon() + 2.0 * clamp);
  const double length =
      make.spacing * std::round((tips_of_strip(make)[2] + 6.0 * make.horizon()) / make.spacing);
  const std::string held = make.micropolar ? "x = 0.0\nrotation = 0.0\n" : "x = 0.0\n";
  return body(make, length, height) +
         region("zone", {0.0, length}, {1.5 * clamp, height - 1.5 * clamp}) +
         region("lower", {0.0, length}, {0.0, clamp}) +
         region("upper", {0.0, length}, {height - clamp, height}) + materials(make) +
         crack(-9.0, tip, between_rows(make, height)) + driven("lower", held + "y = -1.0\n") +
         driven("upper", held + "y = 1.0\n");
}

}  // namespace perilink::verification
