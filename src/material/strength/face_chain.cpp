#include "material/strength/face_chain.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// Bonds whose ratios differ by less are symmetry-equivalent and have their events together.
constexpr double alike = 1e-9;

/// Smallest squared ratio of axial to equivalent stretch that counts as tension, as in the event
/// search.
constexpr double least_tension = 1e-12;

/// Heights closer than this times the longest bond are equal. Lattices with more layers within the
/// horizon than most_layers are rejected.
constexpr double same_height = 1e-6;
constexpr int most_layers = 12;

/// Layers on either side that may deviate from the uniform strain, in multiples of the longest
/// bond.
constexpr int depth = 3;

/// Terms of the energy (normal g^2 + 2 both g t + across t^2) / 2 of a bond of unit weight. The
/// strains are g along the normal and t across it.
struct Terms {
  double normal, both, across;
};

Terms terms_of(const LayerBond& bond) {
  const double n = bond.cosine * bond.cosine, t = 1.0 - n, r = bond.shear_ratio;
  return {(1.0 - r) * n * n + r * n, (1.0 - r) * n * t, (1.0 - r) * t * t + r * t};
}

/// A bond across the face.
struct Crossing {
  std::size_t bond;
  int lower;  ///< number of its lower layer
  double secant = 1.0;
  int segment = 0;
};

/// Layers numbered from 0, with the face in the middle. Layers below 0 follow the uniform strain;
/// layers above the last also move by the last unknown.
class Chain {
 public:
  Chain(std::span<const LayerBond> bonds, std::array<double, 2> sides) : bonds_(bonds) {
    int longest = 0;
    Terms sum{};
    for (const LayerBond& bond : bonds) {
      const Terms terms = terms_of(bond);
      terms_.push_back(terms);
      sum.normal += bond.weight * terms.normal;
      sum.both += bond.weight * terms.both;
      sum.across += bond.weight * terms.across;
      longest = std::max(longest, bond.layers);
    }
    // Strains at unit stress; both sides contract equally.
    const double modulus = sum.normal - sum.both * sum.both / sum.across;
    across_ = -sum.both / sum.across / modulus;
    for (int side = 0; side < 2; ++side) {
      strain_[side] = (1.0 / sides[side] - sum.both * across_) / sum.normal;
    }
    half_ = depth * longest;
    stiffness_ = Eigen::MatrixXd::Zero(2 * half_ + 1, 2 * half_ + 1);
    force_ = Eigen::VectorXd::Zero(2 * half_ + 1);
    force_[2 * half_] = 1.0;
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      if (bonds[b].cosine == 0.0) continue;
      for (int lower = -bonds[b].layers; lower < 2 * half_; ++lower) {
        const bool crosses = lower < half_ && lower + bonds[b].layers >= half_;
        if (crosses) {
          crossing_.push_back({b, lower});
        } else {
          add(b, lower, sides[lower < half_ ? 0 : 1], stiffness_, force_);
        }
      }
    }
  }

  std::vector<Crossing>& crossing() { return crossing_; }

  /// Computes the motion at unit stress. \return false if the face has failed
  bool solve() {
    Eigen::MatrixXd stiffness = stiffness_;
    Eigen::VectorXd force = force_;
    bool any = false;
    for (const Crossing& one : crossing_) {
      any = any || one.secant > 0.0;
      add(one.bond, one.lower, one.secant, stiffness, force);
    }
    if (!any) return false;
    const Eigen::LDLT<Eigen::MatrixXd> factor(stiffness);
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0)) return false;
    motion_ = factor.solve(force);
    return motion_.allFinite();
  }

  /// Returns the equivalent stretch, zero in compression.
  double stretch(const Crossing& one) const {
    const LayerBond& own = bonds_[one.bond];
    const double n = own.cosine * own.cosine;
    const double g = uniform(one.bond, one.lower) +
                     (moved(one.lower + own.layers) - moved(one.lower)) / own.layers;
    const double axial = g * n + across_ * (1.0 - n);
    const Terms& terms = terms_[one.bond];
    const double square =
        terms.normal * g * g + 2.0 * terms.both * g * across_ + terms.across * across_ * across_;
    return axial > 0.0 && axial * axial > least_tension * square ? std::sqrt(square) : 0.0;
  }

 private:
  int unknown(int layer) const { return layer < 0 ? -1 : std::min(layer, 2 * half_); }
  double moved(int layer) const { return layer < 0 ? 0.0 : motion_[unknown(layer)]; }
  /// Returns the strain along a bond from the uniform strains of both sides.
  double uniform(std::size_t b, int lower) const {
    const double from = lower - half_ + 0.5, to = from + bonds_[b].layers;
    const auto height = [&](double z) { return strain_[z < 0.0 ? 0 : 1] * z; };
    return (height(to) - height(from)) / bonds_[b].layers;
  }
  void add(std::size_t b, int lower, double factor, Eigen::MatrixXd& stiffness,
           Eigen::VectorXd& force) const {
    const LayerBond& own = bonds_[b];
    const double weight = factor * own.weight;
    const int i = unknown(lower), j = unknown(lower + own.layers);
    if (i == j) return;
    const double tension =
        weight * (terms_[b].normal * uniform(b, lower) + terms_[b].both * across_) / own.layers;
    const double k = weight * terms_[b].normal / (own.layers * own.layers);
    force[j] -= tension;
    stiffness(j, j) += k;
    if (i < 0) return;
    force[i] += tension;
    stiffness(i, i) += k;
    stiffness(i, j) -= k;
    stiffness(j, i) -= k;
  }

  std::span<const LayerBond> bonds_;
  std::vector<Terms> terms_;
  std::vector<Crossing> crossing_;
  double across_ = 0.0;             ///< strain across the normal
  std::array<double, 2> strain_{};  ///< strain along the normal, below and above
  int half_ = 0;                    ///< layers on either side
  Eigen::MatrixXd stiffness_;       ///< without the bonds across the face
  Eigen::VectorXd force_, motion_;
};

}  // namespace

