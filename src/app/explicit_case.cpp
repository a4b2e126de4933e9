#include "app/explicit_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/lattice_shape.hpp"
#include "app/position_field.hpp"
#include "base/error.hpp"
#include "io/case_sections.hpp"
#include "io/case_words.hpp"

namespace perilink {
namespace {

constexpr double most_particles = 3e7;
constexpr double most_steps = 2e9;       ///< steps have 32-bit numbers
constexpr double farthest_offset = 1e6;  ///< of the lattice point from the body [spacings]
/// Formulas for the same displacement, typed in two entries, may differ by round-off.
constexpr double same_value = 1e-9;

Problem problem_of(const CaseFile& input) {
  if (input.body.problem == "plane_strain") return Problem::plane_strain;
  if (input.body.problem == "three_dimensional") return Problem::three_dimensional;
  return Problem::plane_stress;
}

LatticeRules rules_of(const CaseFile& input) {
  if (input.body.variant == "2017") return LatticeRules::mean_2017;
  if (input.body.variant == "2018") return LatticeRules::least_2018;
  return LatticeRules::consistent;
}

void refuse_size(const CaseFile& input, const LatticeCut& cut, int dim) {
  double count = 1.0;
  for (int a = 0; a < dim; ++a) {
    count *= std::max(1.0, (cut.upper[a] - cut.lower[a]) / cut.spacing);
    const double away =
        std::max(std::abs(cut.lower[a] - cut.origin[a]), std::abs(cut.upper[a] - cut.origin[a]));
    if (away <= farthest_offset * cut.spacing) continue;
    throw InputError(input.where("body.offset"),
                     fmt::format("the body reaches {:.3g} spacings from the lattice point at ({})",
                                 away / cut.spacing,
                                 fmt::join(cut.origin.begin(), cut.origin.begin() + dim, ", ")),
                     "give a lattice point near the body, or a larger spacing");
  }
  if (count <= most_particles) return;
  throw InputError(
      input.where("body.spacing"), fmt::format("gives about {:.1e} particles", count),
      fmt::format("at most {:.0e} are possible: choose a coarser spacing", most_particles));
}

LatticeRows build_lattice(const CaseFile& input, const LatticeShape& shape) {
  const int dim = dimension_of(input.body);
  LatticeCut cut;
  cut.spacing = *input.body.spacing;
  cut.rotation = input.body.rotation * std::numbers::pi / 180.0;
  cut.origin = input.body.offset;
  cut.thickness = input.body.thickness;
  cut.lower = shape.box().lower;
  cut.upper = shape.box().upper;
  refuse_size(input, cut, dim);
  cut.inside = [&](const Vector3& point) { return shape.holds(point); };
  try {
    return dim == 2 ? hexagonal_rows(cut) : face_centred_rows(cut);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where("body.spacing"), error.what(),
                     "choose a finer spacing, or move a lattice point into the body by `offset`");
  }
}

LatticeMaterial lattice_material(const CaseFile& input) {
  const MaterialSection& section = input.materials.front();
  const LatticeMaterialSection& own = *section.lattice;
  LatticeMaterial material;
  material.youngs_modulus = section.youngs_modulus;
  material.poissons_ratio = *section.poissons_ratio;
  material.density = own.density;
  material.breakable = own.tensile_strength.has_value();
  material.softening = softening_of(section);
  material.tension_compression_ratio = own.compression_ratio;
  material.compressive_threshold = own.compression_threshold;
  material.boundary_factor = own.boundary_factor;
  material.internal_damping = own.internal_damping;
  material.external_damping = own.external_damping;
  material.fundamental_period = own.fundamental_period.value_or(0.0);
  return material;
}

ExplicitModel build_body(const CaseFile& input, const LatticeShape& shape) {
  LatticeRows lattice = build_lattice(input, shape);
  try {
    return make_explicit_model(problem_of(input), rules_of(input), std::move(lattice),
                               lattice_material(input), input.body.thickness);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where("body.spacing"), error.what(), "");
  }
}

/// Supports and driven displacements, each component of a particle once.
class Prescriptions {
 public:
  Prescriptions(const CaseFile& input, const LatticeShape& shape, const LatticeRows& lattice)
      : input_(input), shape_(shape), lattice_(lattice) {}

  void add(const std::string& table, std::size_t index, const std::string& region, int component,
           const Expression& value) {
    const std::string entry = item_key(table, index);
    const char* axis = axis_names[component];
    const std::string key = value.is_constant() ? entry : item_key(table, index, axis);
    const PositionField values(input_, key, {&value, 1});
    for (const Index slot : slots_of(region, item_key(table, index, "region"))) {
      const Vector3 x = position(slot);
      const double given = values.at(span_of(x))[0];
      const auto [place, is_new] = values_.emplace(std::pair(slot, component), given);
      const double before = place->second;
      const double largest = std::max(std::abs(given), std::abs(before));
      if (is_new || std::abs(given - before) <= same_value * largest) continue;
      throw InputError(
          input_.where(entry),
          fmt::format("sets the displacement along {} of the particle at ({}) to {}, where another "
                      "entry sets it to {}",
                      axis, fmt::join(span_of(x), ", "), given, before),
          "let the regions of [[supports]] and [[displacements]] not overlap");
    }
  }

