#include "analysis/quasistatic/equilibrium/update/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/plain_text.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Energy over work below which there is a mechanism [-]. Mechanisms showed 1e-10 and less, bodies
/// too slender for double precision 0.2 and more.
constexpr double none = 1e-4;

/// Returns the position of an unknown as text; empty for nodes of finite elements.
std::string place_of(Index unknown, const Unknowns& unknowns, const Network* network) {
  for (std::size_t slot = 0; network && slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] != unknown) continue;
    const Index particle = static_cast<Index>(slot) / unknowns.width;
    return fmt::format(", at ({})", joined(network->particles.position(particle)));
  }
  return {};
}

/// Returns the unknown that moves most if bonds do not store the work of random forces, else
/// no_index.
Index find_mechanism(Factor& factor, const Unknowns& unknowns, const InternalForceOf& internal_of) {
  if (unknowns.count == 0) return no_index;
  std::mt19937 random(7);  // fixed: the same result in every run
  std::vector<double> forces(static_cast<std::size_t>(unknowns.count)), motion(forces.size());
  for (double& force : forces) force = static_cast<double>(random() % 2) - 0.5;
  factor.solve(forces, motion);
  double work = 0.0;
  for (std::size_t k = 0; k < forces.size(); ++k) work += 0.5 * forces[k] * motion[k];
  std::vector<double> displacement = unknowns.expand(motion);
  for (std::size_t slot = 0; slot < displacement.size(); ++slot) {
    displacement[slot] -= unknowns.prescribed[slot];
  }
  const double energy = internal_of(displacement).energy;
  if (energy > none * work) return no_index;
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<Index>(std::ranges::max_element(motion, smaller) - motion.begin());
}

}  // namespace

void factorize_stiffness(Factor& factor, const SparseMatrix& stiffness, const Unknowns& unknowns,
                         const Network* network, const InternalForceOf& internal_of) {
  Index moves = no_index;
  try {
    factor.factorize(stiffness, unknowns.owners());
    moves = find_mechanism(factor, unknowns, internal_of);
    if (moves == no_index) return;
  } catch (const NotPositiveDefinite& error) {
    moves = error.unknown();
  }
  // Contact springs of closed pre-cracks need a factor.
  const bool has_contacts = network != nullptr && network->num_contacts > 0;
  throw NotPositiveDefinite(
      "part of the body can move freely" + place_of(moves, unknowns, network) +
          ", or it is so slender, or held so softly, that round-off hides its stiffness: the "
          "stiffness matrix is singular to working precision" +
          (has_contacts ? "" : "; conjugate gradients (solver = \"iterative\") lose fewer digits"),
      moves);
}

}  // namespace perilink
