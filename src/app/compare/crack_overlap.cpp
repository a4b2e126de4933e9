#include "app/compare/crack_overlap.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "base/types.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// Returns the cracked particles of a body.
CrackPattern cracked_part(const CrackPattern& body) {
  CrackPattern part;
  part.dim = body.dim;
  const std::size_t dim = static_cast<std::size_t>(body.dim);
  for (std::size_t i = 0; i < body.damage.size(); ++i) {
    if (body.damage[i] < cracked_damage) continue;
    const auto at = body.positions.begin() + static_cast<std::ptrdiff_t>(i * dim);
    part.positions.insert(part.positions.end(), at, at + body.dim);
    part.volumes.push_back(body.volumes[i]);
    part.damage.push_back(body.damage[i]);
  }
  return part;
}

double total(std::span<const double> volumes) {
  double sum = 0.0;
  for (const double volume : volumes) sum += volume;
  return sum;
}

double square_distance(const CrackPattern& p, Index i, const CrackPattern& q, Index j) {
  double sum = 0.0;
  for (int a = 0; a < p.dim; ++a) {
    const double step = p.positions[static_cast<std::size_t>(i * p.dim + a)] -
                        q.positions[static_cast<std::size_t>(j * q.dim + a)];
    sum += step * step;
  }
  return sum;
}

/// Sums the volume of particles for which `counts` returns true [length^3].
/// \param counts  takes a particle and the particles of `others` within the radius
template <class Counts>
double volume_where(const CrackPattern& part, const CrackPattern& others, double radius,
                    Counts counts) {
  if (part.volumes.empty() || others.volumes.empty()) return 0.0;
  const Csr near = find_neighbors(others.positions, part.positions, part.dim, radius);
  double sum = 0.0;
  for (Index q = 0; q < near.rows(); ++q) {
    if (counts(q, near.row(q))) sum += part.volumes[static_cast<std::size_t>(q)];
  }
  return sum;
}

/// Volume of the particles with a particle of `others` within the radius [length^3].
double volume_near(const CrackPattern& part, const CrackPattern& others, double radius) {
  return volume_where(part, others, radius, [](Index, auto near) { return !near.empty(); });
}

/// Volume of the particles whose nearest particle of `body` is cracked [length^3].
double volume_inside(const CrackPattern& part, const CrackPattern& body, double radius) {
  return volume_where(part, body, radius, [&](Index q, auto near) {
    const auto distance = [&](Index j) { return square_distance(part, q, body, j); };
    const auto nearest = std::ranges::min_element(near, {}, distance);
    return nearest != near.end() &&
           body.damage[static_cast<std::size_t>(*nearest)] >= cracked_damage;
  });
}

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

CrackOverlap crack_overlap(const CrackPattern& a, const CrackPattern& b, double tolerance) {
  const CrackPattern part_a = cracked_part(a), part_b = cracked_part(b);
  CrackOverlap result;
  result.volume_a = total(part_a.volumes);
  result.volume_b = total(part_b.volumes);
  result.near_a = share(volume_near(part_a, part_b, tolerance), result.volume_a);
  result.near_b = share(volume_near(part_b, part_a, tolerance), result.volume_b);
  const double both =
      0.5 * (volume_inside(part_a, b, tolerance) + volume_inside(part_b, a, tolerance));
  result.overlap = share(both, result.volume_a + result.volume_b - both);
  return result;
}

}  // namespace perilink