  std::vector<PrescribedMotion> motions() const {
    std::vector<PrescribedMotion> motions;
    for (const auto& [place, amplitude] : values_) {
      motions.push_back({place.first, place.second, amplitude});
    }
    return motions;
  }

 private:
  Vector3 position(Index slot) const {
    Vector3 x{};
    for (int a = 0; a < lattice_.dim; ++a) x[a] = lattice_.positions[lattice_.at(a, slot)];
    return x;
  }
  std::span<const double> span_of(const Vector3& x) const {
    return {x.data(), static_cast<std::size_t>(lattice_.dim)};
  }

  std::vector<Index> slots_of(const std::string& name, const std::string& key) const {
    if (name == body_region) return lattice_.particle_slot;
    const auto region = std::find_if(input_.regions.begin(), input_.regions.end(),
                                     [&](const Region& own) { return own.name == name; });
    const PointTest is_inside = shape_.test_of(*region, key);
    std::vector<Index> inside;
    for (const Index slot : lattice_.particle_slot) {
      if (is_inside(position(slot))) inside.push_back(slot);
    }
    if (!inside.empty()) return inside;
    throw InputError(
        input_.where(key), fmt::format("no particle lies in the region \"{}\"", name),
        fmt::format("particles are {:.6g} apart; make the region larger or move it onto the body",
                    lattice_.spacing));
  }

  const CaseFile& input_;
  const LatticeShape& shape_;
  const LatticeRows& lattice_;
  std::map<std::pair<Index, int>, double> values_;
};

/// \return the largest driven displacement [length]
double prescribe_motions(const CaseFile& input, const LatticeShape& shape, ExplicitModel& model) {
  const int dim = model.lattice.dim;
  Prescriptions prescriptions(input, shape, model.lattice);
  for (std::size_t k = 0; k < input.supports.size(); ++k) {
    for (int axis = 0; axis < dim; ++axis) {
      if (!input.supports[k].fix[axis]) continue;
      prescriptions.add("supports", k, input.supports[k].region, axis, Expression{});
    }
  }
  for (std::size_t k = 0; k < input.displacements.size(); ++k) {
    for (int axis = 0; axis < dim; ++axis) {
      const auto& value = input.displacements[k].value[axis];
      if (value) prescriptions.add("displacements", k, input.displacements[k].region, axis, *value);
    }
  }
  const std::vector<PrescribedMotion> motions = prescriptions.motions();
  prescribe(model, motions);
  double largest = 0.0;
  for (const PrescribedMotion& motion : motions) {
    largest = std::max(largest, std::abs(motion.amplitude));
  }
  if (largest > 0.0) return largest;
  throw InputError(input.where("displacements"),
                   "nothing moves the body: all formulas are zero on their particles", "");
}

/// Chooses the step and refuses one that is not stable for certain.
void choose_steps(const CaseFile& input, ExplicitCase& built) {
  const AnalysisSection& analysis = input.analysis;
  built.critical_time_step = critical_time_step(built.model);
  built.time_step = analysis.time_step.value_or(analysis.safety * built.critical_time_step);
  if (built.time_step > built.critical_time_step) {
    throw InputError(input.where("analysis.time_step"),
                     fmt::format("is {:.6g}, larger than the critical time step {:.6g}",
                                 built.time_step, built.critical_time_step),
                     "take less, or leave it out: `safety` takes a part of the critical one");
  }
  const double steps = std::ceil(analysis.duration / built.time_step);
  if (!(steps <= most_steps)) {
    throw InputError(input.where("analysis.duration"),
                     fmt::format("takes {:.1e} steps of {:.4g}", steps, built.time_step),
                     fmt::format("at most {:.0e} are possible", most_steps));
  }
  built.steps = static_cast<Index>(steps);
  built.options.duration = analysis.duration;
  built.options.ramp = analysis.ramp_time;
  built.options.time_step = built.time_step;
  built.options.rows = analysis.rows;
}

}  // namespace

CrackOpeningLaw softening_of(const MaterialSection& material) {
  const LatticeMaterialSection& own = *material.lattice;
  CrackOpeningLaw law;
  law.knee_ratio = own.knee_stress_ratio;
  if (!own.tensile_strength) return law;
  law.strength = *own.tensile_strength;
  // Twice the area under the law is strength times critical opening times the sum of the ratios.
  const double ratios = own.knee_stress_ratio + own.knee_opening_ratio;
  law.critical_opening =
      own.critical_opening.value_or(2.0 * material.fracture_energy / (law.strength * ratios));
  law.knee_opening = own.knee_opening_ratio * law.critical_opening;
  return law;
}

ExplicitCase build_explicit_case(const CaseFile& input) {
  ExplicitCase built;
  const LatticeShape shape(input);
  built.model = build_body(input, shape);
  built.options.reference = prescribe_motions(input, shape, built.model);
  choose_steps(input, built);
  const LatticeRows& lattice = built.model.lattice;
  for (const Index slot : lattice.particle_slot) built.bonds += lattice.bond_count[slot];
  built.bonds /= 2;
  return built;
}

}  // namespace perilink
