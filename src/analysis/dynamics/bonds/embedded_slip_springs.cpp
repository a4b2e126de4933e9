#include "analysis/dynamics/bonds/embedded_slip_springs.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "analysis/dynamics/time_state.hpp"
#include "base/csr.hpp"

namespace perilink {
namespace {

class EmbeddedSlipSprings final : public ExplicitBonds {
 public:
  EmbeddedSlipSprings(const Network& network, std::unique_ptr<ExplicitBonds> others)
      : network_(network),
        others_(std::move(others)),
        dim_(static_cast<std::size_t>(network.dim())),
        width_(static_cast<std::size_t>(network.width())) {
    const Index count = network.particles.size();
    for (Index e = 0; e < network.first_bar_element; ++e) {
      if (!network.is_embedded_point(network.bonds.second[e])) continue;
      elements_.push_back(e);
      const Index embedded_point = network.bonds.second[e] - network.first_embedded_point();
      ends_.append(std::vector<Index>{network.bonds.first[e]}, std::vector<double>{-1.0});
      const auto particles = network.embedded_points.particles.row(embedded_point);
      const auto weights = network.embedded_points.weights_of(embedded_point);
      if (network.law(e).closes()) {
        const auto strain =
            network.embedded_points.strain_weights_of(embedded_point, network.dim());
        ends_.strain_weights.resize(ends_.weights.size() * dim_, 0.0);
        ends_.strain_weights.insert(ends_.strain_weights.end(), strain.begin(), strain.end());
      }
      ends_.particles.values.insert(ends_.particles.values.end(), particles.begin(),
                                    particles.end());
      ends_.weights.insert(ends_.weights.end(), weights.begin(), weights.end());
      ends_.particles.offsets.back() = static_cast<Index>(ends_.weights.size());
    }
    std::vector<Index> slip_spring_of(ends_.weights.size());
    for (Index tie = 0; tie < ends_.size(); ++tie) {
      for (Index k = ends_.particles.offsets[tie]; k < ends_.particles.offsets[tie + 1]; ++k) {
        slip_spring_of[k] = tie;
      }
    }
    const Csr shares = sorted_into_rows(count, [&](const auto& add) {
      for (std::size_t k = 0; k < slip_spring_of.size(); ++k) {
        add(ends_.particles.values[k], static_cast<Index>(k));
      }
    });
    offsets_ = shares.offsets;
    for (const Index k : shares.values) {
      const Index tie = slip_spring_of[k], element = elements_[tie];
      const bool closes = network.law(element).closes();
      shares_.push_back({tie, ends_.weights[k], strain_weights_of(k),
                         k == ends_.particles.offsets[tie], closes, 0, closes ? 0.0 : 1.0,
                         limit_of(element, 0)});
    }
  }

  BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                    std::span<double> force) override {
    BondLosses losses;
    if (others_) {
      losses = others_->forces(begin, end, time_step, motion, force);
    } else {
      std::fill(force.begin() + begin * static_cast<std::ptrdiff_t>(width_),
                force.begin() + end * static_cast<std::ptrdiff_t>(width_), 0.0);
    }
    for (Index i = begin; i < end; ++i) {
      for (Index k = offsets_[i]; k < offsets_[i + 1]; ++k) {
        Share& share = shares_[k];
        const double now = extension(share.tie, motion.displacement);
        if (std::abs(now) > share.limit) give_way(share, now, time_step, motion, losses);
        if (share.closes) share.secant = now < 0.0 ? 1.0 : 0.0;
        const Index element = elements_[share.tie];
        const double tension = network_.stiffness[element] * share.secant * now;
        const double pull = share.weight * tension;
        for (std::size_t a = 0; a < dim_; ++a) {
          double& sum = force[static_cast<std::size_t>(i) * width_ + a];
          sum += pull * network_.bonds.direction(element)[a];
          if (share.closes) sum += tension * share.strain_weight[a];
        }
      }
    }
    return losses;
  }

  double stored(Index begin, Index end, double time_step, const BondMotion& motion) const override {
    double energy = others_ ? others_->stored(begin, end, time_step, motion) : 0.0;
    for (Index k = offsets_[begin]; k < offsets_[end]; ++k) {
      const Share& share = shares_[k];
      if (!share.at_node) continue;
      const double whole = whole_energy(share.tie, time_step, motion);
      energy += share.secant * (share.closes ? std::max(0.0, whole) : whole);
    }
    return energy;
  }

