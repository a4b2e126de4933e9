#include "discretization/cuts/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"

namespace perilink {
namespace {

/// Largest distance of a polygon's corner from its plane, over the polygon's size.
constexpr double plane_tolerance = 1e-6;

using Piece = CrackCutter::Piece;

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
  Vector3 area{};  // Newell's normal, valid for every plane polygon
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

/// Returns nonzero for each line that must be reversed, so that connected lines continue the first
/// one. A particle at a joint then lies on one side of all of them.
std::vector<std::uint8_t> turned_lines(std::span<const Crack> cracks) {
  std::map<Vector3, std::vector<std::size_t>> meeting;
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    for (const Vector3& end : {cracks[k].points.front(), cracks[k].points.back()}) {
      meeting[end].push_back(k);
    }
  }
  std::vector<std::uint8_t> turned(cracks.size(), 0), known(cracks.size(), 0);
  for (std::size_t root = 0; root < cracks.size(); ++root) {
    if (std::exchange(known[root], 1) != 0) continue;
    std::vector<std::size_t> found{root};
    for (std::size_t next = 0; next < found.size(); ++next) {
      const std::size_t k = found[next];
      for (const bool at_first : {true, false}) {
        const Vector3& end = at_first ? cracks[k].points.front() : cracks[k].points.back();
        for (const std::size_t other : meeting[end]) {
          if (std::exchange(known[other], 1) != 0) continue;
          const bool begins = at_first != (turned[k] != 0);
          turned[other] = begins == (cracks[other].points.front() == end);
          found.push_back(other);
        }
      }
    }
  }
  return turned;
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
  if (dim == 3) return pieces;
  const std::vector<std::uint8_t> turned = turned_lines(cracks);
  for (Piece& piece : pieces) {
    if (turned[piece.crack] != 0) piece.normal = scaled(piece.normal, -1.0);
  }
  return pieces;
}

/// Returns whether a point of the piece's line or plane belongs to the piece.
bool holds(const Piece& piece, const Vector3& point, double tolerance) {
  for (std::size_t side = 0; side < piece.side_normals.size(); ++side) {
    if (dot(minus(point, piece.corners[side]), piece.side_normals[side]) > tolerance) return false;
  }
  return true;
}

bool crosses(const Piece& piece, const Vector3& from, const Vector3& to, double tolerance) {
  const double start = dot(minus(from, piece.corners[0]), piece.normal);
  const double end = dot(minus(to, piece.corners[0]), piece.normal);
  if ((start > 0.0) == (end > 0.0)) return false;
  return holds(piece, between(from, to, start / (start - end)), tolerance);
}

}  // namespace

CrackCutter::CrackCutter(std::span<const Crack> cracks, int dim, double spacing)
    : pieces_(pieces_of(cracks, dim)), tolerance_(on_crack_tolerance * spacing) {
  const double margin = 10.0 * tolerance_;
  for (const Piece& piece : pieces_) {
    for (const Vector3& corner : piece.corners) {
      for (int a = 0; a < 3; ++a) {
        lower_[a] = std::min(lower_[a], corner[a] - margin);
        upper_[a] = std::max(upper_[a], corner[a] + margin);
      }
    }
  }
}

/// Moves a particle on cracks to the positive side by slightly more than the tolerance.
Vector3 CrackCutter::shifted(const Vector3& particle) const {
  Vector3 shift{};
  const Piece* first = nullptr;
  for (const Piece& piece : pieces_) {
    if (std::abs(dot(minus(particle, piece.corners[0]), piece.normal)) > tolerance_) continue;
    if (!holds(piece, particle, tolerance_)) continue;
    if (first == nullptr) first = &piece;
    for (int axis = 0; axis < 3; ++axis) shift[axis] += piece.normal[axis];
  }
  Vector3 position = particle;
  if (first == nullptr) return position;
  // Normals cancel where a crack is drawn back and forth; then the first piece decides.
  if (!(norm(shift) > 1e-6)) shift = first->normal;
  const double length = norm(shift);
  for (int axis = 0; axis < 3; ++axis) {
    position[axis] += 3.0 * tolerance_ / length * shift[axis];
  }
  return position;
}

bool CrackCutter::cuts(const Vector3& first, const Vector3& second, std::span<Index> count) const {
  for (int a = 0; a < 3; ++a) {
    if (std::max(first[a], second[a]) < lower_[a]) return false;
    if (std::min(first[a], second[a]) > upper_[a]) return false;
  }
  const Vector3 from = shifted(first), to = shifted(second);
  Index last = no_index;  // counts a bond once per crack, also at a kink
  for (const Piece& piece : pieces_) {
    if (piece.crack == last || !crosses(piece, from, to, tolerance_)) continue;
    last = piece.crack;
    if (count.empty()) break;
    ++count[last];
  }
  return last != no_index;
}

const CrackCutter::Piece* CrackCutter::piece_between(const Vector3& first,
                                                     const Vector3& second) const {
  const Vector3 from = shifted(first), to = shifted(second);
  const Vector3 way = minus(to, from);
  const Piece* steepest = nullptr;
  const auto along = [&](const Piece& piece) { return std::abs(dot(piece.normal, way)); };
  for (const Piece& piece : pieces_) {
    if (!crosses(piece, from, to, tolerance_)) continue;
    if (steepest == nullptr || along(piece) > along(*steepest)) steepest = &piece;
  }
  return steepest;
}

void check_crack(const Crack& crack, int dim) { pieces_of({&crack, 1}, dim); }

CutBonds find_cut_bonds(const Particles& particles, const Bonds& bonds,
                        std::span<const Crack> cracks, double spacing) {
  CutBonds cut;
  cut.keep.assign(static_cast<std::size_t>(bonds.size()), 1);
  cut.count.assign(cracks.size(), 0);
  const CrackCutter cutter(cracks, particles.dim, spacing);
  const auto at = [&](Index i) { return point_of(particles.positions, particles.dim, i); };
  for (Index b = 0; b < bonds.size(); ++b) {
    cut.keep[b] = !cutter.cuts(at(bonds.first[b]), at(bonds.second[b]), cut.count);
  }
  return cut;
}

}  // namespace perilink