std::optional<std::vector<LayerBond>> layer_bonds(std::span<const Vector3> offsets,
                                                  std::span<const double> axial,
                                                  std::span<const double> shear_ratio,
                                                  double cell_volume, const Vector3& normal) {
  std::vector<double> heights;
  double longest = 0.0, lowest = 0.0;
  for (const auto& [x, y, z] : offsets) {
    heights.push_back(x * normal[0] + y * normal[1] + z * normal[2]);
    longest = std::max(longest, std::hypot(x, y, z));
  }
  for (const double height : heights) {
    if (height < same_height * longest) continue;
    if (lowest == 0.0 || height < lowest) lowest = height;
  }
  std::vector<LayerBond> bonds;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const auto& [x, y, z] = offsets[k];
    const double squared = x * x + y * y + z * z, length = std::sqrt(squared);
    if (heights[k] < -same_height * longest) continue;
    // Bonds along the layers occur twice; they act only in contraction.
    const bool along = heights[k] < same_height * longest;
    const double number = along ? 1.0 : heights[k] / lowest;
    const int layers = static_cast<int>(std::lround(number));
    if (layers > most_layers || std::abs(number - layers) > same_height * most_layers) return {};
    const LayerBond bond{layers, along ? 0.0 : heights[k] / length,
                         axial[k] * squared / cell_volume * (along ? 0.5 : 1.0),
                         shear_ratio.empty() ? 0.0 : shear_ratio[k]};
    const auto same = std::find_if(bonds.begin(), bonds.end(), [&](const LayerBond& other) {
      return other.layers == bond.layers && std::abs(other.cosine - bond.cosine) < same_height &&
             std::abs(other.shear_ratio - bond.shear_ratio) < same_height;
    });
    if (same == bonds.end()) {
      bonds.push_back(bond);
    } else {
      same->weight += bond.weight;
    }
  }
  return bonds;
}

double face_strength(std::span<const LayerBond> bonds, std::array<double, 2> sides,
                     const BondLaw& law) {
  Chain chain(bonds, sides);
  std::vector<double> ratio(chain.crossing().size());
  double strength = 0.0;
  while (chain.solve()) {
    for (std::size_t b = 0; b < ratio.size(); ++b) {
      const Crossing& one = chain.crossing()[b];
      ratio[b] = chain.stretch(one) / law.segment(one.segment).limit;
    }
    const double largest = *std::max_element(ratio.begin(), ratio.end());
    if (!(largest > 0.0)) break;
    strength = std::max(strength, 1.0 / largest);
    for (std::size_t b = 0; b < ratio.size(); ++b) {
      if (ratio[b] < (1.0 - alike) * largest) continue;
      Crossing& one = chain.crossing()[b];
      one.secant = law.segment(++one.segment).secant;
    }
  }
  return strength;
}

}  // namespace perilink
