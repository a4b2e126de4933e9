#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/csr.hpp"
#include "network/network.hpp"

namespace perilink {

/// Broken bonds of cracks that have grown, as struts between the faces when these close. The normal
/// of a crack follows from the broken bonds around a particle. Bonds near the normal carry the
/// pressure of all broken bonds, oblique ones nothing, so that faces slide
/// (docs/theory/softening.md, section 8).
class CrackFaces {
 public:
  explicit CrackFaces(const Network& network);

  /// Returns whether an element is a bond that turns into a strut when it breaks. Bonds of shells
  /// and beams represent whole sections, and contact springs have their normal already.
  bool concerns(Index element) const {
    return !network_.has_sections() && element < network_.num_bonds() &&
           network_.law(element).closes();
  }
  /// Declares that a bond is broken, or whole again.
  void set_broken(Index bond, bool broken);

  /// Returns the stiffness of a closed element over its intact stiffness [-].
  double closed_ratio(Index element) const { return closed_[element]; }
  /// Sets that of an open element.
  /// \return former ratio
  double set_closed_ratio(Index element, double ratio) {
    return std::exchange(closed_[element], ratio);
  }
  /// Returns the broken bonds around those that broke since the last call, with these.
  std::set<Index> take_around_broken() { return broken_around(std::exchange(newly_broken_, {})); }

  /// Stiffness of a closed bond over that of the intact bond.
  using Ratio = std::pair<Index, double>;
  /// Returns the ratios of the broken bonds among elements by all broken bonds, in ascending order.
  std::vector<Ratio> ratios_of(const std::set<Index>& elements);
  /// Returns the broken bonds whose ratios change as given ones break, with these.
  std::set<Index> broken_around(std::span<const Index> bonds) const;

 private:
  /// Pressure that a particle takes over from its broken bonds.
  struct Face {
    double least_angle_cosine = 0.0;  ///< least cosine to the normal of a bond that is a strut [-]
    double scale = 0.0;               ///< pressure of its broken bonds over that of its struts [-]
  };
  /// Plane through the broken bonds around a particle.
  struct Plane {
    Vector3 normal;
    bool flat;  ///< whether the crack is nearly plane there
  };
  template <class Visit>
  void for_each_broken(Index particle, Visit visit) const;
  std::vector<Index> particles_of(std::span<const Index> bonds) const;
  const Plane& plane_at(Index particle);
  double cosine_of(Index bond);
  double pressure_of(Index bond, double cosine) const;
  bool has_strut(Index particle);
  Face face_of(Index particle);

  const Network& network_;
  Csr neighbourhoods_;  ///< bonds of each particle; without rows if there is no closing bond
  double unit_ = 0.0;   ///< of distances in the search for normals [length]
  std::vector<double> closed_;                ///< closed_ratio(), per element
  std::vector<std::uint8_t> broken_;          ///< per bond
  std::vector<Index> newly_broken_;           ///< bonds without new ratios around them
  std::vector<std::optional<Plane>> planes_;  ///< per particle, where they are known
  std::map<Index, bool> has_strut_;           ///< per particle, where it is known
};

}  // namespace perilink
