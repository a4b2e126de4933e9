#include "analysis/quasistatic/equilibrium/body/crack_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "discretization/bonds.hpp"
#include "discretization/mesh_faces.hpp"

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

/// Returns n' tensor n.
double along(const SymmetricTensor& tensor, const Vector3& n) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    sum += tensor[a] * n[a] * n[a] + 2.0 * tensor[3 + a] * n[a] * n[(a + 1) % 3];
  }
  return sum;
}

/// Sorts numbers and leaves each once.
void sort_out_repeated(std::vector<Index>& numbers) {
  std::ranges::sort(numbers);
  const auto repeated = std::ranges::unique(numbers);
  numbers.erase(repeated.begin(), repeated.end());
}

}  // namespace

CrackFaces::CrackFaces(const Network& network) : network_(network) {
  if (network.has_closing()) closed_.assign(static_cast<std::size_t>(network.num_elements()), 1.0);
}

bool CrackFaces::is_broken(Index element) const {
  if (!concerns(element) || sites_.empty()) return false;
  const auto& site = sites_[network_.bonds.first[element]];
  return site != nullptr && std::ranges::binary_search(site->broken, element);
}

/// Gets ready for the first broken bond.
void CrackFaces::begin() {
  neighbourhoods_ = bonds_of_particles(network_.bonds, network_.particles.size());
  sites_.resize(static_cast<std::size_t>(network_.particles.size()));
  for (Index e = 0; e < network_.num_bonds(); ++e) {
    unit_ = std::max(unit_, unit_of_distances * network_.bonds.length(e));
  }
}

/// Returns the particles at the ends of bonds and their neighbours, where bonds have broken,
/// ascending.
std::vector<Index> CrackFaces::particles_around(std::span<const Index> bonds) const {
  std::vector<Index> around;
  const auto add = [&](Index particle) {
    if (sites_[particle] != nullptr) around.push_back(particle);
  };
  for (const Index bond : sites_.empty() ? std::span<const Index>() : bonds) {
    for (const Index end : {network_.bonds.first[bond], network_.bonds.second[bond]}) {
      add(end);
      for (const Index e : neighbourhoods_.row(end)) add(network_.bonds.other_end(e, end));
    }
  }
  sort_out_repeated(around);
  return around;
}

void CrackFaces::set_broken(Index bond, bool broken) {
  if (sites_.empty()) begin();
  if (broken) {
    newly_broken_.push_back(bond);
  } else {
    std::erase(newly_broken_, bond);
  }
  for (const Index end : {network_.bonds.first[bond], network_.bonds.second[bond]}) {
    if (sites_[end] == nullptr) sites_[end] = std::make_unique<Site>();
    std::vector<Index>& own = sites_[end]->broken;
    const auto at = std::ranges::lower_bound(own, bond);
    if (broken) {
      own.insert(at, bond);
    } else {
      own.erase(at);
    }
    sum(end);
  }
  for (const Index i : particles_around({&bond, 1})) {
    sites_[i]->plane.reset();
    for (const Index e : sites_[i]->broken) {
      for (const Index end : {network_.bonds.first[e], network_.bonds.second[e]}) {
        sites_[end]->cosines.clear();
      }
    }
  }
}

/// Sums over the broken bonds of a particle.
void CrackFaces::sum(Index particle) {
  Site& site = *sites_[particle];
  if (site.broken.empty()) return sites_[particle].reset();
  site.sums = {};
  for (const Index e : site.broken) {
    const double length = network_.bonds.length(e), weight = std::pow(unit_ / length, 2);
    const double sign = network_.bonds.first[e] == particle ? 1.0 : -1.0;
    Vector3 n{};
    std::ranges::copy(network_.bonds.direction(e), n.begin());
    site.sums.weight += weight;
    for (int a = 0; a < 3; ++a) site.sums.first[a] += 0.5 * sign * unit_ / length * n[a];
    add_square(site.sums.places, 0.25, n);
    add_square(site.sums.directions, weight, n);
    add_square(site.sums.squares, 1.0, n);
  }
}

