#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// A crack that is there before the analysis begins.
struct Crack {
  /// Two dimensions: the points of a line of straight pieces. Three dimensions: the corners of a
  /// plane convex polygon, in order [length].
  std::vector<Vector3> points;
};

/// A particle this close to a crack lies on it, in spacings.
inline constexpr double on_crack_tolerance = 1e-6;

/// Bonds that cracks cross.
struct CutBonds {
  std::vector<std::uint8_t> keep;  ///< per bond: 0 where a crack crosses it
  std::vector<Index> count;        ///< per crack; a bond that crosses two counts for both
};

/// Refuses what is no crack.
/// \throws std::invalid_argument  where a piece has no length, or corners are no convex polygon in
///         a plane
void check_crack(const Crack& crack, int dim);

/// Finds bonds that cross a crack, its ends and border included. A particle on a crack is on its
/// left, or where corners run counter-clockwise, so that cracks along rows cut too. A line that
/// begins where an earlier one begins, or ends where it ends, is turned round first. Where pieces
/// meet the mean normal counts, or where normals cancel the first.
class CrackCutter {
 public:
  /// A straight piece of a line, or a polygon.
  struct Piece {
    std::vector<Vector3> corners;
    Vector3 normal{};  ///< unit vector to the positive side
    /// Outward normals of a polygon's sides, in its plane; of a line's piece beyond its two ends.
    std::vector<Vector3> side_normals;
    Index crack = 0;
  };

  /// \param spacing  between particles [length]
  /// \throws std::invalid_argument  as check_crack()
  CrackCutter(std::span<const Crack> cracks, int dim, double spacing);

  /// Whether the bond between two particles is cut.
  /// \param count  bonds that each crack cuts: this one is added; empty: nobody counts
  bool cuts(const Vector3& first, const Vector3& second, std::span<Index> count = {}) const;
  /// Corners of a box around all cracks; no crack: infinite, the lower above the upper.
  const Vector3& lower() const { return lower_; }
  const Vector3& upper() const { return upper_; }

 private:
  Vector3 shifted(const Vector3& particle) const;

  std::vector<Piece> pieces_;
  double tolerance_;
  Vector3 lower_{infinity, infinity, infinity}, upper_{-infinity, -infinity, -infinity};
};

/// The bonds of a body that cracks cut (CrackCutter).
/// \param spacing  between particles [length]
/// \throws std::invalid_argument  as check_crack()
CutBonds find_cut_bonds(const Particles& particles, const Bonds& bonds,
                        std::span<const Crack> cracks, double spacing);

}  // namespace perilink