  std::vector<double> secants() const override {
    std::vector<double> secants =
        others_ ? others_->secants()
                : std::vector<double>(static_cast<std::size_t>(network_.num_elements()));
    // The node's share decides, also where ranks merge secants: nodes have the last numbers.
    for (const Share& share : shares_) {
      secants[elements_[share.tie]] = share.secant;
    }
    return secants;
  }

  void save(MovingElements& state) const override {
    for (const Share& share : shares_) state.slip_segment.push_back(share.segment);
    if (others_) others_->save(state);
  }
  void restore(const MovingElements& state) override {
    expect_equal_sizes(state.slip_segment.size(), shares_.size());
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      Share& share = shares_[k];
      const Index element = elements_[share.tie];
      share.segment = state.slip_segment[k];
      share.limit = limit_of(element, share.segment);
      if (share.segment > 0) share.secant = network_.law(element).segment(share.segment).secant;
    }
    if (others_) others_->restore(state);
  }

 private:
  /// Slip spring at one of the particles of its ends; all shares have identical states.
  struct Share {
    Index tie;
    double weight;          ///< weight of the particle in the extension
    Vector3 strain_weight;  ///< see EmbeddedPoints
    bool at_node;           ///< the particle is the node, which counts the energy
    bool closes;            ///< of a contact spring, without tension
    int segment;
    double secant;  ///< secant stiffness ratio
    double limit;   ///< extension of the next event [length]
  };

  Vector3 strain_weights_of(Index k) const {
    Vector3 weights{};
    if ((static_cast<std::size_t>(k) + 1) * dim_ > ends_.strain_weights.size()) return weights;
    for (std::size_t a = 0; a < dim_; ++a) weights[a] = ends_.strain_weights[k * dim_ + a];
    return weights;
  }

  double limit_of(Index element, int segment) const {
    return network_.critical_stretch[element] * network_.law(element).segment(segment).limit *
           network_.bonds.length(element);
  }

  double extension(Index tie, std::span<const double> motion) const {
    const auto n = network_.bonds.direction(elements_[tie]);
    double sum = 0.0;
    for (Index k = ends_.particles.offsets[tie]; k < ends_.particles.offsets[tie + 1]; ++k) {
      const std::size_t slot = static_cast<std::size_t>(ends_.particles.values[k]) * width_;
      double along = 0.0;
      for (std::size_t a = 0; a < dim_; ++a) along += n[a] * motion[slot + a];
      sum += ends_.weights[k] * along;
      if (ends_.strain_weights.empty()) continue;
      const Vector3 strain = strain_weights_of(k);
      for (std::size_t a = 0; a < dim_; ++a) sum += strain[a] * motion[slot + a];
    }
    return sum;
  }

  /// Returns half of intact force times extension between two steps [force length].
  double whole_energy(Index tie, double time_step, const BondMotion& motion) const {
    const double now = extension(tie, motion.displacement);
    const double before = now - time_step * extension(tie, motion.velocity);
    return 0.5 * network_.stiffness[elements_[tie]] * before * now;
  }

  void give_way(Share& share, double now, double time_step, const BondMotion& motion,
                BondLosses& losses) {
    const Index element = elements_[share.tie];
    do {
      share.limit = limit_of(element, ++share.segment);
    } while (std::abs(now) > share.limit);
    const double next = network_.law(element).segment(share.segment).secant;
    if (share.at_node) {
      if (next == 0.0) losses.broken.push_back(element);
      losses.fractured += (share.secant - next) * whole_energy(share.tie, time_step, motion);
    }
    share.secant = next;
  }

  const Network& network_;
  std::unique_ptr<ExplicitBonds> others_;
  std::size_t dim_, width_;
  std::vector<Index> elements_;  ///< number of each slip or contact spring
  /// per spring: its node, then the particles around its embedded point
  EmbeddedPoints ends_;
  std::vector<Index> offsets_;
  std::vector<Share> shares_;  ///< ordered by particle
};

}  // namespace

std::unique_ptr<ExplicitBonds> with_embedded_slip_springs(const Network& network,
                                                          std::unique_ptr<ExplicitBonds> others) {
  if (network.embedded_points.size() == 0) return others;
  return std::make_unique<EmbeddedSlipSprings>(network, std::move(others));
}

}  // namespace perilink
