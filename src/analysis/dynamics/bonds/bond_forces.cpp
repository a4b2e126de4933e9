#include "analysis/dynamics/bonds/bond_forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "analysis/dynamics/bonds/element_halves.hpp"
#include "analysis/dynamics/bonds/embedded_slip_springs.hpp"
#include "analysis/dynamics/bonds/stencil_bonds.hpp"
#include "analysis/dynamics/time_state.hpp"

namespace perilink {
namespace {

/// Events that the elements of a network can have.
enum class Limits {
  none,
  pulled,    ///< events come in tension only
  strained,  ///< events of some elements come in compression as well
  closing,   ///< as `strained`, and cracks of damaged elements may close
};

/// \tparam Half  TrussHalf, GreenHalf or FrameHalf
template <class Half>
class Halves final : public ExplicitBonds {
 public:
  Halves(const Network& network, const std::vector<Index>& elements);

  BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                    std::span<double> force) override;
  double stored(Index begin, Index end, double time_step, const BondMotion& motion) const override;
  std::vector<double> secants() const override;
  void save(MovingElements& state) const override;
  void restore(const MovingElements& state) override;

 private:
  static constexpr int width = Half::width;

  void add(const Network& network, Index element, bool first);
  template <Limits Kind>
  BondLosses forces_of(Index begin, Index end, double time_step, const BondMotion& motion,
                       std::span<double> force);
  double limit_of(Index element, int segment) const;
  void scale(std::size_t half, double factor) {
    halves_[half].for_stiffness([factor](double& modulus) { modulus *= factor; });
  }
  bool may_close(std::size_t half) const;
  Half closed_part(std::size_t half) const;
  void give_way(std::size_t half, double demand, const double* own, const double* own_speed,
                const BondMotion& motion, double time_step, BondLosses& losses);
  void before(const double* now, const double* speed, double time_step, double* past) const;

