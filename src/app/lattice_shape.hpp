#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discretization/cell_search.hpp"
#include "discretization/mesh.hpp"
#include "io/case_file.hpp"

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
  /// The hole without a group that takes a point from the regions of the material, or null; the
  /// side of a hole belongs to the body.
  const Region* hole_around(const Vector3& point) const;

  /// Whether points lie in a region of the case; `body` is not one of them.
  /// \param key  of the case that asks, for the message
  /// \throws InputError where the region is a group of the mesh without area (2D) or volume (3D)
  PointTest test_of(const Region& region, const std::string& key) const;

 private:
  void read_mesh();
  bool is_solid(const Vector3& point) const;
  PointTest test_of_group(const Region& region, const std::string& key) const;

  const CaseFile& input_;
  double tolerance_ = 0.0;
  std::vector<const Region*> solid_, holes_;
  Mesh mesh_;
  std::optional<CellSearch> cells_;  ///< of the mesh with the material
};

}  // namespace perilink
