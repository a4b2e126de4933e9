#include "analysis/dynamics/bonds/state_particles.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "analysis/dynamics/bonds/element_halves.hpp"
#include "analysis/dynamics/bonds/particle_fit.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "base/plain_text.hpp"
#include "material/principal_values.hpp"

namespace perilink {
namespace {

/// Directed bond at one of its ends.
template <int Dim>
struct StateHalf : TrussHalf<Dim> {
  Index element;
  bool mine;    ///< counts in the sum of this end
  bool others;  ///< counts in the sum of the other end

  StateHalf(const Network& network, Index number, bool first)
      : TrussHalf<Dim>(network, number, first),
        element(number),
        mine(network.counts_for(number, first ? first_end : second_end)),
        others(network.counts_for(number, first ? second_end : first_end)) {}

  /// Extension of the bond of a particle in a field of shape (particles, Dim).
  double extension_in(const std::vector<double>& field, Index own) const {
    return this->extension(field.data() + own * std::size_t{Dim},
                           field.data() + this->other * std::size_t{Dim});
  }
};

/// Damage factors of a bond: of its own force, and of its extension in the sums of this end and of
/// the other end (half_bond_weight).
struct HalfFactors {
  double bond = 1.0, mine = 1.0, other = 1.0;

  HalfFactors() = default;
  /// \param w_i  damage of this end
  HalfFactors(double w_i, double w_j)
      : bond(two_spring_factor(w_i, w_j)),
        mine(half_bond_weight(w_i, w_j)),
        other(half_bond_weight(w_j, w_i)) {}
  bool operator==(const HalfFactors&) const = default;
};

/// Damage factors by the sign of the bond's extension.
struct SignedFactors {
  HalfFactors tension, compression;
  const HalfFactors& of(double extension) const { return extension >= 0.0 ? tension : compression; }
};

/// Returns the width of a square or cube with the particle's volume [length].
double band_of(const Particles& particles, Index i, double thickness) {
  const double volume = particles.volumes[i];
  return particles.dim == 2 ? std::sqrt(volume / thickness) : std::cbrt(volume);
}

template <int Dim>
class StateParticles final : public ExplicitBonds {
 public:
  StateParticles(const Network& network, Problem problem, std::span<const StateMaterial> materials,
                 double thickness);

  bool has_states() const override { return true; }
  BondLosses prepare(Index begin, Index end, double time_step, const BondMotion& motion) override;
  void finish_step() override { damage_.swap(next_); }
  BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                    std::span<double> force) override;
  double stored(Index begin, Index end, double time_step, const BondMotion& motion) const override;
  std::vector<double> secants() const override;
  std::vector<double> damage() const override { return damage_; }
  void save(MovingElements& state) const override {
    state.damage = damage_;
    state.last_damage = next_;
    state.cracked = cracked_;
  }
  void restore(const MovingElements& state) override;

 private:
  std::span<const StateHalf<Dim>> halves_of(Index i) const {
    return {halves_.data() + offsets_[i], halves_.data() + offsets_[i + 1]};
  }
  const HalfFactors& factors(std::size_t half, double extension) const {
    static constexpr HalfFactors intact{};
    return factors_.empty() ? intact : factors_[half].of(extension);
  }
  double compressive(Index i) const {
    return compressive_damage(damage_[i], material(i).compressive_threshold);
  }
  const StateMaterial& material(Index i) const {
    return materials_[network_.particles.material[i]];
  }
  const HookeConstants& hooke_of(Index i) const { return hooke_[network_.particles.material[i]]; }
  bool weaken(Index i);
  double half_energy(Index i, double time_step, const BondMotion& motion) const;
  void grow(Index i);
  bool is_calm(Index i) const;
  SymmetricTensor strain(Index i) const;

