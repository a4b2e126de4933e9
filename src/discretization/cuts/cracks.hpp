#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Crack that exists before the analysis.
struct Crack {
  /// Two dimensions: points of a polyline [length]. Three dimensions: corners of a plane convex
  /// polygon, in order [length].
  std::vector<Vector3> points;
  std::optional<bool> closes = {};  ///< its faces press on each other; empty: as the materials
};

/// A particle this close to a crack lies on it [spacings].
inline constexpr double on_crack_tolerance = 1e-6;

/// Bonds cut by cracks.
struct CutBonds {
  std::vector<std::uint8_t> keep;  ///< per bond, 0 if a crack cuts it
  std::vector<Index> count;        ///< cut bonds per crack; a bond cut by two counts twice
};

/// Checks a crack.
/// \throws std::invalid_argument if a piece has no length, or the corners are not a plane convex
///     polygon
void check_crack(const Crack& crack, int dim);

/// Finds bonds that cross a crack, its ends and border included. A particle on a crack counts as
/// left of it (2D) or on the side from which the corners run counter-clockwise (3D). Cracks along
/// rows of particles therefore cut bonds too. A line that shares its start with the start of an
/// earlier line, or its end with the end, is reversed first. Where pieces meet, the mean normal
/// decides the side; where normals cancel, the first does.
class CrackCutter {
 public:
  /// Straight piece of a line, or a polygon.
  struct Piece {
    std::vector<Vector3> corners;
    Vector3 normal{};  ///< unit vector to the positive side
    /// Outward normals of a polygon's sides in its plane, or of a line piece at its two ends.
    std::vector<Vector3> side_normals;
    Index crack = 0;
  };

  /// \param spacing  distance of neighbouring particles [length]
  /// \throws std::invalid_argument for a crack that check_crack() refuses
  CrackCutter(std::span<const Crack> cracks, int dim, double spacing);

  /// Returns whether the bond between two particles is cut.
  /// \param count  cut bonds per crack, incremented; empty: no count
  bool cuts(const Vector3& first, const Vector3& second, std::span<Index> count = {}) const;
  /// Returns the piece that cuts the bond between two particles, the one most across it; null: none.
  const Piece* piece_between(const Vector3& first, const Vector3& second) const;
  /// Corners of the box around all cracks; infinite with lower above upper if there are no cracks.
  const Vector3& lower() const { return lower_; }
  const Vector3& upper() const { return upper_; }

 private:
  Vector3 shifted(const Vector3& particle) const;

  std::vector<Piece> pieces_;
  double tolerance_;
  Vector3 lower_{infinity, infinity, infinity}, upper_{-infinity, -infinity, -infinity};
};

/// Returns bonds of a body that cracks cut.
/// \param spacing  distance of neighbouring particles [length]
/// \throws std::invalid_argument for a crack that check_crack() refuses
CutBonds find_cut_bonds(const Particles& particles, const Bonds& bonds,
                        std::span<const Crack> cracks, double spacing);

}  // namespace perilink
