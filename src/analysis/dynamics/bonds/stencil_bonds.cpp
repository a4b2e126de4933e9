#include "analysis/dynamics/bonds/stencil_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "analysis/dynamics/bonds/lanes.hpp"
#include "analysis/dynamics/time_state.hpp"

namespace perilink {
namespace {

constexpr int lanes = BondStencil::lanes;
static_assert(lanes % num_lanes == 0);  // a register holds a group or a part of it

/// Limit of unbreakable bonds [-]. A group that reaches it costs one needless check.
constexpr double stretch_of_unbreakable = 1e6;

/// Constants of a line for the loop over its lanes. The demand e of a bond is its extension over
/// its limit; its force is V_i V_j pull e.
template <int Dim>
struct Line {
  double demand[Dim];  ///< direction over limit [1/length]
  double pull[Dim];    ///< direction times modulus times limit [force/length^6]
  std::ptrdiff_t out, in;
};

/// Constants for the losses of a kind of bonds.
struct KindConstants {
  double stiffness;  ///< factor of the demand, k limit^2 / (V_i V_j) [force/length^5]
  bool breaks;
};

template <int Dim>
class StencilBonds final : public ExplicitBonds {
 public:
  StencilBonds(const Network& network, BondStencil stencil, std::unique_ptr<ExplicitBonds> rest);

  BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                    std::span<double> force) override;
  double stored(Index begin, Index end, double time_step, const BondMotion& motion) const override;
  std::vector<double> secants() const override;
  void save(MovingElements& state) const override {
    state.intact = intact_;
    if (rest_) rest_->save(state);
  }
  void restore(const MovingElements& state) override {
    expect_equal_sizes(state.intact.size(), intact_.size());
    intact_ = state.intact;
    if (rest_) rest_->restore(state);
  }

 private:
  /// Directed bond of a particle of a group.
  struct Half {
    const Line<Dim>* line;
    const KindConstants* kind;
    Index first, second;  ///< particles
    std::size_t slot;
  };

  static std::uint8_t bit(std::size_t slot) {
    return static_cast<std::uint8_t>(1U << (slot % lanes));
  }
  bool is_intact(std::size_t slot) const { return (intact_[slot / lanes] & bit(slot)) != 0; }

  template <bool Safe>
  bool add_lines(std::size_t group, int part, const double* u, Doubles* sum) const;
  template <bool Safe, int Components>
  void take(const double* from, std::ptrdiff_t particle, Doubles* to) const;
  template <bool Safe>
  void demands(const Line<Dim>& line, std::ptrdiff_t first, int part, const std::uint8_t* intact,
               const double* u, const Doubles* own, Doubles& out, Doubles& in) const;
  void add_energies(std::size_t group, int part, double time_step, const BondMotion& motion,
                    Doubles& sum) const;
  template <class Visit>
  void for_halves(std::size_t group, Index begin, Index end, Visit visit) const;
  double demand(const Half& half, const double* u) const;
  double energy(const Half& half, double time_step, const BondMotion& motion) const;
  BondLosses break_halves(std::size_t group, Index begin, Index end, double time_step,
                          const BondMotion& motion);

