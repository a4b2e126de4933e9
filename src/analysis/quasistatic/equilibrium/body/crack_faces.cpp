#include "analysis/quasistatic/equilibrium/body/crack_faces.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "discretization/bonds.hpp"
#include "discretization/mesh_faces.hpp"
#include "material/principal_values.hpp"

namespace perilink {
namespace {

/// Cosine of the angle to the normal up to which bonds are struts: 10 degrees. Within a smaller
/// angle unstructured particles have too few bonds; beyond it struts resist slip.
const double near_normal = std::cos(10.0 * std::acos(-1.0) / 180.0);

/// Unit of distances over the longest bond. The places of many broken bonds then decide on the
/// normal, the directions of the first few ones otherwise.
constexpr double unit_of_distances = 0.3;

/// Largest scatter of the middles of bonds over that of a plane crack [-]. Cracks along interfaces
/// and rows of a lattice have up to 0.8; those that grow through a body mostly have more, and lose
/// up to half of their stiffness under pressure if they slide freely.
constexpr double most_scatter = 0.85;

/// tensor += factor x x'
void add_product(SymmetricTensor& tensor, double factor, const Vector3& x) {
  for (int a = 0; a < 3; ++a) {
    tensor[a] += factor * x[a] * x[a];
    tensor[3 + a] += factor * x[a] * x[(a + 1) % 3];
  }
}

/// Returns n' tensor n.
double along(const SymmetricTensor& tensor, const Vector3& n) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    sum += tensor[a] * n[a] * n[a] + 2.0 * tensor[3 + a] * n[a] * n[(a + 1) % 3];
  }
  return sum;
}

}  // namespace

CrackFaces::CrackFaces(const Network& network) : network_(network) {
  closed_.assign(static_cast<std::size_t>(network.num_elements()), 1.0);
  if (!network.has_closing() || network.has_sections()) return;
  neighbourhoods_ = bonds_of_particles(network.bonds, network.particles.size());
  broken_.assign(static_cast<std::size_t>(network.num_bonds()), 0);
  planes_.resize(static_cast<std::size_t>(network.particles.size()));
  for (Index e = 0; e < network.num_bonds(); ++e) {
    unit_ = std::max(unit_, unit_of_distances * network.bonds.length(e));
  }
}

template <class Visit>
void CrackFaces::for_each_broken(Index particle, Visit visit) const {
  for (const Index e : neighbourhoods_.row(particle)) {
    if (e < network_.num_bonds() && broken_[e] != 0) visit(e);
  }
}

/// Returns the particles at the ends of bonds, ascending.
std::vector<Index> CrackFaces::particles_of(std::span<const Index> bonds) const {
  std::vector<Index> particles;
  for (const Index e : bonds) {
    particles.insert(particles.end(), {network_.bonds.first[e], network_.bonds.second[e]});
  }
  std::ranges::sort(particles);
  const auto repeated = std::ranges::unique(particles);
  particles.erase(repeated.begin(), repeated.end());
  return particles;
}

void CrackFaces::set_broken(Index bond, bool broken) {
  broken_[bond] = broken ? 1 : 0;
  if (broken) {
    newly_broken_.push_back(bond);
  } else {
    std::erase(newly_broken_, bond);
  }
  for (const Index end : {network_.bonds.first[bond], network_.bonds.second[bond]}) {
    for (const Index i : particles_of(neighbourhoods_.row(end))) planes_[i].reset();
  }
}

/// Finds the plane that fits the middles of the broken bonds of a particle and its neighbours best;
/// shorter bonds count more. With n the normal, x the middle of a bond of the length xi and the
/// direction e, and l the unit of distances, it minimises
///
///   sum of ((n'(x - mean x) / l)^2 - (n'e)^2) / xi^2.
///
/// Bonds that one plane cuts anywhere have middles up to n'e xi / 2 from it, with the mean square
/// (n'e xi)^2 / 12. Middles that scatter more are of a rough crack, whose faces interlock.
auto CrackFaces::plane_at(Index particle) -> const Plane& {
  std::optional<Plane>& plane = planes_[particle];
  if (plane) return *plane;
  const int dim = network_.dim();
  const Vector3 origin = point_of(network_.particles.positions, dim, particle);
  double sum = 0.0;
  Vector3 first{};
  SymmetricTensor places{}, directions{}, lengths{};
  for (const Index i : particles_of(neighbourhoods_.row(particle))) {
    for_each_broken(i, [&](Index e) {
      const auto direction = network_.bonds.direction(e);
      const double square = std::pow(network_.bonds.length(e) / unit_, 2), weight = 1.0 / square;
      Vector3 x{}, n{};
      for (int a = 0; a < dim; ++a) {
        const auto at = [&](Index end) { return network_.particles.position(end)[a]; };
        x[a] = (0.5 * (at(network_.bonds.first[e]) + at(network_.bonds.second[e])) - origin[a]) /
               unit_;
        n[a] = direction[a];
        first[a] += weight * x[a];
      }
      sum += weight;
      add_product(places, weight, x);
      add_product(directions, weight, n);
      add_product(lengths, 1.0, n);
    });
  }
  add_product(places, -1.0 / sum, first);
  SymmetricTensor tensor = directions;
  for (std::size_t c = 0; c < tensor.size(); ++c) tensor[c] -= places[c];
  const Vector3 normal = principal_direction(tensor, dim);
  return plane.emplace(
      Plane{normal, along(places, normal) <= most_scatter / 12.0 * along(lengths, normal)});
}

