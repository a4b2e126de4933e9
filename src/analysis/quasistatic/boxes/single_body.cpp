#include "analysis/quasistatic/boxes/single_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace perilink {
namespace {

using Lanes [[gnu::vector_size(4 * block_width)]] = float;
using LanesInMemory [[gnu::vector_size(4 * block_width), gnu::aligned(4), gnu::may_alias]] = float;

const LanesInMemory* at(const float* numbers) {
  return reinterpret_cast<const LanesInMemory*>(numbers);
}
LanesInMemory* at(float* numbers) { return reinterpret_cast<LanesInMemory*>(numbers); }

template <int Dim>
constexpr int num_motions = Dim == 2 ? 3 : 6;

std::vector<Index> places_by_box(const BoxMotions& motions, Index particles) {
  std::vector<Index> place(static_cast<std::size_t>(particles));
  Index next = 0;
  for (Index b = 0; b < motions.num_boxes(); ++b) {
    for (const Index p : motions.particles(b)) place[p] = next++;
  }
  return place;
}

double largest_stiffness(const Network& network) {
  const auto largest = std::ranges::max_element(network.stiffness);
  return largest == network.stiffness.end() || *largest <= 0.0 ? 1.0 : *largest;
}

}  // namespace

bool SingleBody::is_made_of(const Network& network) {
  return !network.carries_moments() && !network.has_states() && !network.cells;
}

SingleBody::SingleBody(const Network& network, const Unknowns& unknowns, Secants secants,
                       const BoxMotions& motions, std::span<const double> blocks,
                       const Factor& coarse)
    : network_(network),
      unknowns_(unknowns),
      place_(places_by_box(motions, network.particles.size())),
      unit_(largest_stiffness(network)),
      bonds_(network, secants, place_, unit_),
      blocks_(blocks.size()),
      factor_(coarse.in_single(unit_)) {
  const auto dim = static_cast<std::size_t>(network.dim());
  const auto count = static_cast<std::size_t>(motions.num_motions());
  moves_.resize(place_.size() * dim * count);
  for (Index p = 0; p < network.particles.size(); ++p) {
    const auto at_place = static_cast<std::size_t>(place_[p]);
    for (std::size_t a = 0; a < dim; ++a) {
      const int component = static_cast<int>(a);
      const std::array<double, 6> row = motions.row(p, component);
      std::copy_n(row.begin(), count,
                  moves_.begin() + static_cast<std::ptrdiff_t>((at_place * dim + a) * count));
      if (unknowns.at(p, component) < 0) continue;
      for (std::size_t b = 0; b < dim; ++b) {
        if (unknowns.at(p, static_cast<int>(b)) < 0) continue;
        blocks_[(at_place * dim + a) * dim + b] =
            static_cast<float>(blocks[(p * dim + a) * dim + b] * unit_);
      }
    }
  }
  std::size_t end = 0;
  for (Index b = 0; b < motions.num_boxes(); ++b) {
    box_end_.push_back(end += motions.particles(b).size());
  }
  coarse_.resize(box_end_.size() * count * block_width);
}

void SingleBody::follow(Secants secants, std::span<const double> ground) {
  bonds_.follow(secants);
  springs_.clear();
  if (ground.empty() && network_.support_stiffness.empty()) return;
  const auto dim = static_cast<std::size_t>(network_.dim());
  springs_.resize(place_.size() * dim);
  for (std::size_t slot = 0; slot < springs_.size(); ++slot) {
    const Index unknown = unknowns_.number[slot];
    double spring = 0.0;
    if (!network_.support_stiffness.empty()) spring += network_.support_stiffness[slot];
    if (!ground.empty() && unknown >= 0) spring += ground[unknown];
    springs_[static_cast<std::size_t>(place_[slot / dim]) * dim + slot % dim] =
        static_cast<float>(spring / unit_);
  }
}

void SingleBody::multiply(std::span<const float> motions, std::span<float> forces,
                          const RowsDone& done) const {
  const auto dim = static_cast<std::size_t>(network_.dim());
  bonds_.forces(motions, forces, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * dim; k < end * dim && !springs_.empty(); ++k) {
      if (springs_[k] != 0.0F) at(forces.data())[k] += springs_[k] * at(motions.data())[k];
    }
    done(begin * dim, end * dim);
  });
}

template <int Dim>
void SingleBody::restrict_to_boxes(const float* residuals) {
  constexpr int count = num_motions<Dim>;
  const LanesInMemory* residual = at(residuals);
  const float* move = moves_.data();
  const float* end = move;
  const Index* place = factor_.place.data();
  for (std::size_t b = 0; b < box_end_.size(); ++b) {
    Lanes sums[count] = {};
    for (end = moves_.data() + box_end_[b] * Dim * count; move < end; move += count, ++residual) {
      for (int m = 0; m < count; ++m) sums[m] += move[m] * *residual;
    }
    for (int m = 0; m < count; ++m) at(coarse_.data())[*place++] = sums[m];
  }
}

template <int Dim>
void SingleBody::add_motions(const float* residuals, float* motions, const RowsDone& done) const {
  constexpr int count = num_motions<Dim>;
  const LanesInMemory* residual = at(residuals);
  LanesInMemory* motion = at(motions);
  const Index* from = factor_.place.data();
  const float* move = moves_.data();
  const float* block = blocks_.data();
  std::size_t place = 0, told = 0;
  for (std::size_t b = 0; b < box_end_.size(); ++b) {
    Lanes values[count];
    for (int m = 0; m < count; ++m) values[m] = at(coarse_.data())[*from++];
    for (; place < box_end_[b]; ++place, residual += Dim) {
      for (int a = 0; a < Dim; ++a, move += count, block += Dim, ++motion) {
        Lanes sum = block[0] * residual[0];
        for (int c = 1; c < Dim; ++c) sum += block[c] * residual[c];
        for (int m = 0; m < count; ++m) sum += move[m] * values[m];
        *motion = sum;
      }
    }
    done(told * Dim, place * Dim);
    told = place;
  }
}

void SingleBody::precondition(std::span<const float> residuals, std::span<float> motions,
                              const RowsDone& done) {
  const bool plane = network_.dim() == 2;
  plane ? restrict_to_boxes<2>(residuals.data()) : restrict_to_boxes<3>(residuals.data());
  factor_.solve(coarse_);
  plane ? add_motions<2>(residuals.data(), motions.data(), done)
        : add_motions<3>(residuals.data(), motions.data(), done);
}

}  // namespace perilink
