#include "assembly/results/crack_state.hpp"

#include <algorithm>

#include "material/principal_values.hpp"

namespace perilink {
namespace {

/// Largest secant of the bonds of a crack [-].
constexpr double half_of_stiffness = 0.5;

/// Returns the sum of the lost stiffness fraction times n n over the damaged bonds of a particle.
SymmetricTensor lost_at(const Network& network, const Csr& neighbourhoods, Secants secants,
                        Index particle) {
  SymmetricTensor sum{};
  for (const Index e : neighbourhoods.row(particle)) {
    if (e >= network.first_contact() || secants.axial(e) > half_of_stiffness) continue;
    const auto direction = network.bonds.direction(e);
    Vector3 n{};
    std::copy(direction.begin(), direction.end(), n.begin());
    add_square(sum, 1.0 - secants.axial(e), n);
  }
  return sum;
}

double opening_of(const Network& network, const Csr& neighbourhoods, Secants secants,
                  std::span<const double> motion, Index bond) {
  const Bonds& bonds = network.bonds;
  const int dim = network.dim();
  const auto width = static_cast<std::size_t>(network.width());
  SymmetricTensor lost = lost_at(network, neighbourhoods, secants, bonds.first[bond]);
  const SymmetricTensor more = lost_at(network, neighbourhoods, secants, bonds.second[bond]);
  for (std::size_t c = 0; c < lost.size(); ++c) lost[c] += more[c];
  const Vector3 normal = principal_direction(lost, dim);
  double along = 0.0, apart = 0.0;
  for (int a = 0; a < dim; ++a) {
    along += normal[a] * bonds.direction(bond)[a];
    apart += normal[a] *
             (motion[bonds.second[bond] * width + a] - motion[bonds.first[bond] * width + a]);
  }
  const double opening = (1.0 - secants.axial(bond)) * (along < 0.0 ? -apart : apart);
  return std::max(0.0, opening);
}

}  // namespace

CrackOpenings crack_openings(const Network& network, const Csr& neighbourhoods, Secants secants,
                             std::span<const double> motion) {
  CrackOpenings openings;
  for (Index e = 0; e < network.first_contact(); ++e) {
    if (secants.axial(e) > half_of_stiffness) continue;
    openings.bonds.push_back(e);
    openings.opening.push_back(opening_of(network, neighbourhoods, secants, motion, e));
  }
  return openings;
}

std::vector<double> openings_at_particles(const Network& network, const CrackOpenings& openings) {
  std::vector<double> at(static_cast<std::size_t>(network.particles.size()), 0.0);
  for (std::size_t k = 0; k < openings.bonds.size(); ++k) {
    for (const Index i :
         {network.bonds.first[openings.bonds[k]], network.bonds.second[openings.bonds[k]]}) {
      at[i] = std::max(at[i], openings.opening[k]);
    }
  }
  return at;
}

}  // namespace perilink
