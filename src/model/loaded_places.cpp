#include "model/loaded_places.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

double length_of(const Vector3& vector) { return std::hypot(vector[0], vector[1], vector[2]); }

void add(const Vector3& more, Vector3& sum) {
  for (int a = 0; a < 3; ++a) sum[a] += more[a];
}

double relative(std::span<const PrescribedRegion> places, const std::array<bool, 6>& held,
                int first, int last) {
  double largest = 0.0, alone = 0.0;
  for (const PrescribedRegion& a : places) {
    double to_frame = 0.0, whole = 0.0;  // sums of squares
    for (int c = first; c < last; ++c) {
      if (!a.drives[c]) continue;
      const double square = std::pow(std::max(std::abs(a.low[c]), std::abs(a.high[c])), 2);
      const auto drivers = std::count_if(places.begin(), places.end(),
                                         [&](const PrescribedRegion& b) { return b.drives[c]; });
      whole += square;
      if (held[c] || drivers == 1) to_frame += square;
    }
    for (const PrescribedRegion& b : places) {
      double square = 0.0;
      for (int c = first; c < last; ++c) {
        if (!a.drives[c] || !b.drives[c]) continue;
        square += std::pow(std::max(a.high[c] - b.low[c], b.high[c] - a.low[c]), 2);
      }
      largest = std::max(largest, square);
    }
    largest = std::max(largest, to_frame);
    alone = std::max(alone, whole);
  }
  return std::sqrt(largest > 0.0 ? largest : alone);
}

}  // namespace

double total_load(std::span<const LoadRegion> places) {
  Vector3 force{}, moment{};
  double forces = 0.0, moments = 0.0;
  for (const LoadRegion& place : places) {
    const double own = length_of(place.force);
    forces += std::max(own, place.sizes - own);
    add(place.force, force);
    moments += length_of(place.moment);
    add(place.moment, moment);
  }
  return forces > 0.0 ? 0.5 * (forces + length_of(force)) : 0.5 * (moments + length_of(moment));
}

double relative_motion(std::span<const PrescribedRegion> places, const std::array<bool, 6>& held,
                       int dim) {
  const double displacement = relative(places, held, 0, dim);
  return displacement > 0.0 ? displacement : relative(places, held, dim, 6);
}

}  // namespace perilink
