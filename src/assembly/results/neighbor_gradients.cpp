#include "assembly/results/neighbor_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discretization/vector_at.hpp"

namespace perilink {
namespace {

/// Most local environments in a table. A block of a box has about a hundred. In an unstructured
/// particle set no two are equal, and the table only fills up.
constexpr std::size_t most_kinds = 256;

/// Error of the difference of two positions over the larger coordinate: each coordinate is a
/// product and a sum.
constexpr double round_off = 8.0 * std::numeric_limits<double>::epsilon();

/// Error of marks: components of unit normals and ratios of moduli.
constexpr double like_marks = 1e-12;

double largest_coordinate(const Particles& particles, Index particle) {
  double largest = 0.0;
  for (const double x : particles.position(particle)) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace

template <int Dim>
NeighborGradients<Dim>::NeighborGradients(const Particles& particles,
                                          std::span<const double> motion, int width, Fit fit,
                                          bool coupled)
    : particles_(particles),
      motion_(motion),
      width_(static_cast<std::size_t>(width)),
      fit_(fit),
      coupled_(coupled) {}

template <int Dim>
bool NeighborGradients<Dim>::is_like(const Kind& kind, Index particle,
                                     std::span<const double> marks) const {
  if (kind.offsets.size() != offsets_.size()) return false;
  const auto alike = [](double a, double b) { return std::abs(a - b) <= like_marks; };
  if (!std::ranges::equal(kind.marks, marks, alike)) return false;
  const double most = round_off * (largest_coordinate(particles_, particle) + kind.reach);
  int unlike = 0;
  for (std::size_t k = 0; k < offsets_.size(); ++k) {
    unlike |= std::abs(offsets_[k] - kind.offsets[k]) > most ? 1 : 0;
  }
  return unlike == 0;
}

template <int Dim>
void NeighborGradients<Dim>::fit(Kind& kind, std::span<const double> marks) const {
  kind.offsets = offsets_;
  kind.marks.assign(marks.begin(), marks.end());
  kind.reach = 0.0;
  for (const double x : offsets_) kind.reach = std::max(kind.reach, std::abs(x));
  kind.weights.assign(offsets_.size() * (coupled_ ? Dim * Dim : 1), 0.0);
  kind.settled = !offsets_.empty() && fit_(kind.offsets, kind.marks, kind.weights);
}

template <int Dim>
const typename NeighborGradients<Dim>::Kind& NeighborGradients<Dim>::kind_of(
    Index particle, std::span<const Index> neighbors, std::span<const double> marks) {
  const auto here = vector_at<Dim>(particles_.positions, particle);
  offsets_.resize(neighbors.size() * Dim);
  std::uint64_t key = neighbors.size();
  double* offset = offsets_.data();
  for (std::size_t k = 0; k < neighbors.size(); ++k, offset += Dim) {
    const auto there = vector_at<Dim>(particles_.positions, neighbors[k]);
    for (int a = 0; a < Dim; ++a) offset[a] = there[a] - here[a];
    key += static_cast<std::uint64_t>(neighbors[k] - particle) * (2 * k + 1);
  }
  const auto known = kinds_.find(key);
  if (known != kinds_.end() && is_like(known->second, particle, marks)) return known->second;
  const bool stays = known == kinds_.end() && kinds_.size() < most_kinds;
  Kind& kind = stays ? kinds_[key] : single_;
  fit(kind, marks);
  return kind;
}

template <int Dim>
bool NeighborGradients<Dim>::find(Index particle, std::span<const Index> neighbors,
                                  Gradient& gradient, std::span<const double> marks) {
  const Kind& kind = kind_of(particle, neighbors, marks);
  if (!kind.settled) return false;
  const double* const here = motion_.data() + width_ * static_cast<std::size_t>(particle);
  const double* weight = kind.weights.data();
  gradient.setZero();
  for (const Index j : neighbors) {
    const double* const there = motion_.data() + width_ * static_cast<std::size_t>(j);
    for (int a = 0; a < Dim; ++a) {
      const double moved = there[a] - here[a];
      if (coupled_) {
        for (int g = 0; g < Dim * Dim; ++g) gradient(g / Dim, g % Dim) += moved * *weight++;
      } else {
        for (int b = 0; b < Dim; ++b) gradient(a, b) += moved * weight[b];
      }
    }
    if (!coupled_) weight += Dim;
  }
  return true;
}

template class NeighborGradients<2>;
template class NeighborGradients<3>;

}  // namespace perilink
