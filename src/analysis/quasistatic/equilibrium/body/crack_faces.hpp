#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/csr.hpp"
#include "material/principal_values.hpp"
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
  /// Returns the broken bonds around those that broke since the last call, with these, ascending.
  std::vector<Index> take_around_broken() {
    return broken_around(std::exchange(newly_broken_, {}));
  }

  /// Stiffness of a closed bond over that of the intact bond.
  using Ratio = std::pair<Index, double>;
  /// Returns the ratios of the broken bonds among elements by all broken bonds.
  std::vector<Ratio> ratios_of(std::span<const Index> elements);
  /// Returns the broken bonds whose ratios change as given ones break, with these, ascending.
  std::vector<Index> broken_around(std::span<const Index> bonds) const;

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
  /// Sums over broken bonds. l is the unit of distances, w = (l / length)^2, n the direction of a
  /// bond, and x its middle over l.
  struct Sums {
    double weight = 0.0;           ///< of w
    Vector3 first{};               ///< of w x
    SymmetricTensor places{};      ///< of w x x'
    SymmetricTensor directions{};  ///< of w n n'
    SymmetricTensor squares{};     ///< of n n'
  };
  /// A particle with broken bonds.
  struct Site {
    std::vector<Index> broken;     ///< its broken bonds, ascending
    Sums sums;                     ///< over these, with x from the particle
    std::optional<Plane> plane;    ///< if it is known
    std::vector<double> cosines;   ///< cosine_of() each broken bond; empty if they are not known
    double largest_cosine = -1.0;  ///< of these
  };
  void begin();
  bool is_broken(Index element) const;
  std::vector<Index> particles_around(std::span<const Index> bonds) const;
  void sum(Index particle);
  void add_sums(Index particle, const Vector3& shift, Sums& sums) const;
  const Plane& plane_at(Index particle);
  double cosine_of(Index bond);
  double pressure_of(Index bond, double cosine) const;
  const Site& with_cosines(Index particle);
  bool has_strut(Index particle);
  Face face_of(Index particle);

  const Network& network_;
  std::vector<double> closed_;  ///< closed_ratio(), per element; empty if none closes
  double unit_ = 0.0;           ///< of distances in the search for normals [length]
  Csr neighbourhoods_;          ///< bonds of each particle; without rows until a bond has broken
  std::vector<std::unique_ptr<Site>> sites_;  ///< per particle; null without broken bonds
  std::vector<Index> newly_broken_;           ///< bonds without new ratios around them
};

}  // namespace perilink
