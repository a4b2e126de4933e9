#include "discretization/facets.hpp"

namespace perilink {

Vector3 Facets::centre(Index facet, std::span<const double> positions) const {
  Vector3 mean{};
  const std::span<const Index> ends = corners.row(facet);
  for (const Index i : ends) {
    for (int axis = 0; axis < dim; ++axis) {
      mean[axis] += positions[static_cast<std::size_t>(i) * dim + axis] /
                    static_cast<double>(ends.size());
    }
  }
  return mean;
}

void Facets::append(std::span<const Index> corner_particles, const Vector3& area_vector,
                    Index material_inside, Index material_outside) {
  corners.values.insert(corners.values.end(), corner_particles.begin(), corner_particles.end());
  corners.offsets.push_back(static_cast<Index>(corners.values.size()));
  area_vectors.insert(area_vectors.end(), area_vector.begin(), area_vector.begin() + dim);
  inside.push_back(material_inside);
  outside.push_back(material_outside);
}

}  // namespace perilink
