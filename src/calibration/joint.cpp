#include "calibration/joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace perilink {
namespace {

/// Facets whose normals differ by less are parallel; particles this close to a plane, in spacings,
/// lie in it.
constexpr double same_direction = 1e-6, same_plane = 1e-6;

constexpr double round_off = 1e-9;

/// Axes of a component of the strain.
using Pair = std::array<int, 2>;

/// Strain along one axis of the planes, across them, along two axes of the planes, shear across.
std::vector<Pair> fields(int dim) {
  if (dim == 2) return {{0, 0}, {1, 1}, {0, 1}};
  return {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
}

struct Row {
  Pair field;
  int axis;
};

bool is_in_front(const Pair& field, int axis, int dim) {
  if (field[0] == field[1]) return true;
  return dim == 3 && field == Pair{0, 1} && axis == 2;
}

std::vector<Row> make_rows(int dim) {
  std::vector<Row> rows;
  for (const bool front : {true, false}) {
    for (const Pair& field : fields(dim)) {
      for (int axis = 0; axis < dim; ++axis) {
        if (is_in_front(field, axis, dim) == front) rows.push_back({field, axis});
      }
    }
  }
  return rows;
}

const std::vector<Row>& rows_of(int dim) {
  static const std::vector<Row> plane = make_rows(2), space = make_rows(3);
  return dim == 2 ? plane : space;
}

/// Strain of a field in a material, in the axes of the planes: the component itself and, of strains
/// along the planes, that across them.
struct FieldStrain {
  double own = 1.0;
  double across = 0.0;
};

FieldStrain strain_in(const Pair& field, int dim, const LameConstants& first,
                      const LameConstants& own) {
  const int normal = dim - 1;
  const double stiffness = own.lambda + 2.0 * own.mu;
  if (field[0] == normal) return {(first.lambda + 2.0 * first.mu) / stiffness, 0.0};
  if (field[1] == normal) return {first.mu / own.mu, 0.0};
  if (field[0] != field[1]) return {};
  return {1.0, (first.lambda - own.lambda) / stiffness};
}

double component(const Vector3& axis, std::span<const double> direction) {
  double sum = 0.0;
  for (std::size_t a = 0; a < direction.size(); ++a) sum += axis[a] * direction[a];
  return sum;
}

Vector3 in_axes(const Joint& joint, std::span<const double> vector) {
  Vector3 turned{};
  for (int a = 0; a < joint.dim; ++a) turned[a] = component(joint.axes[a], vector);
  return turned;
}

/// Calls visit(material, part of the way) for the layers between two heights.
template <class Visit>
void for_each_layer(const Joint& joint, double from, double to, Visit visit) {
  const double low = std::min(from, to), high = std::max(from, to);
  if (high - low <= joint.tolerance) {
    const auto above = std::upper_bound(joint.planes.begin(), joint.planes.end(), low);
    visit(joint.layers[static_cast<std::size_t>(above - joint.planes.begin())], 1.0);
    return;
  }
  double begin = low;
  for (std::size_t k = 0; k < joint.layers.size(); ++k) {
    const double top = k < joint.planes.size() ? std::min(joint.planes[k], high) : high;
    if (top - begin <= joint.tolerance) continue;
    visit(joint.layers[k], (top - begin) / (high - low));
    begin = top;
  }
}

/// The extension of a bond of unit length along n, in the axes of the planes, in a field.
double extension_in(const Joint& joint, const Pair& field, const Vector3& n, double from,
                    double to) {
  double sum = 0.0;
  for_each_layer(joint, from, to, [&](Index material, double part) {
    const FieldStrain strain = strain_in(field, joint.dim, joint.materials[joint.layers.front()],
                                         joint.materials[material]);
    const double across = n[joint.dim - 1];
    sum += part * (strain.own * n[field[0]] * n[field[1]] + strain.across * across * across);
  });
  return sum;
}

/// The interfaces between materials of different constants, lowest first.
struct Plane {
  double height;
  Index below, above;
};

Vector3 unit(std::span<const double> vector) {
  double square = 0.0;
  for (const double x : vector) square += x * x;
  Vector3 result{};
  for (std::size_t a = 0; a < vector.size(); ++a) result[a] = vector[a] / std::sqrt(square);
  return result;
}

/// Two or three unit vectors, the last one along the normal.
std::vector<Vector3> axes_along(const Vector3& normal, int dim) {
  if (dim == 2) return {{normal[1], -normal[0], 0.0}, normal};
  int least = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::abs(normal[a]) < std::abs(normal[least])) least = a;
  }
  Vector3 first{};
  for (int a = 0; a < 3; ++a) first[a] = (a == least ? 1.0 : 0.0) - normal[least] * normal[a];
  first = unit(first);
  const Vector3 second{normal[1] * first[2] - normal[2] * first[1],
                       normal[2] * first[0] - normal[0] * first[2],
                       normal[0] * first[1] - normal[1] * first[0]};
  return {first, second, normal};
}

}  // namespace

