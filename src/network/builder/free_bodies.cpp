#include "network/builder/free_bodies.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Returns the rigid-body motion of a fragment nearest to a field in weighted least squares over
/// slots, shape (particles, width).
std::vector<double> nearest_motion(const Network& network, const Fragment& fragment,
                                   const std::vector<double>& field,
                                   const std::vector<double>& weight) {
  const auto motions = free_motions(network, fragment, std::vector<std::uint8_t>(field.size(), 0));
  const auto count = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd parts = Eigen::VectorXd::Zero(count);
  for (std::size_t slot = 0; slot < field.size(); ++slot) {
    for (Eigen::Index m = 0; m < count; ++m) {
      parts[m] += weight[slot] * motions[m][slot] * field[slot];
      for (Eigen::Index n = 0; n < count; ++n) {
        products(m, n) += weight[slot] * motions[m][slot] * motions[n][slot];
      }
    }
  }
  parts = least_squares(products, parts);
  std::vector<double> nearest(field.size(), 0.0);
  for (std::size_t slot = 0; slot < field.size(); ++slot) {
    for (Eigen::Index m = 0; m < count; ++m) nearest[slot] += parts[m] * motions[m][slot];
  }
  return nearest;
}

}  // namespace

std::vector<std::uint8_t> held_components(const Network& network, const Unknowns& unknowns) {
  std::vector<std::uint8_t> held;
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    const bool is_embedded_point =
        network.is_embedded_point(static_cast<Index>(slot / unknowns.width));
    held.push_back(unknowns.number[slot] == no_index && !is_embedded_point);
  }
  return held;
}

std::vector<std::vector<double>> free_motions(const Network& network, const Unknowns& unknowns) {
  const std::vector<std::uint8_t> held =
      held_or_sprung(network, held_components(network, unknowns));
  std::vector<std::vector<double>> motions;
  for (const Fragment& fragment : find_fragments(network, held)) {
    if (fragment.free_modes == 0) continue;
    for (auto& motion : free_motions(network, fragment, held)) {
      motions.push_back(std::move(motion));
    }
  }
  return motions;
}

double strained_motion(const Network& network, const Fragment& fragment,
                       const std::vector<std::uint8_t>& held,
                       const std::vector<double>& prescribed) {
  const auto width = static_cast<std::size_t>(network.width());
  std::vector<std::size_t> own;
  for (const Index i : fragment.particles) {
    for (std::size_t slot = i * width; slot < (i + 1) * width; ++slot) {
      if (held[slot] != 0) own.push_back(slot);
    }
  }
  if (own.empty()) return 0.0;
  const std::vector<double> weight(held.begin(), held.end());
  const std::vector<double> nearest = nearest_motion(network, fragment, prescribed, weight);
  double largest = 0.0;
  for (const std::size_t slot : own) {
    largest = std::max(largest, std::abs(nearest[slot] - prescribed[slot]));
  }
  return largest;
}

void balance_loads(const Network& network, const Fragment& fragment, std::vector<double> mass,
                   Loads& loads) {
  std::fill(mass.begin() + std::ptrdiff_t{network.first_embedded_point()} * network.width(),
            mass.end(),
            0.0);  // embedded points follow their particles
  std::vector<double> acceleration(mass.size(), 0.0);
  for (std::size_t slot = 0; slot < mass.size(); ++slot) {
    if (mass[slot] > 0.0) acceleration[slot] = loads.forces[slot] / mass[slot];
  }
  acceleration = nearest_motion(network, fragment, acceleration, mass);
  for (std::size_t slot = 0; slot < mass.size(); ++slot) {
    loads.forces[slot] -= mass[slot] * acceleration[slot];
  }
}

}  // namespace perilink
