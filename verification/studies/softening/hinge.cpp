#include "hinge.hpp"

#include <algorithm>
#include <cmath>

namespace perilink::verification {
namespace {

constexpr int fibres = 400;
constexpr int bisections = 60;

/// Stresses over f_t, lengths over E G_F / f_t^2 and elongations over G_F / f_t.
struct Hinge {
  double knee_stress, knee_opening, depth;
  const std::vector<SkinPoint>& skin;

  double length() const { return 0.5 * depth; }

  double cohesion(double opening) const {
    const double last = 2.0 / (knee_stress + knee_opening), knee = knee_opening * last;
    if (opening < knee) return 1.0 - (1.0 - knee_stress) * opening / knee;
    return std::max(0.0, knee_stress * (last - opening) / (last - knee));
  }

  double stress_of_skin(double strain) const {
    const auto next = std::find_if(skin.begin() + 1, skin.end() - 1,
                                   [&](const SkinPoint& point) { return point.strain >= strain; });
    const SkinPoint &a = *(next - 1), &b = *next;
    return a.stress + (b.stress - a.stress) * (strain - a.strain) / (b.strain - a.strain);
  }

  /// Stress of a fibre with this elongation.
  double stress(double elongation) const {
    if (elongation <= 0.0) return elongation / length();
    const double last_strain = skin.back().strain * length();
    if (elongation <= last_strain) return stress_of_skin(elongation / length());
    double low = 0.0, high = elongation;
    for (int k = 0; k < bisections; ++k) {
      const double opening = 0.5 * (low + high);
      (opening + last_strain * cohesion(opening) > elongation ? high : low) = opening;
    }
    return cohesion(low);
  }

  struct Resultant {
    double force = 0.0, moment = 0.0;
  };
  /// \param rotation  between the ends of the hinge
  /// \param neutral   height of the fibre that keeps its length, over the depth
  Resultant resultant(double rotation, double neutral) const {
    Resultant sum;
    for (int k = 0; k < fibres; ++k) {
      const double at = (k + 0.5) / fibres;
      const double embedded = stress(rotation * (neutral - at) * depth) / fibres;
      sum.force += embedded;
      sum.moment += embedded * (0.5 - at);
    }
    return sum;
  }

  /// Largest stress of the elastic beam with the moment of the hinge.
  double nominal(double rotation) const {
    double low = 0.0, high = 1.0;
    for (int k = 0; k < bisections; ++k) {
      const double neutral = 0.5 * (low + high);
      (resultant(rotation, neutral).force > 0.0 ? high : low) = neutral;
    }
    return 6.0 * resultant(rotation, low).moment;
  }
};

}  // namespace

double hinge_strength(double knee_stress_ratio, double knee_opening_ratio, double depth,
                      const std::vector<SkinPoint>& skin) {
  const Hinge hinge{knee_stress_ratio, knee_opening_ratio, depth, skin};
  double best = 0.0;
  for (double rotation = 0.9; rotation < 10.0; rotation *= 1.03) {
    best = std::max(best, hinge.nominal(rotation));
  }
  return best;
}

}  // namespace perilink::verification