double Joint::height(std::span<const double> position) const {
  return component(axes.back(), position);
}

bool Joint::in_plane(double height) const {
  return std::any_of(planes.begin(), planes.end(),
                     [&](double plane) { return std::abs(height - plane) <= tolerance; });
}

bool Joint::crosses(double from, double to) const {
  return std::any_of(planes.begin(), planes.end(), [&](double plane) {
    return std::min(from, to) < plane - tolerance && std::max(from, to) > plane + tolerance;
  });
}

double Joint::modulus_between(double from, double to) const {
  double compliance = 0.0;
  for_each_layer(*this, from, to, [&](Index material, double part) {
    compliance += part / (materials[material].lambda + 2.0 * materials[material].mu);
  });
  return 1.0 / compliance;
}

void Joint::axial(double length, std::span<const double> direction, double from, double to,
                  double* row) const {
  const Vector3 n = in_axes(*this, direction);
  for (const Row& equation : rows_of(dim)) {
    *row++ = length * extension_in(*this, equation.field, n, from, to) * n[equation.axis];
  }
}

double Joint::dilatation(double length, std::span<const double> direction, double from,
                         double to) const {
  const Vector3 n = in_axes(*this, direction);
  double extension = 0.0;
  for (int a = 0; a < dim; ++a) extension += length * extension_in(*this, {a, a}, n, from, to);
  return 0.5 * extension * extension;
}

double Joint::dilatation_at(double height) const {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (std::abs(height - planes[k]) > tolerance) continue;
    const double half_step = 2.0 * tolerance;
    return 0.5 * (dilatation_at(planes[k] - half_step) + dilatation_at(planes[k] + half_step));
  }
  const auto above = std::upper_bound(planes.begin(), planes.end(), height);
  const LameConstants& own = materials[layers[static_cast<std::size_t>(above - planes.begin())]];
  double along = dim - 1.0, across = 0.0;
  for (int a = 0; a < dim; ++a) {
    const FieldStrain strain = strain_in({a, a}, dim, materials[layers.front()], own);
    across += a + 1 == dim ? strain.own : strain.across;
  }
  const double trace = along + across;
  return own.lambda * trace * trace + 2.0 * own.mu * (along + across * across);
}

void Joint::right(std::span<const double> area, Index inside, Index outside, double* row) const {
  const Vector3 turned = in_axes(*this, area);
  const int normal = dim - 1;
  for (const Row& equation : rows_of(dim)) {
    const auto& [i, j] = equation.field;
    double force = 0.0;
    for (const Index material : {inside, outside}) {
      if (material == no_index) continue;
      const LameConstants& own = materials[material];
      const FieldStrain strain = strain_in(equation.field, dim, materials[layers.front()], own);
      const double trace = (i == j ? strain.own : 0.0) + strain.across;
      double traction = own.lambda * trace * turned[equation.axis];
      // The other component of a shear counts half as much, as in n . e n.
      const double part = i == j ? 2.0 * own.mu * strain.own : own.mu * strain.own;
      if (equation.axis == i) traction += part * turned[j];
      if (i != j && equation.axis == j) traction += part * turned[i];
      if (equation.axis == normal) traction += 2.0 * own.mu * strain.across * turned[normal];
      force += material == inside ? traction : -traction;
    }
    *row++ = -force;
  }
}