  const Network& network_;
  Problem problem_;
  std::vector<StateMaterial> materials_;
  std::vector<HookeConstants> hooke_;  ///< per material
  bool breakable_ = false;
  std::vector<std::size_t> offsets_{0};
  std::vector<StateHalf<Dim>> halves_;
  /// Per particle: sum of the weakened extensions of its neighbours' bonds.
  std::vector<double> sum_;
  std::vector<double> extension_;       ///< per directed bond; empty where bonds cannot break
  std::vector<SignedFactors> factors_;  ///< per directed bond; empty where bonds cannot break
  std::vector<double> damage_, next_;
  std::vector<double> band_;  ///< width of the crack band [length]
  std::vector<std::uint8_t> cracked_;
  std::vector<double> calm_;  ///< extension below which a crack cannot begin [length]
  ParticleStrains<Dim> strains_;
};

template <int Dim>
StateParticles<Dim>::StateParticles(const Network& network, Problem problem,
                                    std::span<const StateMaterial> materials, double thickness)
    : network_(network),
      problem_(problem),
      materials_(materials.begin(), materials.end()),
      sum_(static_cast<std::size_t>(network.particles.size()), 0.0),
      damage_(sum_.size(), 0.0),
      next_(sum_.size(), 0.0) {
  for (const StateMaterial& each : materials) {
    hooke_.push_back(hooke_constants(problem, each.youngs_modulus, each.poissons_ratio));
  }
  breakable_ = std::any_of(materials.begin(), materials.end(),
                           [](const StateMaterial& each) { return each.breakable; });
  const Bonds& bonds = network.bonds;
  const Csr around = bonds_of_particles(bonds, network.particles.size());
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (const Index e : around.row(i)) halves_.emplace_back(network, e, bonds.first[e] == i);
    offsets_.push_back(halves_.size());
  }
  if (!breakable_) return;
  extension_.assign(halves_.size(), 0.0);
  factors_.assign(halves_.size(), {});
  cracked_.assign(sum_.size(), 0);
  check_bands(network.particles, materials, thickness);
  for (Index i = 0; i < network.particles.size(); ++i) {
    band_.push_back(band_of(network.particles, i, thickness));
    strains_.add(halves_of(i), bonds);
    const HookeConstants& hooke = hooke_of(i);
    // Damage of neighbours at most doubles a share.
    calm_.push_back(material(i).softening.strength /
                    (2.0 * (std::abs(hooke.lambda) + 2.0 * hooke.mu) * strains_.largest_strain(i)));
  }
}

/// Updates the factors of a particle's bonds from the damage of their ends. \return whether a
/// factor changed
template <int Dim>
bool StateParticles<Dim>::weaken(Index i) {
  bool any = false;
  for (std::size_t h = offsets_[i]; h < offsets_[i + 1]; ++h) {
    const Index j = halves_[h].other;
    if (damage_[i] == 0.0 && damage_[j] == 0.0) continue;
    const SignedFactors fresh{{damage_[i], damage_[j]}, {compressive(i), compressive(j)}};
    any =
        any || fresh.tension != factors_[h].tension || fresh.compression != factors_[h].compression;
    factors_[h] = fresh;
  }
  return any;
}

/// Returns u_(n-1)' K u_n / 2 of a particle's directed bonds and its state [force length].
template <int Dim>
double StateParticles<Dim>::half_energy(Index i, double time_step, const BondMotion& motion) const {
  double energy = 0.0, now = 0.0, before = 0.0;
  for (std::size_t h = offsets_[i]; h < offsets_[i + 1]; ++h) {
    const StateHalf<Dim>& half = halves_[h];
    const double e = half.extension_in(motion.displacement, i);
    const double past = e - time_step * half.extension_in(motion.velocity, i);
    const HalfFactors& factor = factors(h, e);
    energy += 0.25 * half.k * factor.bond * e * past;
    if (!half.mine) continue;
    now += factor.mine * e;
    before += factor.mine * past;
  }
  return energy + 0.5 * network_.states->stiffness[i] * now * before;
}

template <int Dim>
SymmetricTensor StateParticles<Dim>::strain(Index i) const {
  return strains_.fit(i, halves_of(i), [&](std::size_t k) {
    const std::size_t h = offsets_[i] + k;
    const double e = extension_[h];
    const Index j = halves_[h].other;
    const double share = e >= 0.0 ? half_bond_share(damage_[i], damage_[j])
                                  : half_bond_share(compressive(i), compressive(j));
    return share * e;
  });
}

/// Returns whether all extensions are too small for a crack to begin.
template <int Dim>
bool StateParticles<Dim>::is_calm(Index i) const {
  if (cracked_[i] != 0) return false;
  double largest = 0.0;
  for (std::size_t h = offsets_[i]; h < offsets_[i + 1]; ++h) {
    if (halves_[h].mine) largest = std::max(largest, std::abs(extension_[h]));
  }
  return largest < calm_[i];
}

template <int Dim>
void StateParticles<Dim>::grow(Index i) {
  next_[i] = damage_[i];
  const StateMaterial& own = material(i);
  if (!own.breakable || damage_[i] >= 1.0 || is_calm(i)) return;
  const SymmetricTensor fitted = strain(i);
  const PrincipalValues values = principal_values(fitted, Dim);
  const HookeConstants& hooke = hooke_of(i);
  const double spherical = hooke.lambda * (fitted[0] + fitted[1] + fitted[2]);
  const double first = spherical + 2.0 * hooke.mu * values.first;
  if (cracked_[i] == 0) {
    const double last = spherical + 2.0 * hooke.mu * values.last;
    const double normal =
        problem_ == Problem::plane_stress ? 0.0 : spherical + 2.0 * hooke.mu * fitted[2];
    if (!begins_crack(own.softening, first, std::min(last, normal))) return;
    cracked_[i] = 1;
  }
  const double damage =
      band_damage(own.softening, own.youngs_modulus, first / own.youngs_modulus, band_[i]);
  next_[i] = std::max(damage_[i], damage);
}

