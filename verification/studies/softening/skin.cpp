#include "skin.hpp"

#include <numbers>

#include "material/softening.hpp"
#include "material/strength/bond_cell.hpp"

namespace perilink::verification {
namespace {

constexpr double overshoot = 0.02;  // that teeth have, which adds less than 0.3 % to the strength
constexpr int rounds = 8;           // each finds a digit of the strength factor

/// Points that rise, stresses over E s_0 and strains over s_0.
std::vector<SkinPoint> rising_path(const SkinBonds& bonds, double energy) {
  const double nu = bonds.poissons_ratio;
  const std::vector<CellBond> cell = isotropic_cell(Problem::plane_stress, 2.0 * nu / (1.0 - nu));
  const SofteningShape shape{Softening::bilinear, bonds.knee_stress_ratio,
                             bonds.knee_opening_ratio};
  const BondLaw law = saw_tooth_of(SofteningCurve(shape, energy), overshoot);
  const double modulus = cell_modulus(cell, 2, {1.0, 0.0, 0.0});
  std::vector<SkinPoint> rising = {{0.0, 0.0}};
  for (const CellPoint& point : cell_path(cell, 2, {{1.0, 0.0, 0.0}}, law, 1.0)) {
    const SkinPoint next{point.strain, point.stress / modulus};
    if (next.stress > rising.back().stress && next.strain > rising.back().strain) {
      rising.push_back(next);
    }
  }
  return rising;
}

}  // namespace

Skin skin_of(const SkinBonds& bonds) {
  // (S-5) of docs/theory/softening.md.
  const double unit = 2.0 * std::numbers::pi * (1.0 - bonds.poissons_ratio) / 3.0 / bonds.horizon;
  Skin skin{1.0, {}};
  for (int round = 0; round < rounds; ++round) {
    skin.curve = rising_path(bonds, unit * skin.strength_factor * skin.strength_factor);
    skin.strength_factor = skin.curve.back().stress;
  }
  for (SkinPoint& point : skin.curve) {
    point.strain /= skin.strength_factor;
    point.stress /= skin.strength_factor;
  }
  return skin;
}

double softened_before(const Skin& skin) {
  double area = 0.0;
  for (std::size_t k = 1; k < skin.curve.size(); ++k) {
    const SkinPoint &a = skin.curve[k - 1], &b = skin.curve[k];
    area += 0.5 * (a.stress + b.stress) * (b.strain - a.strain);
  }
  return area - 0.5 * skin.curve.back().stress * skin.curve.back().strain;
}

}  // namespace perilink::verification
