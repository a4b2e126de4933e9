#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "discretization/meshes/cell_search.hpp"
#include "discretization/meshes/mesh.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Whether a point belongs to something.
using PointTest = std::function<bool(const Vector3&)>;

/// Where the body of a case with model = "lattice" is: in the regions of its material but not in
/// the holes; of a case with a mesh in the cells that have the material. Points a millionth of the
/// spacing outside are inside.
class LatticeShape {
 public:
  /// \throws InputError where the mesh cannot be read or does not suit the case
  explicit LatticeShape(const CaseFile& input);
  LatticeShape(const LatticeShape&) = delete;
  LatticeShape& operator=(const LatticeShape&) = delete;

  /// Around the body [length].
  Box box() const;
  bool holds(const Vector3& point) const;
  /// Whether a point lies in the regions or cells of the material, holes or not.
  bool is_solid(const Vector3& point) const;
  /// Whether a point lies in a hole without a group; the side of a hole belongs to the body.
  bool is_in_hole(const Region& hole, const Vector3& point) const;
  /// Holes of the case; one that is named twice is here twice.
  std::span<const Region* const> holes() const { return holes_; }
  /// Notes on the mesh that it was read from.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Whether points lie in a region of the case; `body` is not one of them.
  /// \param key  place in the case, for messages
  /// \throws InputError where the region is a group of the mesh without area (2D) or volume (3D)
  PointTest test_of(const Region& region, const std::string& key) const;

 private:
  void read_mesh();
  PointTest test_of_group(const Region& region, const std::string& key) const;

  const CaseFile& input_;
  double tolerance_ = 0.0;
  std::vector<const Region*> solid_, holes_;
  Mesh mesh_;
  std::vector<std::string> notes_;
  std::optional<CellSearch> cells_;  ///< search in the mesh with the material
};

}  // namespace perilink
