#include "calibration/calibration_equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "calibration/surface_columns.hpp"
#include "discretization/point_boxes.hpp"

namespace perilink {
namespace {

constexpr double most_weight = 100.0;
/// Points per block of the ordering.
constexpr Index points_in_a_row = 8;
constexpr double round_off = 1e-12;

/// Energies of dilatation are soft equations: their squares weigh 1 / ridge against the squares of
/// the changes. In space the forces are then slightly soft too: at edges and corners positive
/// weights often cannot satisfy both.
constexpr double dilatation_ridge = 0.003;
constexpr double forces_ridge_in_space = 1e-4;

/// A change of an area fraction by this costs as much as doubling the stiffness of a bond. It is
/// small, so that fractions change only where stiffnesses are not enough (by 0.3 at corners whose
/// edges differ threefold). With free fractions the displacement errors of coarse plates with a
/// hole are up to twice as large. In space a smaller scale makes the solution slow.
constexpr double share_scale_in_plane = 0.01, share_scale_in_space = 0.1;
/// Least area fraction of every corner.
constexpr double least_share = 0.05;

/// Least couples, relative to the start, at the two ends of a bond with one end on the surface;
/// zero for other bonds. At corners and edges all bonds are on one side of the axes: without a
/// change of sign only zero couples would be in balance, and the feasible set would have no
/// interior. The bending stiffness, their sum, stays positive, with the inflection point within one
/// length of the bond.
constexpr double least_couple_at_surface = -0.2, least_couple_below = 0.4;

/// Couples that have fallen to zero can grow again by steps of this fraction of their start.
constexpr double least_couple_scale = 0.1;

/// Returns the corner of a facet after this one, around the facet.
Index next_corner(const Facets& facets, Index facet, Index corner) {
  return corner + 1 == facets.corners.offsets[facet + 1] ? facets.corners.offsets[facet]
                                                         : corner + 1;
}

}  // namespace

CalibrationEquations::CalibrationEquations(const CalibrationInput& input, double least_weight,
                                           const Facets& facets, const BondStiffness& stiffness,
                                           const BondOrbits* orbits)
    : input_(input),
      orbits_(orbits),
      least_weight_(least_weight),
      dim_(input.particles.dim),
      forces_{dim_, !stiffness.bending.empty()},
      stiffness_(stiffness),
      facets_(facets),
      start_{stiffness, facets.shares},
      given_(start_),
      floor_(static_cast<std::size_t>(input.bonds.size()), Floor::least_weight),
      scales_(measure_particles(input.bonds, stiffness.axial, input.particles.size())) {
  choose_points();
  on_surface_.assign(static_cast<std::size_t>(input.particles.size()), 0);
  for (Index f = 0; f < facets_.size(); ++f) {  // materials may differ only in strength
    if (constants_across(facets_, f, input.materials) == LameConstants{}) continue;
    for (const Index i : facets_.corners.row(f)) on_surface_[i] = 1;
  }
}

void CalibrationEquations::choose_points() {
  const Index num_particles = input_.particles.size();
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(num_particles), 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    if (!input_.all_free() && !input_.free[b]) continue;
    free_bonds_.push_back(b);
    touched[input_.bonds.first[b]] = touched[input_.bonds.second[b]] = 1;
  }
  if (orbits_) {
    std::fill(touched.begin(), touched.end(), 0);
    for (const Index i : orbits_->representatives) touched[i] = 1;
  }
  point_of_.assign(static_cast<std::size_t>(num_particles), no_index);
  const auto add = [&](Index i) {
    if (!touched[i]) return;
    point_of_[i] = static_cast<Index>(particle_of_.size());
    particle_of_.push_back(i);
  };
  if (dim_ == 3 && input_.all_free()) {
    // By position: meshes number their nodes at random, and solutions are faster where neighbours
    // are close in memory.
    for (const auto& box : split_into_boxes(input_.particles.positions, dim_, points_in_a_row)) {
      for (const Index i : box) add(i);
    }
    const auto ends = [&](Index b) {
      return std::minmax(point_of_[input_.bonds.first[b]], point_of_[input_.bonds.second[b]]);
    };
    std::ranges::sort(free_bonds_, {}, [&](Index b) { return std::pair<Index, Index>(ends(b)); });
  } else {
    for (Index i = 0; i < num_particles; ++i) add(i);
  }
  kept_ = free_bonds_;
}

CalibrationEquations::Variable CalibrationEquations::axial_variable(Index b) const {
  const double k = stiffness_.axial[b], start = start_.stiffness.axial[b];
  const double scale = std::max(k, least_weight_ * start);
  const double floor = floor_[b] == Floor::none    ? 0.0
                       : floor_[b] == Floor::small ? vanishing
                                                   : least_weight_;
  const double least = std::min(k, floor * start), most = most_weight * scale;
  const Index first = input_.bonds.first[b], second = input_.bonds.second[b];
  return {Kind::axial, b, 0, first, second, k, scale, least, most};
}

