#include "discretization/cuts/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"

namespace perilink {
namespace {

/// Corners of a polygon may leave its plane by this much, in its size.
constexpr double plane_tolerance = 1e-6;

/// A straight piece of a line, or a polygon.
struct Piece {
  std::vector<Vector3> corners;
  Vector3 normal{};  ///< unit vector to the positive side
  /// Outward normals of a polygon's sides, in its plane; of a line's piece beyond its two ends.
  std::vector<Vector3> side_normals;
  Index crack = 0;
};

Vector3 scaled(const Vector3& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

Piece line_piece(const Vector3& from, const Vector3& to, Index crack) {
  const Vector3 along = minus(to, from);
  const double length = norm(along);
  if (!(length > 0.0)) throw std::invalid_argument("has two equal points in succession");
  const Vector3 tangent = scaled(along, 1.0 / length);
  return {{from, to}, {-tangent[1], tangent[0], 0.0}, {scaled(tangent, -1.0), tangent}, crack};
}

Piece polygon_piece(const Crack& crack, Index number) {
  const std::vector<Vector3>& corners = crack.points;
  const std::size_t count = corners.size();
  Vector3 area{};  // Newell's normal: right for every plane polygon
  double size = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 part =
        cross(minus(corners[k], corners[0]), minus(corners[(k + 1) % count], corners[0]));
    for (int axis = 0; axis < 3; ++axis) area[axis] += part[axis];
    size = std::max(size, norm(minus(corners[k], corners[0])));
  }
  if (!(norm(area) > plane_tolerance * size * size)) {
    throw std::invalid_argument("has corners on one line");
  }
  Piece piece{corners, scaled(area, 1.0 / norm(area)), {}, number};
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 side = minus(corners[(k + 1) % count], corners[k]);
    if (!(norm(side) > 0.0)) throw std::invalid_argument("has two equal corners in succession");
    piece.side_normals.push_back(scaled(cross(side, piece.normal), 1.0 / norm(side)));
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (const Vector3& corner : corners) {
      const Vector3 offset = minus(corner, corners[k]);
      if (std::abs(dot(offset, piece.normal)) > plane_tolerance * size) {
        throw std::invalid_argument("has corners that do not lie in one plane");
      }
      if (dot(offset, piece.side_normals[k]) > plane_tolerance * size) {
        throw std::invalid_argument("has corners that make no convex polygon");
      }
    }
  }
  return piece;
}

std::vector<Piece> pieces_of(std::span<const Crack> cracks, int dim) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    const std::vector<Vector3>& points = cracks[k].points;
    if (points.size() < static_cast<std::size_t>(dim)) {
      throw std::invalid_argument(dim == 2 ? "needs two points" : "needs three corners");
    }
    const auto number = static_cast<Index>(k);
    if (dim == 3) pieces.push_back(polygon_piece(cracks[k], number));
    for (std::size_t p = 1; dim == 2 && p < points.size(); ++p) {
      pieces.push_back(line_piece(points[p - 1], points[p], number));
    }
  }
  return pieces;
}

/// Whether a point of the piece's line or plane belongs to the piece.
bool holds(const Piece& piece, const Vector3& point, double tolerance) {
  for (std::size_t side = 0; side < piece.side_normals.size(); ++side) {
    if (dot(minus(point, piece.corners[side]), piece.side_normals[side]) > tolerance) return false;
  }
  return true;
}

/// The particles, those on cracks moved to the positive side by a distance that is nothing but more
/// than the tolerance.
std::vector<Vector3> shifted_positions(const Particles& particles, std::span<const Piece> pieces,
                                       double tolerance) {
  std::vector<Vector3> positions;
  for (Index i = 0; i < particles.size(); ++i) {
    const Vector3 x = point_of(particles.positions, particles.dim, i);
    Vector3 shift{};
    for (const Piece& piece : pieces) {
      if (std::abs(dot(minus(x, piece.corners[0]), piece.normal)) > tolerance) continue;
      if (!holds(piece, x, tolerance)) continue;
      for (int axis = 0; axis < 3; ++axis) shift[axis] += piece.normal[axis];
    }
    const double length = norm(shift);
    positions.push_back(x);
    // Normals that cancel: the crack was drawn there and back, and the particle stays in between.
    if (!(length > 1e-6)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      positions.back()[axis] += 3.0 * tolerance / length * shift[axis];
    }
  }
  return positions;
}

/// Box around all pieces.
struct Surroundings {
  Vector3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  explicit Surroundings(std::span<const Piece> pieces, double tolerance) {
    for (const Piece& piece : pieces) {
      for (const Vector3& corner : piece.corners) {
        for (int a = 0; a < 3; ++a) {
          low[a] = std::min(low[a], corner[a] - tolerance);
          high[a] = std::max(high[a], corner[a] + tolerance);
        }
      }
    }
  }

  bool miss(const Vector3& from, const Vector3& to) const {
    for (int a = 0; a < 3; ++a) {
      if (std::max(from[a], to[a]) < low[a] || std::min(from[a], to[a]) > high[a]) return true;
    }
    return false;
  }
};

bool crosses(const Piece& piece, const Vector3& from, const Vector3& to, double tolerance) {
  const double start = dot(minus(from, piece.corners[0]), piece.normal);
  const double end = dot(minus(to, piece.corners[0]), piece.normal);
  if ((start > 0.0) == (end > 0.0)) return false;
  return holds(piece, between(from, to, start / (start - end)), tolerance);
}

}  // namespace

void check_crack(const Crack& crack, int dim) { pieces_of({&crack, 1}, dim); }

CutBonds find_cut_bonds(const Particles& particles, const Bonds& bonds,
                        std::span<const Crack> cracks, double spacing) {
  CutBonds cut;
  cut.keep.assign(static_cast<std::size_t>(bonds.size()), 1);
  cut.count.assign(cracks.size(), 0);
  if (cracks.empty()) return cut;
  const std::vector<Piece> pieces = pieces_of(cracks, particles.dim);
  const double tolerance = on_crack_tolerance * spacing;
  const std::vector<Vector3> positions = shifted_positions(particles, pieces, tolerance);
  const Surroundings all(pieces, 10.0 * tolerance);
  for (Index b = 0; b < bonds.size(); ++b) {
    Index last = no_index;  // a crack with a kink counts a bond once
    const Vector3 &from = positions[bonds.first[b]], &to = positions[bonds.second[b]];
    if (all.miss(from, to)) continue;
    for (const Piece& piece : pieces) {
      if (piece.crack == last) continue;
      if (!crosses(piece, from, to, tolerance)) continue;
      ++cut.count[piece.crack];
      last = piece.crack;
      cut.keep[b] = 0;
    }
  }
  return cut;
}

}  // namespace perilink
