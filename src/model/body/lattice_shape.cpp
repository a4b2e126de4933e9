#include "model/body/lattice_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>

#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/toml_tree.hpp"
#include "model/body/mesh_input.hpp"

namespace perilink {
namespace {

constexpr double cut_tolerance = 1e-6;  ///< [spacings]

std::vector<const Region*> regions_named(const CaseFile& input,
                                         const std::vector<std::string>& names) {
  std::vector<const Region*> found;
  for (const std::string& name : names) {
    found.push_back(&*std::find_if(input.regions.begin(), input.regions.end(),
                                   [&](const Region& region) { return region.name == name; }));
  }
  return found;
}

std::vector<Index> cells_with_material(const MeshInput& mesh) {
  std::vector<Index> cells;
  for (Index cell = 0; cell < mesh.mesh.num_cells(); ++cell) {
    if (mesh.material[cell] != no_index) cells.push_back(cell);
  }
  return cells;
}

}  // namespace

LatticeShape::LatticeShape(const CaseFile& input)
    : input_(input),
      tolerance_(cut_tolerance * *input.body.spacing),
      solid_(regions_named(input, input.materials.front().regions)),
      holes_(regions_named(input, input.materials.front().holes)) {
  if (input.body.mesh) read_mesh();
}

void LatticeShape::read_mesh() {
  MeshInput mesh = read_mesh_input(input_, dimension_of(input_.body));
  for (const Region* hole : holes_) {
    if (hole->group.empty()) continue;
    const MeshGroup& group =
        group_of_cells(input_, mesh.mesh, *hole, "materials[1].holes", "material");
    for (const Index cell : group.elements) mesh.material[cell] = no_index;
  }
  try {
    cells_.emplace(mesh.mesh, cells_with_material(mesh), tolerance_);
  } catch (const std::invalid_argument& error) {
    throw InputError(input_.where("body.mesh"), error.what(),
                     "mesh the body again, or give the material a group that has cells");
  }
  mesh_ = std::move(mesh.mesh);
  notes_ = std::move(mesh.notes);
}

Box LatticeShape::box() const {
  if (cells_) return cells_->box();
  Box box = solid_.front()->box;
  for (const Region* region : solid_) {
    for (int a = 0; a < dimension_of(input_.body); ++a) {
      box.lower[a] = std::min(box.lower[a], region->box.lower[a] - tolerance_);
      box.upper[a] = std::max(box.upper[a], region->box.upper[a] + tolerance_);
    }
  }
  return box;
}

bool LatticeShape::is_solid(const Vector3& point) const {
  if (cells_) return cells_->contains(point);
  const auto dim = static_cast<std::size_t>(dimension_of(input_.body));
  return std::any_of(solid_.begin(), solid_.end(), [&](const Region* region) {
    return region->contains({point.data(), dim}, tolerance_);
  });
}

bool LatticeShape::is_in_hole(const Region& hole, const Vector3& point) const {
  const auto dim = static_cast<std::size_t>(dimension_of(input_.body));
  return hole.group.empty() && hole.contains({point.data(), dim}, -tolerance_);
}

bool LatticeShape::holds(const Vector3& point) const {
  return is_solid(point) && std::none_of(holes_.begin(), holes_.end(), [&](const Region* hole) {
           return is_in_hole(*hole, point);
         });
}

PointTest LatticeShape::test_of(const Region& region, const std::string& key) const {
  if (!region.group.empty()) return test_of_group(region, key);
  return [this, &region](const Vector3& point) {
    const auto dim = static_cast<std::size_t>(dimension_of(input_.body));
    return region.contains({point.data(), dim}, tolerance_);
  };
}

PointTest LatticeShape::test_of_group(const Region& region, const std::string& key) const {
  const MeshGroup& group = group_of_cells(input_, mesh_, region, key, "particles");
  const auto search = std::make_shared<CellSearch>(mesh_, group.elements, tolerance_);
  return [search](const Vector3& point) { return search->contains(point); };
}

}  // namespace perilink