/// Returns the variable of the couple at one end: a part of the bending stiffness.
CalibrationEquations::Variable CalibrationEquations::couple_variable(Index b, Index end) const {
  const auto part = [&](const BondStiffness& of) {
    return of.bending[b] * (end == 0 ? of.inflection[b] : 1.0 - of.inflection[b]);
  };
  const double present = part(stiffness_);
  const double scale = std::max(present, least_couple_scale * part(start_.stiffness));
  const Index ends[2] = {input_.bonds.first[b], input_.bonds.second[b]};
  const bool here = on_surface_[ends[end]] != 0, there = on_surface_[ends[1 - end]] != 0;
  const double least = here == there ? 0.0 : here ? least_couple_at_surface : least_couple_below;
  return {Kind::couple,       b,       end,   ends[end],
          ends[1 - end],      present, scale, std::min(least * part(start_.stiffness), present),
          most_weight * scale};
}

/// Visits the transfers of area between corners of facets.
template <class Visit>
void CalibrationEquations::for_each_share(Visit visit) const {
  const double scale = dim_ == 2 ? share_scale_in_plane : share_scale_in_space;
  for (Index f = 0; f < facets_.size(); ++f) {
    if (facets_.is_tied(f)) continue;
    const Index begin = facets_.corners.offsets[f];
    const bool edge = facets_.corners.offsets[f + 1] - begin == 2;
    const double part = edge ? 1.0 : 0.5;  // corners of triangles take part in two transfers
    const auto spare = [&](Index corner) {
      return part * std::max(0.0, facets_.shares[corner] - least_share);
    };
    for (Index c = begin; c < (edge ? begin + 1 : facets_.corners.offsets[f + 1]); ++c) {
      const Index to = next_corner(facets_, f, c);
      const Index first = facets_.corners.values[c], second = facets_.corners.values[to];
      if (point_of_[first] == no_index || point_of_[second] == no_index) continue;
      if (spare(to) + spare(c) == 0.0) continue;
      visit(Variable{Kind::share, f, c, first, second, 0.0, scale, -spare(to), spare(c)});
    }
  }
}

/// Visits all variables in the order of the equations.
template <class Visit>
void CalibrationEquations::for_each_variable(Visit visit) const {
  for (const Index b : kept_) visit(axial_variable(b));
  if (forces_.bending) {
    for (const Index b : kept_) {
      if (!(start_.stiffness.bending[b] > 0.0)) continue;  // a truss (Poisson's ratio at its limit)
      const double at_first = start_.stiffness.inflection[b];
      if (at_first != 0.0) visit(couple_variable(b, 0));  // a hinge has no couple
      if (at_first != 1.0) visit(couple_variable(b, 1));
    }
  }
  if (input_.all_free()) for_each_share(visit);
}

void CalibrationEquations::change(const Variable& variable, double value) {
  switch (variable.kind) {
    case Kind::axial: stiffness_.axial[variable.index] = value; break;
    case Kind::couple: {
      const double other = couple_variable(variable.index, 1 - variable.end).present;
      const double sum = value + other;
      const double at_first = variable.end == 0 ? value : other;
      // Two couples at their bounds may sum to round-off of either sign.
      const bool bends = sum > round_off * start_.stiffness.bending[variable.index];
      stiffness_.bending[variable.index] = bends ? sum : 0.0;
      stiffness_.inflection[variable.index] = bends ? at_first / sum : 0.5;
      break;
    }
    case Kind::share:
      facets_.shares[variable.end] -= value;
      facets_.shares[next_corner(facets_, variable.index, variable.end)] += value;
  }
}

void CalibrationEquations::apply(std::span<const double> weights) {
  auto weight = weights.begin();
  std::vector<std::pair<Variable, double>> changes;
  changes.reserve(weights.size());
  for_each_variable([&](const Variable& variable) {
    changes.emplace_back(variable, variable.present + variable.scale * (*weight++ - 1.0));
  });
  for (const auto& [variable, value] : changes) change(variable, value);
}

/// Fills the row of a variable per unit, at its first particle.
void CalibrationEquations::fill_row(const ForceRows& form, const Variable& variable,
                                    double* row) const {
  const Bonds& bonds = input_.bonds;
  if (variable.kind == Kind::axial) {
    form.axial(bonds.length(variable.index), bonds.direction(variable.index), row);
    return;
  }
  if (variable.kind == Kind::couple) {
    form.shear(bonds.length(variable.index), bonds.direction(variable.index), row);
    // Sign for the second particle, and the whole couple in place of one half per end.
    for (int r = 0; r < form.odd(); ++r) row[r] *= variable.end == 0 ? 1.0 : -1.0;
    for (int r = form.odd(); r < form.balance(); ++r) row[r] *= 2.0;
    return;
  }
  const LameConstants jump = constants_across(facets_, variable.index, input_.materials);
  Vector3 lambda_area{}, mu_area{};
  for (int a = 0; a < dim_; ++a) {
    lambda_area[a] = jump.lambda * facets_.area_vector(variable.index)[a];
    mu_area[a] = jump.mu * facets_.area_vector(variable.index)[a];
  }
  form.right(lambda_area, mu_area, row);
}

