#include "network/correction/joint.hpp"

#include <algorithm>
#include <cmath>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"

namespace perilink {
namespace {

/// Facets whose normals differ by less are parallel. Particles closer to a plane, in spacings, are
/// in it.
constexpr double same_direction = 1e-6, same_plane = 1e-6;

/// A corner of a facet between two materials.
struct Corner {
  double height;
  Index below, above;
};

/// Returns the corners between materials and sets the normal; std::nullopt where facets are not
/// parallel or are tied.
std::optional<std::vector<Corner>> corners_between(const Facets& facets, const Particles& particles,
                                                   const std::vector<LameConstants>& materials,
                                                   Joint& joint) {
  std::vector<Corner> corners;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.is_tied(f)) return std::nullopt;
    const Index inside = facets.inside[f], outside = facets.outside[f];
    if (facets.on_surface(f) || materials[inside] == materials[outside]) continue;
    Vector3 normal = point_of(facets.area_vectors, joint.dim, f);
    const double area = norm(normal);
    for (double& x : normal) x /= area;
    if (corners.empty()) joint.normal = normal;
    const double cosine = dot(joint.normal, normal);
    if (std::abs(std::abs(cosine) - 1.0) > same_direction) return std::nullopt;
    for (const Index i : facets.corners.row(f)) {
      const double height = joint.height(particles.position(i));
      corners.push_back(cosine > 0.0 ? Corner{height, inside, outside}
                                     : Corner{height, outside, inside});
    }
  }
  std::sort(corners.begin(), corners.end(),
            [](const Corner& a, const Corner& b) { return a.height < b.height; });
  return corners;
}

/// Fills the planes and layers of a joint. Returns false where the layers change along the planes.
bool stack(const std::vector<Corner>& corners, const std::vector<LameConstants>& materials,
           Joint& joint) {
  const auto same = [&](Index a, Index b) { return materials[a] == materials[b]; };
  joint.layers.push_back(corners.front().below);
  for (const Corner& corner : corners) {
    const bool again =
        !joint.planes.empty() && corner.height - joint.planes.back() <= joint.tolerance;
    const std::size_t last = joint.layers.size() - 1;
    if (!same(joint.layers[again ? last - 1 : last], corner.below)) return false;
    if (again && !same(joint.layers[last], corner.above)) return false;
    if (again) continue;
    joint.planes.push_back(corner.height);
    joint.layers.push_back(corner.above);
  }
  return true;
}

}  // namespace

double Joint::height(std::span<const double> position) const {
  return dot(normal, point_of(position, dim, 0));
}

bool Joint::in_plane(double height) const {
  return std::any_of(planes.begin(), planes.end(),
                     [&](double plane) { return std::abs(height - plane) <= tolerance; });
}

std::size_t Joint::layer_at(double height) const {
  const auto above = std::upper_bound(planes.begin(), planes.end(), height + tolerance);
  return static_cast<std::size_t>(above - planes.begin());
}

std::optional<Joint> find_joint(const Facets& facets, const Particles& particles,
                                const std::vector<LameConstants>& materials, double spacing) {
  Joint joint;
  joint.dim = particles.dim;
  joint.tolerance = same_plane * spacing;
  const auto corners = corners_between(facets, particles, materials, joint);
  if (!corners || corners->empty() || !stack(*corners, materials, joint)) return std::nullopt;
  for (Index i = 0; i < particles.size(); ++i) {
    const double height = joint.height(particles.position(i));
    if (joint.in_plane(height)) continue;
    const Index layer = joint.layers[joint.layer_at(height)];
    if (!(materials[particles.material[i]] == materials[layer])) return std::nullopt;
  }
  return joint;
}

}  // namespace perilink