template <int Dim>
BondLosses StateParticles<Dim>::prepare(Index begin, Index end, double time_step,
                                        const BondMotion& motion) {
  BondLosses losses;
  for (Index i = begin; i < end; ++i) {
    if (breakable_) {
      const bool stirred =
          std::any_of(halves_.begin() + offsets_[i], halves_.begin() + offsets_[i + 1],
                      [&](const StateHalf<Dim>& half) { return damage_[half.other] > 0.0; });
      if (stirred || damage_[i] > 0.0) {
        const double before = half_energy(i, time_step, motion);
        if (weaken(i)) losses.fractured += before - half_energy(i, time_step, motion);
      }
    }
    double sum = 0.0;
    for (std::size_t h = offsets_[i]; h < offsets_[i + 1]; ++h) {
      const double e = halves_[h].extension_in(motion.displacement, i);
      if (breakable_) extension_[h] = e;
      if (halves_[h].mine) sum += factors(h, e).mine * e;
    }
    sum_[i] = sum;
    if (!breakable_) continue;
    grow(i);
    if (damage_[i] == 0.0 && next_[i] > 0.0) losses.broken.push_back(i);
  }
  return losses;
}

template <int Dim>
BondLosses StateParticles<Dim>::forces(Index begin, Index end, double /*time_step*/,
                                       const BondMotion& motion, std::span<double> force) {
  for (Index i = begin; i < end; ++i) {
    double inner[Dim] = {};
    const double own = network_.states->stiffness[i] * sum_[i];
    for (std::size_t h = offsets_[i]; h < offsets_[i + 1]; ++h) {
      const StateHalf<Dim>& half = halves_[h];
      const double e = half.extension_in(motion.displacement, i);
      const HalfFactors& factor = factors(h, e);
      double pull = factor.bond * half.k * e;
      if (half.mine) pull += factor.mine * own;
      if (half.others) {
        pull += factor.other * network_.states->stiffness[half.other] * sum_[half.other];
      }
      for (int c = 0; c < Dim; ++c) inner[c] -= pull * half.n[c];
    }
    for (int c = 0; c < Dim; ++c) force[i * std::size_t{Dim} + c] = inner[c];
  }
  return {};
}

template <int Dim>
double StateParticles<Dim>::stored(Index begin, Index end, double time_step,
                                   const BondMotion& motion) const {
  double energy = 0.0;
  for (Index i = begin; i < end; ++i) energy += half_energy(i, time_step, motion);
  return energy;
}

/// The upper end gives the factor, because the ends differ by round-off.
template <int Dim>
std::vector<double> StateParticles<Dim>::secants() const {
  std::vector<double> secants(static_cast<std::size_t>(network_.num_elements()), 1.0);
  for (std::size_t h = 0; h < factors_.size(); ++h)
    secants[halves_[h].element] = factors_[h].tension.bond;
  return secants;
}

/// The factors are those of the damage in the last step.
template <int Dim>
void StateParticles<Dim>::restore(const MovingElements& state) {
  expect_equal_sizes(state.damage.size(), damage_.size());
  expect_equal_sizes(state.last_damage.size(), next_.size());
  expect_equal_sizes(state.cracked.size(), cracked_.size());
  damage_ = state.last_damage;
  for (Index i = 0; i < network_.particles.size(); ++i) weaken(i);
  damage_ = state.damage;
  next_ = state.last_damage;
  cracked_ = state.cracked;
}

}  // namespace

void check_bands(const Particles& particles, std::span<const StateMaterial> materials,
                 double thickness) {
  for (Index i = 0; i < particles.size(); ++i) {
    const StateMaterial& own = materials[particles.material[i]];
    if (!own.breakable) continue;
    const double band = band_of(particles, i, thickness);
    const double limit = max_band_width(own.softening, own.youngs_modulus);
    if (band < limit) continue;
    throw std::invalid_argument(
        fmt::format("the particle at ({}) has a crack band {:.4g} wide, too wide for the "
                    "softening: a crack would release more energy than its opening dissipates; "
                    "place particles less than {:.4g} apart",
                    joined(particles.position(i)), band, limit));
  }
}

std::unique_ptr<ExplicitBonds> make_explicit_particles(const Network& network, Problem problem,
                                                       std::span<const StateMaterial> materials,
                                                       double thickness) {
  if (network.dim() == 2) {
    return std::make_unique<StateParticles<2>>(network, problem, materials, thickness);
  }
  return std::make_unique<StateParticles<3>>(network, problem, materials, thickness);
}

}  // namespace perilink