/// Makes the equations without the right sides of the dilatation.
PointEquations CalibrationEquations::make_equations(const ForceRows& form) const {
  PointEquations equations;
  equations.dim = dim_;
  equations.rows = form.count();
  equations.odd = form.odd();
  equations.killing = dim_ == 3 && !forces_.bending && input_.all_free();
  equations.one_ended = static_cast<Index>(kept_.size());
  std::vector<double> row(static_cast<std::size_t>(form.count()));
  const std::size_t most = kept_.size() * (forces_.bending ? 3 : 1) +
                           (input_.all_free() ? facets_.corners.values.size() : 0);
  equations.coefficients.reserve(most * row.size());
  for (auto* ends : {&equations.first, &equations.second}) ends->reserve(most);
  for (auto* bounds : {&equations.lower, &equations.upper}) bounds->reserve(most);
  for_each_variable([&](const Variable& variable) {
    equations.first.push_back(point_of_[variable.first]);
    equations.second.push_back(point_of_[variable.second]);
    if (orbits_) {
      equations.unknown.push_back(variable.kind == Kind::axial
                                      ? orbits_->of_bond(variable.index)
                                      : orbits_->num_views +
                                            orbits_->views[variable.index][variable.end]);
    }
    fill_row(form, variable, row.data());
    for (const double value : row) equations.coefficients.push_back(variable.scale * value);
    equations.lower.push_back(1.0 + (variable.least - variable.present) / variable.scale);
    equations.upper.push_back(1.0 + (variable.most - variable.present) / variable.scale);
  });
  for (const Index i : particle_of_) {
    const auto x = input_.particles.position(i);
    equations.positions.insert(equations.positions.end(), x.begin(), x.end());
  }
  set_right_sides(equations);
  if (moments_ridge_ == 0.0) return equations;
  equations.ridge.assign(static_cast<std::size_t>(equations.rows), moments_ridge_);
  std::fill_n(equations.ridge.begin(), forces_.odd(), 0.0);
  return equations;
}

/// Returns unbalanced forces, shape (particles, rows of forces_).
std::vector<double> CalibrationEquations::out_of_balance() const {
  return forces_out_of_balance(forces_, facets_, input_.materials, input_.bonds, stiffness_,
                               input_.particles.size());
}

/// Sets the right sides of forces and moments. The caller sets the right side of the dilatation.
void CalibrationEquations::set_right_sides(PointEquations& equations) const {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  const std::size_t known = static_cast<std::size_t>(forces_.count());
  // Unbalanced forces and the present forces of the variables.
  const std::vector<double> rest = out_of_balance();
  for (const Index i : particle_of_) {
    for (std::size_t r = 0; r < rows; ++r) {
      equations.right.push_back(r < known ? rest[i * known + r] : 0.0);
      const double arm = static_cast<int>(r) < equations.odd ? scales_.length[i]
                         : r < known                         ? 1.0
                                                             : 0.0;
      equations.scale.push_back(arm / scales_.modulus[i]);
    }
  }
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const double* a = equations.coefficients.data() + v * rows;
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      if (p == no_index) return;
      for (int r = from; r < std::min<int>(to, static_cast<int>(known)); ++r) {
        equations.right[p * rows + r] += sign * a[r];
      }
    });
  }
}

PointEquations CalibrationEquations::settling() const {
  PointEquations equations = make_equations({dim_, forces_.bending, true});
  equations.ridge.resize(static_cast<std::size_t>(equations.rows), 0.0);
  if (dim_ == 3) std::fill_n(equations.ridge.begin(), forces_.odd(), forces_ridge_in_space);
  equations.ridge.back() = dilatation_ridge;
  // The particles of a column under the surface share one equation.
  const std::vector<Index> head = surface_columns(input_.bonds, facets_, input_.particles);
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (const Index i : particle_of_) {
    const Index group = point_of_[head[i] == no_index ? i : head[i]];
    equations.group.push_back(group);
    equations.right[(group + 1) * rows - 1] += dilatation_modulus(
        dim_, input_.particles.volumes[i], input_.materials[input_.particles.material[i]]);
  }
  scale_last_rows(equations);
  for (std::size_t p = 0; p < particle_of_.size(); ++p) {
    if (head[particle_of_[p]] == no_index) equations.scale[(p + 1) * rows - 1] = 0.0;
  }
  return equations;
}

void CalibrationEquations::report_balance(CalibrationReport& report) const {
  perilink::report_balance(forces_, out_of_balance(), particle_of_, scales_, report);
}

void CalibrationEquations::report_weights(CalibrationReport& report) const {
  perilink::report_weights(free_bonds_, stiffness_.axial, start_.stiffness.axial, least_weight_,
                           report);
}

}  // namespace perilink
