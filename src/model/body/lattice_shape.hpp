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

/// Test whether a point belongs to a region.
using PointTest = std::function<bool(const Vector3&)>;

/// Shape of a body with model = "lattice": its material's regions without the holes, or the mesh
/// cells of the material. Points within a millionth of the spacing of it are inside.
class LatticeShape {
 public:
  /// \throws InputError where the mesh cannot be read or does not suit the case
  explicit LatticeShape(const CaseFile& input);
  LatticeShape(const LatticeShape&) = delete;
  LatticeShape& operator=(const LatticeShape&) = delete;

  /// Returns the bounding box of the body [length].
  Box box() const;
  bool holds(const Vector3& point) const;
  /// Whether a point lies in the regions or cells of the material, holes or not.
  bool is_solid(const Vector3& point) const;
  /// Whether a point lies in a hole that is not a mesh group. The boundary of a hole belongs to the
  /// body.
  bool is_in_hole(const Region& hole, const Vector3& point) const;
  /// Returns the holes of the case; a hole named twice appears twice.
  std::span<const Region* const> holes() const { return holes_; }
  /// Returns notes on the mesh file.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Returns a test whether points lie in a region of the case other than `body`.
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
  std::optional<CellSearch> cells_;  ///< search among mesh cells of the material
};

}  // namespace perilink