std::optional<Joint> find_joint(const Facets& facets, const Particles& particles,
                                const std::vector<LameConstants>& materials, double spacing) {
  Joint joint;
  joint.dim = particles.dim;
  joint.materials = materials;
  joint.tolerance = same_plane * spacing;
  std::vector<Plane> planes;
  for (Index f = 0; f < facets.size(); ++f) {
    if (!facets.on_surface(f) && facets.is_glued(f)) return std::nullopt;
    if (facets.on_surface(f) || materials[facets.inside[f]] == materials[facets.outside[f]]) {
      continue;
    }
    const Vector3 normal = unit(facets.area_vector(f));
    if (joint.axes.empty()) joint.axes = axes_along(normal, joint.dim);
    const double cosine = component(normal, joint.axes.back());
    if (std::abs(std::abs(cosine) - 1.0) > same_direction) return std::nullopt;
    for (const Index i : facets.corners.row(f)) {
      const double height = joint.height(particles.position(i));
      planes.push_back(cosine > 0.0 ? Plane{height, facets.inside[f], facets.outside[f]}
                                    : Plane{height, facets.outside[f], facets.inside[f]});
    }
  }
  std::sort(planes.begin(), planes.end(),
            [](const Plane& a, const Plane& b) { return a.height < b.height; });
  for (const Plane& plane : planes) {
    const bool again =
        !joint.planes.empty() && plane.height - joint.planes.back() <= joint.tolerance;
    if (joint.layers.empty()) joint.layers.push_back(plane.below);
    const std::size_t last = joint.layers.size() - 1;
    const Index below = again ? joint.layers[last - 1] : joint.layers[last];
    if (!(materials[below] == materials[plane.below])) return std::nullopt;
    if (again) {
      if (!(materials[joint.layers[last]] == materials[plane.above])) return std::nullopt;
      continue;
    }
    joint.planes.push_back(plane.height);
    joint.layers.push_back(plane.above);
  }
  if (joint.planes.empty()) return std::nullopt;
  return joint;
}

std::vector<std::uint8_t> particles_at_joint(const Joint& joint, const Particles& particles,
                                             const Bonds& bonds) {
  std::vector<std::uint8_t> at(static_cast<std::size_t>(particles.size()), 0);
  for (Index i = 0; i < particles.size(); ++i) {
    at[i] = joint.in_plane(joint.height(particles.position(i))) ? 1 : 0;
  }
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.first[b], j = bonds.second[b];
    const double from = joint.height(particles.position(i)),
                 to = joint.height(particles.position(j));
    if (joint.crosses(from, to)) at[i] = at[j] = 1;
  }
  return at;
}

std::vector<std::uint8_t> bonds_at_joint_to_keep(const Joint& joint, const Particles& particles,
                                                 const Bonds& bonds) {
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(bonds.size()), 1);
  std::vector<Index> crossing;
  std::vector<std::uint8_t> is_steep(keep.size(), 0);
  for (Index b = 0; b < bonds.size(); ++b) {
    const double from = joint.height(particles.position(bonds.first[b]));
    const double to = joint.height(particles.position(bonds.second[b]));
    if (!joint.crosses(from, to)) continue;
    crossing.push_back(b);
    const double across = component(joint.axes.back(), bonds.direction(b));
    is_steep[b] = 1.0 - across * across < (joint.dim - 1.0) / 3.0 * across * across - round_off;
  }
  for (bool again = true; again;) {
    again = false;
    std::vector<std::uint8_t> has_flat(static_cast<std::size_t>(particles.size()), 0);
    for (const Index b : crossing) {
      if (keep[b] != 0 && is_steep[b] == 0)
        has_flat[bonds.first[b]] = has_flat[bonds.second[b]] = 1;
    }
    for (const Index b : crossing) {
      if (keep[b] == 0 || (has_flat[bonds.first[b]] != 0 && has_flat[bonds.second[b]] != 0))
        continue;
      keep[b] = 0;
      again = true;
    }
  }
  return keep;
}

std::vector<double> forces_out_of_balance(const Joint& joint, const Facets& facets,
                                          const Particles& particles, const Bonds& bonds,
                                          std::span<const double> stiffness) {
  const auto rows = static_cast<std::size_t>(joint.rows());
  std::vector<double> rest(static_cast<std::size_t>(particles.size()) * rows, 0.0), row(rows);
  for (Index f = 0; f < facets.size(); ++f) {
    joint.right(facets.area_vector(f), facets.inside[f], facets.outside[f], row.data());
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      double* own = rest.data() + facets.corners.values[c] * rows;
      for (std::size_t r = 0; r < rows; ++r) own[r] += facets.shares[c] * row[r];
    }
  }
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.first[b], j = bonds.second[b];
    joint.axial(bonds.lengths[b], bonds.direction(b), joint.height(particles.position(i)),
                joint.height(particles.position(j)), row.data());
    for (std::size_t r = 0; r < rows; ++r) {
      rest[i * rows + r] -= stiffness[b] * row[r];
      rest[j * rows + r] += stiffness[b] * row[r];
    }
  }
  return rest;
}

}  // namespace perilink