/// Returns the cosine of the angle between a bond and the mean normal at its ends.
double CrackFaces::cosine_of(Index bond) {
  const auto direction = network_.bonds.direction(bond);
  const auto along_bond = [&](const Vector3& n) {
    double sum = 0.0;
    for (std::size_t a = 0; a < direction.size(); ++a) sum += n[a] * direction[a];
    return sum;
  };
  const Vector3& first = plane_at(network_.bonds.first[bond]).normal;
  const Vector3& second = plane_at(network_.bonds.second[bond]).normal;
  const double side = along_bond(first) * along_bond(second) < 0.0 ? -1.0 : 1.0;
  Vector3 mean{};
  double square = 0.0;
  for (int a = 0; a < 3; ++a) {
    mean[a] = first[a] + side * second[a];
    square += mean[a] * mean[a];
  }
  return std::min(1.0, std::abs(along_bond(mean)) / std::sqrt(square));
}

/// Returns the part of a bond in the stress along the normal, times its distance across the crack,
/// in uniaxial stress without stress across it. Poisson's ratio is that of the network.
double CrackFaces::pressure_of(Index bond, double cosine) const {
  const double length = network_.bonds.length(bond), stiffness = network_.stiffness[bond];
  const double shear = network_.bending.empty() ? 0.0 : network_.bending[bond];
  const double ratio = network_.bending.empty() ? 0.0 : network_.ratio_of_bending(bond);
  const double nu = (1.0 - ratio) / ((network_.dim() == 2 ? 3.0 : 4.0) + ratio);
  const double square = cosine * cosine, rest = 1.0 - square;
  return length * length * square * (stiffness * (square - nu * rest) + shear * (1.0 + nu) * rest);
}

/// Returns whether a particle has a broken bond near the normal.
bool CrackFaces::has_strut(Index particle) {
  const auto [has, is_new] = has_strut_.try_emplace(particle, false);
  if (!is_new) return has->second;
  has->second = !plane_at(particle).flat;
  for_each_broken(particle,
                  [&](Index e) { has->second = has->second || cosine_of(e) >= near_normal; });
  return has->second;
}

/// A particle without bonds near the normal leaves its half of the pressure to the other ends. If
/// these have none either, the bonds nearest to the normal are the struts. At a rough crack all
/// bonds are.
CrackFaces::Face CrackFaces::face_of(Index particle) {
  if (!plane_at(particle).flat) return {0.0, 0.5};
  const bool has = has_strut(particle);
  Face face{near_normal, 0.0};
  if (!has) {
    face.least_angle_cosine = 0.0;
    for_each_broken(particle, [&](Index e) {
      constexpr double round_off = 1e-9;
      face.least_angle_cosine = std::max(face.least_angle_cosine, cosine_of(e) - round_off);
    });
  }
  double taken = 0.0, carried = 0.0;
  for_each_broken(particle, [&](Index e) {
    const bool is_first = network_.bonds.first[e] == particle;
    const Index other = is_first ? network_.bonds.second[e] : network_.bonds.first[e];
    const double cosine = cosine_of(e), pressure = pressure_of(e, cosine);
    const bool other_has = has_strut(other);
    taken += has == other_has ? 0.5 * pressure : has ? pressure : 0.0;
    if (cosine >= face.least_angle_cosine) carried += pressure;
  });
  if (taken > 0.0 && carried > 0.0) face.scale = taken / carried;
  return face;
}

std::set<Index> CrackFaces::broken_around(std::span<const Index> bonds) const {
  std::set<Index> around;
  for (const Index end : particles_of(bonds)) {
    for (const Index i : particles_of(neighbourhoods_.row(end))) {
      for_each_broken(i, [&](Index e) { around.insert(e); });
    }
  }
  return around;
}

auto CrackFaces::ratios_of(const std::set<Index>& elements) -> std::vector<Ratio> {
  has_strut_.clear();
  std::map<Index, Face> faces;
  std::vector<Ratio> ratios;
  for (const Index e : elements) {
    if (!concerns(e) || broken_[e] == 0) continue;
    const double cosine = cosine_of(e);
    double ratio = 0.0;
    for (const Index end : {network_.bonds.first[e], network_.bonds.second[e]}) {
      const auto [face, is_new] = faces.try_emplace(end);
      if (is_new) face->second = face_of(end);
      if (cosine >= face->second.least_angle_cosine) ratio += face->second.scale;
    }
    ratios.emplace_back(e, ratio);
  }
  return ratios;
}

}  // namespace perilink
