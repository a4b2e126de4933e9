#include "analysis/dynamics/bonds/runs/separation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/plain_text.hpp"

namespace perilink {
namespace {

/// Fraction of the loads on a piece that may be out of balance, as given values have few digits.
constexpr double unbalanced = 1e-6;
/// Fraction of the loads on the body that is round-off.
constexpr double round_off = 1e-12;
/// Displacement over the size of the body, or rotation, that no elastic body reaches.
constexpr double far_away = 1e6;
/// Displacement over the size of the body by which the faces of cracks have met.
constexpr double closed_by = 0.01;
/// Fraction of the prescribed displacements that strains a piece.
constexpr double straining = 1e-9;

double sum_of_sizes(const std::vector<double>& forces) {
  return std::accumulate(forces.begin(), forces.end(), 0.0,
                         [](double sum, double force) { return sum + std::abs(force); });
}

/// Returns the work of the loads if all forces moved along by the size of the body, and all moments
/// turned by one [force length].
double work_over_size(const LoadedNetwork& problem) {
  const std::vector<double>& positions = problem.network.particles.positions;
  const auto dim = static_cast<std::size_t>(problem.network.dim());
  const auto width = static_cast<std::size_t>(problem.network.width());
  double size = 0.0, work = 0.0;
  for (std::size_t axis = 0; axis < dim; ++axis) {
    double low = infinity, high = -infinity;
    for (std::size_t k = axis; k < positions.size(); k += dim) {
      low = std::min(low, positions[k]);
      high = std::max(high, positions[k]);
    }
    size = std::hypot(size, high - low);
  }
  for (std::size_t slot = 0; slot < problem.loads.forces.size(); ++slot) {
    work += std::abs(problem.loads.forces[slot]) * (slot % width < dim ? size : 1.0);
  }
  return work;
}

/// Returns whether a motion presses crack faces together.
bool presses_faces(const Network& network, std::span<const double> motion) {
  const auto width = static_cast<std::size_t>(network.width());
  double largest = 0.0;
  for (const double u : motion) largest = std::max(largest, std::abs(u));
  return std::ranges::any_of(network.contacts(), [&](Index element) {
    const auto normal = network.bonds.direction(element);
    double extension = 0.0;
    for_each_end(network, element, [&](Index i, bool second, double weight) {
      const double* const u = motion.data() + static_cast<std::size_t>(i) * width;
      const double along = std::inner_product(normal.begin(), normal.end(), u, 0.0);
      extension += (second ? weight : -weight) * along;
    });
    return extension < -straining * largest;
  });
}

}  // namespace

Separation::Separation(const LoadedNetwork& problem)
    : problem_(problem),
      held_(held_components(problem.network, problem.unknowns)),
      resisted_(held_or_sprung(problem.network, held_)) {
  for (const double value : problem.unknowns.prescribed) {
    largest_ = std::max(largest_, std::abs(value));
  }
  far_ = far_away * work_over_size(problem);
  closes_ = problem.network.has_closing();
}

bool Separation::is_mechanism(double work, double load_factor, double stiffness) const {
  // Bonds that close may stop a motion that begins freely.
  const double least = closes_ ? closed_by * std::abs(load_factor) * far_ / far_away : 0.0;
  if (!(work > least)) return false;
  return work * work > std::abs(load_factor) * far_ * std::max(stiffness, 0.0);
}

bool Separation::is_strained(Secants secants, const std::vector<std::uint8_t>& held) const {
  const auto pieces = connected_parts(problem_.network, secants);
  return std::any_of(pieces.begin(), pieces.end(), [&](const Fragment& fragment) {
    return strained_motion(problem_.network, fragment, held, problem_.unknowns.prescribed) >
           straining * largest_;
  });
}

std::string Separation::examine(Secants secants, double fractured, bool is_loaded) {
  examined_ = fractured;
  const Network& network = problem_.network;
  const std::vector<double>& forces = problem_.loads.forces;
  const double on_body = sum_of_sizes(forces);
  for (const Fragment& piece : connected_parts(network, secants)) {
    const double least = std::max(unbalanced * size_of_loads(piece), round_off * on_body);
    if (!is_loaded || !(size_of_loads(piece) > least)) continue;
    std::vector<double> along(forces.size(), 0.0);  // the motion of the piece that gives most work
    bool is_pulled = false;
    for (const std::vector<double>& motion : free_motions(network, piece, resisted_)) {
      const double pull = std::inner_product(motion.begin(), motion.end(), forces.begin(), 0.0);
      is_pulled = is_pulled || std::abs(pull) > least;
      for (std::size_t slot = 0; slot < along.size(); ++slot) along[slot] += pull * motion[slot];
    }
    if (!is_pulled || presses_faces(network, along)) continue;
    return fmt::format("the body is in pieces, and the loads pull away the piece of {} at ({})",
                       counted(piece.particles.size(), "particle"),
                       joined(network.particles.position(piece.particles.front())));
  }
  if (!(largest_ > 0.0)) return "";
  // Elastic supports count only where rigid supports allow no strain.
  const bool was_strained = is_strained({}, held_);
  is_unstrained_ =
      (was_strained || on_body == 0.0) && !is_strained(secants, was_strained ? held_ : resisted_);
  return "";
}

double Separation::size_of_loads(const Fragment& piece) const {
  const auto width = static_cast<std::size_t>(problem_.network.width());
  double sum = 0.0;
  for (const Index i : piece.particles) {
    for (std::size_t slot = i * width; slot < (i + 1) * width; ++slot) {
      sum += std::abs(problem_.loads.forces[slot]);
    }
  }
  return sum;
}

}  // namespace perilink