  std::unique_ptr<ExplicitBonds> rest_;
  Index particles_, elements_;
  std::vector<double> volume_;
  std::vector<std::vector<Line<Dim>>> patterns_;
  std::vector<std::vector<KindConstants>> kinds_;  ///< per pattern, one for each of its lines
  std::vector<BondStencil::Group> groups_;
  std::vector<Index> element_;
  std::vector<std::uint8_t> intact_;   ///< one bit per slot: the bond exists and is intact
  std::vector<std::uint8_t> is_safe_;  ///< all lanes of all lines of a group lead to particles
};

template <int Dim>
StencilBonds<Dim>::StencilBonds(const Network& network, BondStencil stencil,
                                std::unique_ptr<ExplicitBonds> rest)
    : rest_(std::move(rest)),
      particles_(network.particles.size()),
      elements_(network.num_elements()),
      volume_(network.particles.volumes),
      groups_(std::move(stencil.groups)),
      element_(std::move(stencil.element)) {
  for (const std::vector<StencilLine>& lines : stencil.patterns) {
    auto& pattern = patterns_.emplace_back();
    auto& constants = kinds_.emplace_back();
    for (const StencilLine& from : lines) {
      const BondKind& kind = stencil.kinds[from.kind];
      const bool breaks = !std::isinf(kind.limit);
      const double scale = breaks ? kind.limit : stretch_of_unbreakable * kind.length;
      Line<Dim>& line = pattern.emplace_back();
      line.out = from.out;
      line.in = from.in;
      for (int c = 0; c < Dim; ++c) {
        line.demand[c] = kind.direction[c] / scale;
        line.pull[c] = kind.direction[c] * kind.modulus * scale;
      }
      constants.push_back({kind.modulus * scale * scale, breaks});
    }
  }
  intact_.assign(element_.size() / lanes, 0);
  for (std::size_t slot = 0; slot < element_.size(); ++slot) {
    if (element_[slot] != no_index) intact_[slot / lanes] |= bit(slot);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(g) * lanes, past = first + lanes;
    bool safe = past <= particles_;
    for (const Line<Dim>& line : patterns_[groups_[g].pattern]) {
      safe &= first - line.in >= 0 && past - line.in <= particles_;
      safe &= first + line.out >= 0 && past + line.out <= particles_;
    }
    is_safe_.push_back(safe);
  }
}

/// Returns the components of the particle and of the next ones. If not Safe, positions outside the
/// body take the first or last particle; no bond leads to them.
template <int Dim>
template <bool Safe, int Components>
[[gnu::always_inline]] inline void StencilBonds<Dim>::take(const double* from,
                                                           std::ptrdiff_t particle,
                                                           Doubles* to) const {
  if (Safe || (particle >= 0 && particle + num_lanes <= particles_)) {
    load_vectors<Components>(from + particle * Components, to);
    return;
  }
  double picked[Components][num_lanes];
  for (std::ptrdiff_t lane = 0; lane < num_lanes; ++lane) {
    const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(particle + lane, 0, particles_ - 1);
    for (int c = 0; c < Components; ++c) picked[c][lane] = from[at * Components + c];
  }
  for (int c = 0; c < Components; ++c) load(picked[c], to[c]);
}

/// Computes the demands of a line's outgoing and incoming bonds, zero for absent bonds. Both are
/// measured from the first end, so that both halves of a bond find one number.
/// \param first  first particle of the part, at this position in its group
/// \param u      motion of all particles; `own` holds the particles of the part
template <int Dim>
template <bool Safe>
[[gnu::always_inline]] inline void StencilBonds<Dim>::demands(const Line<Dim>& line,
                                                              std::ptrdiff_t first, int part,
                                                              const std::uint8_t* intact,
                                                              const double* u, const Doubles* own,
                                                              Doubles& out, Doubles& in) const {
  Doubles far[Dim], near[Dim];
  take<Safe, Dim>(u, first + line.out, far);
  take<Safe, Dim>(u, first - line.in, near);
  out = line.demand[0] * (far[0] - own[0]);
  in = line.demand[0] * (own[0] - near[0]);
  for (int c = 1; c < Dim; ++c) {
    out += line.demand[c] * (far[c] - own[c]);
    in += line.demand[c] * (own[c] - near[c]);
  }
  keep_lanes(static_cast<std::uint8_t>(intact[0] >> part), out);
  keep_lanes(static_cast<std::uint8_t>(intact[1] >> part), in);
}

/// Computes the forces of the bonds of a part of the group, not yet times the own volume.
/// \return whether a bond exceeds its limit
template <int Dim>
template <bool Safe>
bool StencilBonds<Dim>::add_lines(std::size_t group, int part, const double* u,
                                  Doubles* sum) const {
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(group) * lanes + part;
  const std::uint8_t* intact = intact_.data() + groups_[group].first_slot / lanes;
  Doubles own[Dim], total[Dim], largest{};
  take<Safe, Dim>(u, first, own);
  for (int c = 0; c < Dim; ++c) total[c] = Doubles{};
  for (const Line<Dim>& line : patterns_[groups_[group].pattern]) {
    Doubles out, in, far_volume, near_volume;
    demands<Safe>(line, first, part, intact, u, own, out, in);
    take<Safe, 1>(volume_.data(), first + line.out, &far_volume);
    take<Safe, 1>(volume_.data(), first - line.in, &near_volume);
    intact += 2;
    keep_larger(out, largest);
    keep_larger(in, largest);
    const Doubles pulled = near_volume * in - far_volume * out;
    for (int c = 0; c < Dim; ++c) total[c] += line.pull[c] * pulled;
  }
  for (int c = 0; c < Dim; ++c) sum[c] = total[c];
  bool exceeds = false;
  for (int lane = 0; lane < num_lanes; ++lane) exceeds |= largest[lane] > 1.0;
  return exceeds;
}

/// Calls visit(half) for every intact directed bond at the particles [begin, end) of a group.
template <int Dim>
template <class Visit>
void StencilBonds<Dim>::for_halves(std::size_t group, Index begin, Index end, Visit visit) const {
  const int pattern = groups_[group].pattern;
  std::size_t slot = groups_[group].first_slot;
  for (std::size_t l = 0; l < patterns_[pattern].size(); ++l) {
    const Line<Dim>& line = patterns_[pattern][l];
    for (const bool incoming : {false, true}) {
      for (int lane = 0; lane < lanes; ++lane, ++slot) {
        const Index own = static_cast<Index>(group) * lanes + lane;
        if (!is_intact(slot) || own < begin || own >= end) continue;
        const Index other = static_cast<Index>(incoming ? own - line.in : own + line.out);
        visit(
            Half{&line, &kinds_[pattern][l], incoming ? other : own, incoming ? own : other, slot});
      }
    }
  }
}

/// Returns bit for bit the demand of add_lines(): no operations are fused there.
template <int Dim>
double StencilBonds<Dim>::demand(const Half& half, const double* u) const {
  const double* first = u + static_cast<std::size_t>(half.first) * Dim;
  const double* second = u + static_cast<std::size_t>(half.second) * Dim;
  double sum = half.line->demand[0] * (second[0] - first[0]);
  for (int c = 1; c < Dim; ++c) sum += half.line->demand[c] * (second[c] - first[c]);
  return sum;
}

/// Returns the energy of a directed bond between the displacements a step ago and now.
template <int Dim>
double StencilBonds<Dim>::energy(const Half& half, double time_step,
                                 const BondMotion& motion) const {
  const double now = demand(half, motion.displacement.data());
  const double before = now - time_step * demand(half, motion.velocity.data());
  const double volumes = volume_[half.first] * volume_[half.second];
  return 0.25 * half.kind->stiffness * volumes * before * now;
}

template <int Dim>
BondLosses StencilBonds<Dim>::break_halves(std::size_t group, Index begin, Index end,
                                           double time_step, const BondMotion& motion) {
  BondLosses losses;
  for_halves(group, begin, end, [&](const Half& half) {
    if (!half.kind->breaks || !(demand(half, motion.displacement.data()) > 1.0)) return;
    losses.fractured += energy(half, time_step, motion);
    losses.broken.push_back(element_[half.slot]);
    intact_[half.slot / lanes] &= static_cast<std::uint8_t>(~bit(half.slot));
  });
  return losses;
}

template <int Dim>
BondLosses StencilBonds<Dim>::forces(Index begin, Index end, double time_step,
                                     const BondMotion& motion, std::span<double> force) {
  BondLosses losses;
  if (rest_) {
    losses = rest_->forces(begin, end, time_step, motion, force);
  } else {
    std::fill(force.begin() + std::ptrdiff_t{begin} * Dim,
              force.begin() + std::ptrdiff_t{end} * Dim, 0.0);
  }
  const double* u = motion.displacement.data();
  for (Index first = begin / num_lanes * num_lanes; first < end; first += num_lanes) {
    const Index g = first / lanes, part = first % lanes;
    const auto add = [&](Doubles* sum) {
      return is_safe_[g] ? add_lines<true>(g, part, u, sum) : add_lines<false>(g, part, u, sum);
    };
    Doubles sum[Dim];
    if (add(sum)) {
      const BondLosses lost = break_halves(g, begin, end, time_step, motion);
      losses.fractured += lost.fractured;
      losses.broken.insert(losses.broken.end(), lost.broken.begin(), lost.broken.end());
      add(sum);
    }
    for (Index i = std::max(first, begin); i < std::min(first + num_lanes, end); ++i) {
      for (int c = 0; c < Dim; ++c) {
        force[static_cast<std::size_t>(i) * Dim + c] += volume_[i] * sum[c][i - first];
      }
    }
  }
  return losses;
}

/// Adds the energies of the directed bonds of each particle in a part of the group, equal to
/// energy() of each.
template <int Dim>
void StencilBonds<Dim>::add_energies(std::size_t group, int part, double time_step,
                                     const BondMotion& motion, Doubles& sum) const {
  const int pattern = groups_[group].pattern;
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(group) * lanes + part;
  const std::uint8_t* intact = intact_.data() + groups_[group].first_slot / lanes;
  const double *u = motion.displacement.data(), *v = motion.velocity.data();
  Doubles own[Dim], own_speed[Dim], own_volume;
  take<false, Dim>(u, first, own);
  take<false, Dim>(v, first, own_speed);
  take<false, 1>(volume_.data(), first, &own_volume);
  for (std::size_t l = 0; l < patterns_[pattern].size(); ++l, intact += 2) {
    const Line<Dim>& line = patterns_[pattern][l];
    Doubles out, in, out_rate, in_rate, far_volume, near_volume;
    demands<false>(line, first, part, intact, u, own, out, in);
    demands<false>(line, first, part, intact, v, own_speed, out_rate, in_rate);
    take<false, 1>(volume_.data(), first + line.out, &far_volume);
    take<false, 1>(volume_.data(), first - line.in, &near_volume);
    sum += 0.25 * kinds_[pattern][l].stiffness * own_volume *
           (far_volume * out * (out - time_step * out_rate) +
            near_volume * in * (in - time_step * in_rate));
  }
}

template <int Dim>
double StencilBonds<Dim>::stored(Index begin, Index end, double time_step,
                                 const BondMotion& motion) const {
  double energy = rest_ ? rest_->stored(begin, end, time_step, motion) : 0.0;
  for (Index first = begin / num_lanes * num_lanes; first < end; first += num_lanes) {
    Doubles sum{};
    add_energies(first / lanes, first % lanes, time_step, motion, sum);
    for (Index i = std::max(first, begin); i < std::min(first + num_lanes, end); ++i) {
      energy += sum[i - first];
    }
  }
  return energy;
}

template <int Dim>
std::vector<double> StencilBonds<Dim>::secants() const {
  std::vector<double> result =
      rest_ ? rest_->secants() : std::vector<double>(static_cast<std::size_t>(elements_));
  const auto set = [&](double secant, auto applies) {
    for (std::size_t slot = 0; slot < element_.size(); ++slot) {
      if (element_[slot] != no_index && applies(slot)) result[element_[slot]] = secant;
    }
  };
  set(1.0, [](std::size_t) { return true; });
  set(0.0, [&](std::size_t slot) { return !is_intact(slot); });  // one broken half is enough
  return result;
}

}  // namespace

std::unique_ptr<ExplicitBonds> make_stencil_bonds(const Network& network, BondStencil stencil,
                                                  std::unique_ptr<ExplicitBonds> rest) {
  if (network.dim() == 2) {
    return std::make_unique<StencilBonds<2>>(network, std::move(stencil), std::move(rest));
  }
  return std::make_unique<StencilBonds<3>>(network, std::move(stencil), std::move(rest));
}

}  // namespace perilink
