#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace perilink::verification {
namespace {

constexpr int steps_per_degree = 10;

/// Hoop stress at an angle about the tip, without its radius.
double hoop_stress(double angle, double mixity) {
  const double c = std::cos(0.5 * angle);
  return c * (std::cos(mixity) * c * c - 1.5 * std::sin(mixity) * std::sin(angle));
}

}  // namespace

Rows::Rows(bool hexagonal, double horizon_ratio) {
  const double reach = 1.005 * horizon_ratio, row = hexagonal ? std::sqrt(0.75) : 1.0;
  const int last = static_cast<int>(reach / row) + 1;
  for (int j = -last; j <= last; ++j) {
    for (int i = -last - 1; i <= last + 1; ++i) {
      const double x = i + (hexagonal && j % 2 != 0 ? 0.5 : 0.0), y = row * j;
      const double length = std::hypot(x, y);
      if (length == 0.0 || length > reach) continue;
      bonds_.push_back({x, y, length});  // k length^2 of (B-1)
      mean_ += 2.0 / std::numbers::pi * length * length;
    }
  }
  for (int k = 0; k < 180 * steps_per_degree; ++k) {
    energies_.push_back(energy(degree * k / steps_per_degree));
  }
}

int Rows::count() const {
  std::set<long> directions;  // in millionths of a radian
  for (const Bond& bond : bonds_) {
    const double angle = std::atan2(bond.y, bond.x);
    if (angle > -1e-9 && angle < std::numbers::pi - 1e-9)
      directions.insert(std::lround(1e6 * angle));
  }
  return static_cast<int>(directions.size());
}

double Rows::energy(double angle) const {
  const double s = std::sin(angle), c = std::cos(angle);
  double sum = 0.0;
  for (const Bond& bond : bonds_) sum += bond.weight * std::abs(c * bond.y - s * bond.x);
  return sum / mean_;
}

double Rows::direction(double mixity, double turned) const {
  const int turn = static_cast<int>(std::lround(turned / degree * steps_per_degree));
  const int half = 180 * steps_per_degree;
  double most = 0.0, best = 0.0;
  for (int k = -90 * steps_per_degree; k <= 90 * steps_per_degree; ++k) {
    const double angle = degree * k / steps_per_degree;
    const double stress = std::max(hoop_stress(angle, mixity), 0.0);
    const double value = stress * stress / energies_[((k - turn) % half + half) % half];
    if (value > most) {
      most = value;
      best = angle;
    }
  }
  return best;
}

}  // namespace perilink::verification