/// Adds the sums of a particle at a distance, over the unit of distances.
void CrackFaces::add_sums(Index particle, const Vector3& shift, Sums& sums) const {
  const Sums& own = sites_[particle]->sums;
  Vector3 first = own.first;
  for (int a = 0; a < 3; ++a) {
    first[a] += own.weight * shift[a];
    sums.first[a] += first[a];
  }
  sums.weight += own.weight;
  for (std::size_t c = 0; c < own.places.size(); ++c) {
    sums.places[c] += own.places[c];
    sums.directions[c] += own.directions[c];
    sums.squares[c] += own.squares[c];
  }
  add_square(sums.places, 1.0 / own.weight, first);
  add_square(sums.places, -1.0 / own.weight, own.first);
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
  std::optional<Plane>& plane = sites_[particle]->plane;
  if (plane) return *plane;
  Sums sums = sites_[particle]->sums;
  const auto origin = network_.particles.position(particle);
  for (const Index e : neighbourhoods_.row(particle)) {
    const Index other = network_.bonds.other_end(e, particle);
    if (sites_[other] == nullptr) continue;
    Vector3 shift{};
    for (std::size_t a = 0; a < origin.size(); ++a) {
      shift[a] = (network_.particles.position(other)[a] - origin[a]) / unit_;
    }
    add_sums(other, shift, sums);
  }
  add_square(sums.places, -1.0 / sums.weight, sums.first);
  SymmetricTensor tensor = sums.directions;
  for (std::size_t c = 0; c < tensor.size(); ++c) tensor[c] -= sums.places[c];
  const Vector3 n = principal_direction(tensor, network_.dim());
  return plane.emplace(
      Plane{n, along(sums.places, n) <= most_scatter / 12.0 * along(sums.squares, n)});
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

/// Returns a particle with the cosines of its broken bonds.
auto CrackFaces::with_cosines(Index particle) -> const Site& {
  Site& site = *sites_[particle];
  if (!site.cosines.empty()) return site;
  for (const Index e : site.broken) site.cosines.push_back(cosine_of(e));
  site.largest_cosine = std::ranges::max(site.cosines);
  return site;
}

/// Returns whether a particle has a broken bond near the normal. At a rough crack all bonds are
/// struts.
bool CrackFaces::has_strut(Index particle) {
  return !plane_at(particle).flat || with_cosines(particle).largest_cosine >= near_normal;
}

/// A particle without bonds near the normal leaves its half of the pressure to the other ends. If
/// these have none either, the bonds nearest to the normal are the struts. At a rough crack all
/// bonds are.
CrackFaces::Face CrackFaces::face_of(Index particle) {
  if (!plane_at(particle).flat) return {0.0, 0.5};
  constexpr double round_off = 1e-9;
  const bool has = has_strut(particle);
  const Site& site = with_cosines(particle);
  Face face{has ? near_normal : site.largest_cosine - round_off, 0.0};
  double taken = 0.0, carried = 0.0;
  for (std::size_t k = 0; k < site.broken.size(); ++k) {
    const Index e = site.broken[k];
    const double pressure = pressure_of(e, site.cosines[k]);
    const bool other_has = has_strut(network_.bonds.other_end(e, particle));
    taken += has == other_has ? 0.5 * pressure : has ? pressure : 0.0;
    if (site.cosines[k] >= face.least_angle_cosine) carried += pressure;
  }
  if (taken > 0.0 && carried > 0.0) face.scale = taken / carried;
  return face;
}

std::vector<Index> CrackFaces::broken_around(std::span<const Index> bonds) const {
  std::vector<Index> around;
  for (const Index i : particles_around(bonds)) {
    around.insert(around.end(), sites_[i]->broken.begin(), sites_[i]->broken.end());
  }
  sort_out_repeated(around);
  return around;
}

auto CrackFaces::ratios_of(std::span<const Index> elements) -> std::vector<Ratio> {
  std::map<Index, Face> faces;
  std::vector<Ratio> ratios;
  for (const Index e : elements) {
    if (!is_broken(e)) continue;
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