  const Network& network_;
  Limits limits_ = Limits::none;
  std::vector<std::size_t> offsets_;
  std::vector<Half> halves_;
  std::vector<Index> element_;
  std::vector<double> limit_;   ///< limit of Half::demand() of the present segment
  std::vector<double> secant_;  ///< secant stiffness ratio
  std::vector<int> segment_;
  std::vector<std::uint8_t> both_;  ///< Sense::both
};

template <class Half>
Halves<Half>::Halves(const Network& network, const std::vector<Index>& elements)
    : network_(network) {
  const Index count = network.particles.size();
  std::vector<std::vector<std::pair<Index, bool>>> of_particle(count);
  for (const Index e : elements) {
    of_particle[network.bonds.first[e]].emplace_back(e, true);
    of_particle[network.bonds.second[e]].emplace_back(e, false);
  }
  offsets_.push_back(0);
  for (const auto& own : of_particle) {
    for (const auto& [element, first] : own) add(network, element, first);
    offsets_.push_back(halves_.size());
  }
  for (std::size_t half = 0; half < limit_.size(); ++half) {
    if (std::isinf(limit_[half])) continue;
    limits_ = std::max(limits_, both_[half] ? Limits::strained : Limits::pulled);
  }
  if (network.has_closing()) limits_ = Limits::closing;
}

/// Returns whether an element is damaged and regains axial stiffness in compression (crack
/// closure).
template <class Half>
bool Halves<Half>::may_close(std::size_t half) const {
  return secant_[half] < 1.0 && network_.law(element_[half]).closes();
}

template <class Half>
Half Halves<Half>::closed_part(std::size_t half) const {
  return halves_[half].axial_part(network_.stiffness[element_[half]] * (1.0 - secant_[half]));
}

template <class Half>
void Halves<Half>::add(const Network& network, Index element, bool first) {
  halves_.emplace_back(network, element, first);
  element_.push_back(element);
  secant_.push_back(1.0);
  segment_.push_back(0);
  both_.push_back(network.law(element).sense() == Sense::both);
  limit_.push_back(limit_of(element, 0));
}

/// Returns the limit of a segment in units of Half::demand().
template <class Half>
double Halves<Half>::limit_of(Index element, int segment) const {
  return Half::limit_of_demand(
      network_.critical_stretch_of(element) * network_.law(element).segment(segment).limit,
      network_.bonds.length(element));
}

template <class Half>
void Halves<Half>::before(const double* now, const double* speed, double time_step,
                          double* past) const {
  for (int c = 0; c < width; ++c) past[c] = now[c] - time_step * speed[c];
}

/// Moves the element to the segment that resists the demand, or breaks it.
template <class Half>
void Halves<Half>::give_way(std::size_t half, double demand, const double* own,
                            const double* own_speed, const BondMotion& motion, double time_step,
                            BondLosses& losses) {
  const Half& bond = halves_[half];
  const std::size_t other = static_cast<std::size_t>(bond.other) * width;
  const double* far = motion.displacement.data() + other;
  const Index element = element_[half];
  do {
    limit_[half] = limit_of(element, ++segment_[half]);
  } while (demand > limit_[half]);
  const double next = network_.law(element).segment(segment_[half]).secant;
  if (next == 0.0) losses.broken.push_back(element);
  double past_own[width], past_far[width];
  before(own, own_speed, time_step, past_own);
  before(far, motion.velocity.data() + other, time_step, past_far);
  const double held = bond.energy(past_own, past_far, own, far);
  scale(half, next / secant_[half]);
  losses.fractured += 0.5 * (held - bond.energy(past_own, past_far, own, far));
  secant_[half] = next;
}

template <class Half>
template <Limits Kind>
BondLosses Halves<Half>::forces_of(Index begin, Index end, double time_step,
                                   const BondMotion& motion, std::span<double> force) {
  BondLosses losses;
  const double* u = motion.displacement.data();
  for (Index i = begin; i < end; ++i) {
    const std::size_t slot = static_cast<std::size_t>(i) * width;
    const double* own = u + slot;
    double sum[width] = {};
    for (std::size_t half = offsets_[i]; half < offsets_[i + 1]; ++half) {
      const Half& bond = halves_[half];
      const double* far = u + static_cast<std::size_t>(bond.other) * width;
      double demand = bond.add_force(own, far, sum);
      if constexpr (Kind == Limits::none) continue;
      if constexpr (Kind == Limits::closing) {
        if (may_close(half) && bond.is_compressed(own, far)) {
          closed_part(half).add_force(own, far, sum);
        }
      }
      if constexpr (Kind >= Limits::strained) {
        if (both_[half]) demand = bond.size(own, far);
      }
      if (demand <= limit_[half]) continue;
      bond.add_force(own, far, sum, -1.0);
      give_way(half, demand, own, motion.velocity.data() + slot, motion, time_step, losses);
      bond.add_force(own, far, sum);
    }
    for (int c = 0; c < width; ++c) force[slot + c] = sum[c];
  }
  return losses;
}

template <class Half>
BondLosses Halves<Half>::forces(Index begin, Index end, double time_step, const BondMotion& motion,
                                std::span<double> force) {
  switch (limits_) {
    case Limits::none: return forces_of<Limits::none>(begin, end, time_step, motion, force);
    case Limits::pulled: return forces_of<Limits::pulled>(begin, end, time_step, motion, force);
    case Limits::strained: return forces_of<Limits::strained>(begin, end, time_step, motion, force);
    case Limits::closing: break;
  }
  return forces_of<Limits::closing>(begin, end, time_step, motion, force);
}

template <class Half>
double Halves<Half>::stored(Index begin, Index end, double time_step,
                            const BondMotion& motion) const {
  double energy = 0.0;
  for (Index i = begin; i < end; ++i) {
    const std::size_t slot = static_cast<std::size_t>(i) * width;
    double past_own[width], past_far[width];
    const double* own = motion.displacement.data() + slot;
    before(own, motion.velocity.data() + slot, time_step, past_own);
    for (std::size_t half = offsets_[i]; half < offsets_[i + 1]; ++half) {
      const std::size_t other = static_cast<std::size_t>(halves_[half].other) * width;
      const double* far = motion.displacement.data() + other;
      before(far, motion.velocity.data() + other, time_step, past_far);
      energy += 0.5 * halves_[half].energy(past_own, past_far, own, far);
      if (limits_ != Limits::closing || !may_close(half)) continue;
      if (!halves_[half].is_compressed(own, far)) continue;
      if (!halves_[half].is_compressed(past_own, past_far)) continue;
      energy += 0.5 * closed_part(half).energy(past_own, past_far, own, far);
    }
  }
  return energy;
}

template <class Half>
std::vector<double> Halves<Half>::secants() const {
  std::vector<double> result(static_cast<std::size_t>(network_.num_elements()), 1.0);
  for (std::size_t half = 0; half < halves_.size(); ++half) {
    double& secant = result[element_[half]];
    secant = std::min(secant, secant_[half]);  // the other half may belong to another rank
  }
  return result;
}

/// Saves stiffnesses too: they are products of the ratios of all segments that a bond has left.
template <class Half>
void Halves<Half>::save(MovingElements& state) const {
  for (std::size_t half = 0; half < segment_.size(); ++half) {
    if (segment_[half] == 0) continue;
    state.changed.push_back(half);
    state.segment.push_back(segment_[half]);
    Half(halves_[half]).for_stiffness([&](double modulus) { state.stiffness.push_back(modulus); });
  }
}

template <class Half>
void Halves<Half>::restore(const MovingElements& state) {
  std::size_t moduli = 0;
  for (std::size_t k = 0; k < state.changed.size(); ++k) {
    const std::size_t half = state.changed[k];
    if (half >= halves_.size()) expect_equal_sizes(half + 1, halves_.size());
    segment_[half] = state.segment.at(k);
    limit_[half] = limit_of(element_[half], segment_[half]);
    secant_[half] = network_.law(element_[half]).segment(segment_[half]).secant;
    halves_[half].for_stiffness([&](double& modulus) { modulus = state.stiffness.at(moduli++); });
  }
}

template <template <int> class Half>
std::unique_ptr<ExplicitBonds> make_halves(const Network& network,
                                           const std::vector<Index>& elements) {
  if (network.dim() == 2) return std::make_unique<Halves<Half<2>>>(network, elements);
  return std::make_unique<Halves<Half<3>>>(network, elements);
}

}  // namespace

std::unique_ptr<ExplicitBonds> make_explicit_halves(const Network& network, Strain strain) {
  if (network.has_states()) {
    throw std::invalid_argument("state-based particles need make_explicit_particles()");
  }
  std::vector<Index> all(static_cast<std::size_t>(network.num_elements()));
  std::iota(all.begin(), all.end(), 0);
  std::erase_if(all, [&](Index e) { return network.is_embedded(e); });
  const auto complete = [&](std::unique_ptr<ExplicitBonds> halves) {
    return with_embedded_slip_springs(network, std::move(halves));
  };
  if (network.carries_moments()) {
    if (strain == Strain::green) {
      throw std::invalid_argument("bonds that carry moments support small strains only");
    }
    return complete(make_halves<FrameHalf>(network, all));
  }
  if (strain == Strain::green) return complete(make_halves<GreenHalf>(network, all));
  return complete(make_halves<TrussHalf>(network, all));
}

std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network, Strain strain) {
  return make_explicit_bonds(network, strain, stencil_for(network, strain));
}

BondStencil stencil_for(const Network& network, Strain strain) {
  if (network.has_states() || network.carries_moments() || strain == Strain::green) return {};
  return find_stencil(network);
}

std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network, Strain strain,
                                                   BondStencil stencil) {
  if (stencil.kinds.empty()) return make_explicit_halves(network, strain);
  std::unique_ptr<ExplicitBonds> rest;
  if (!stencil.rest.empty()) rest = make_halves<TrussHalf>(network, stencil.rest);
  rest = make_stencil_bonds(network, std::move(stencil), std::move(rest));
  return with_embedded_slip_springs(network, std::move(rest));
}

}  // namespace perilink
