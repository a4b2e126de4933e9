#include "model/body/lattice_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr double most_lattice_particles = 3e7;
/// Largest distance between the lattice point and the body [spacings].
constexpr double farthest_offset = 1e6;

void refuse_size(const CaseFile& input, const LatticeCut& cut, int dim) {
  double count = 1.0;
  for (int a = 0; a < dim; ++a) {
    count *= std::max(1.0, (cut.upper[a] - cut.lower[a]) / cut.spacing);
    const double away =
        std::max(std::abs(cut.lower[a] - cut.origin[a]), std::abs(cut.upper[a] - cut.origin[a]));
    if (away <= farthest_offset * cut.spacing) continue;
    throw InputError(
        input.where("body.offset"),
        fmt::format("the body reaches {:.3g} spacings from the lattice point at ({})",
                    away / cut.spacing, joined({cut.origin.data(), static_cast<std::size_t>(dim)})),
        "give a lattice point near the body, or a larger spacing");
  }
  if (count <= most_lattice_particles) return;
  throw InputError(
      input.where("body.spacing"), fmt::format("gives about {:.1e} particles", count),
      fmt::format("at most {:.0e} are possible: choose a coarser spacing", most_lattice_particles));
}

/// Counts the particles removed by each hole. A small hole, or one between particles, may remove
/// fewer than expected.
class HoleCounter {
 public:
  explicit HoleCounter(const LatticeShape& shape) : shape_(shape) {
    for (const Region* hole : shape.holes()) {
      if (hole->group.empty())
        counts_.try_emplace(hole, 0);  // cells of hole groups are not part of the body
    }
  }

  /// Whether a point belongs to the body.
  bool holds(const Vector3& point) {
    if (!shape_.is_solid(point)) return false;
    bool taken = false;
    for (auto& [hole, count] : counts_) {
      if (!shape_.is_in_hole(*hole, point)) continue;
      taken = true;
      ++count;
    }
    return !taken;
  }

  void add_notes(std::vector<std::string>& notes) const {
    std::set<const Region*> told;
    for (const Region* hole : shape_.holes()) {
      const auto found = counts_.find(hole);
      if (found == counts_.end() || !told.insert(hole).second) continue;
      const Index count = found->second;
      notes.push_back(fmt::format("{} in the hole \"{}\"",
                                  count == 0   ? "no particle was"
                                  : count == 1 ? "1 particle was"
                                               : fmt::format("{} particles were", count),
                                  hole->name));
    }
  }

 private:
  const LatticeShape& shape_;
  std::map<const Region*, Index> counts_;
};

LatticeRows cut_lattice(const CaseFile& input, const LatticeShape& shape,
                        std::vector<std::string>& notes) {
  const int dim = dimension_of(input.body);
  LatticeCut cut;
  cut.spacing = *input.body.spacing;
  cut.rotation = input.body.rotation * std::numbers::pi / 180.0;
  cut.origin = input.body.offset;
  cut.thickness = input.body.thickness;
  cut.lower = shape.box().lower;
  cut.upper = shape.box().upper;
  refuse_size(input, cut, dim);
  HoleCounter holes(shape);
  cut.inside = [&](const Vector3& point) { return holes.holds(point); };
  try {
    LatticeRows rows = dim == 2 ? hexagonal_rows(cut) : face_centred_rows(cut);
    holes.add_notes(notes);
    return rows;
  } catch (const std::invalid_argument& error) {
    throw InputError(
        input.where("body.spacing"), error.what(),
        input.materials.front().holes.empty()
            ? "choose a finer spacing, or move a lattice point into the body by `offset`"
            : "choose a finer spacing, smaller `holes`, or move a lattice point into "
              "the body by `offset`");
  }
}

LatticeMaterial lattice_material(const CaseFile& input) {
  const MaterialSection& section = input.materials.front();
  const LatticeMaterialSection& own = *section.lattice;
  LatticeMaterial material;
  material.youngs_modulus = section.youngs_modulus;
  material.poissons_ratio = *section.poissons_ratio;
  material.density = *section.density;
  if (input.analysis.type == AnalysisType::elastic) return material;
  material.breakable = own.tensile_strength.has_value();
  material.softening = softening_of(section);
  material.compressive_threshold = own.compression_threshold;
  material.boundary_factor = own.boundary_factor;
  material.yields = own.yield_strength.has_value();
  if (material.yields) {
    material.yielding = {*own.yield_strength, *own.ultimate_strength, *own.ultimate_plastic_strain,
                         0.0};
    material.crushing_energy = own.crushing_energy.value_or(0.0);
  }
  material.internal_damping = own.internal_damping;
  if (own.fundamental_period) {  // else build_explicit_case() computes it
    material.external_damping = own.external_damping;
    material.fundamental_period = *own.fundamental_period;
  }
  return material;
}

/// Collects the mesh groups named in the case, with the particles in their cells.
class GroupFinder {
 public:
  GroupFinder(const CaseFile& input, const LatticeShape& shape, Model& model)
      : input_(input), shape_(shape), model_(model) {}

  template <class Section>
  void add(const std::string& table, const std::vector<Section>& sections) {
    for (std::size_t k = 0; k < sections.size(); ++k) {
      add(sections[k].region, item_key(table, k, "region"));
    }
  }

 private:
  void add(const std::string& name, const std::string& key) {
    const auto region = std::find_if(input_.regions.begin(), input_.regions.end(),
                                     [&](const Region& own) { return own.name == name; });
    if (region == input_.regions.end() || region->group.empty()) return;
    const PointTest is_inside = shape_.test_of(*region, key);
    Group group{region->group, {}, {}};
    const Particles& particles = model_.network.particles;
    for (Index i = 0; i < particles.size(); ++i) {
      Vector3 x{};
      std::copy_n(particles.position(i).begin(), particles.dim, x.begin());
      if (is_inside(x)) group.particles.push_back(i);
    }
    model_.groups.push_back(std::move(group));
  }

  const CaseFile& input_;
  const LatticeShape& shape_;
  Model& model_;
};

}  // namespace

ExplicitModel build_lattice(const CaseFile& input, const LatticeShape& shape,
                            std::vector<std::string>& notes) {
  notes.insert(notes.end(), shape.notes().begin(), shape.notes().end());
  LatticeRows lattice = cut_lattice(input, shape, notes);
  try {
    return make_explicit_model(input.body.problem, input.body.variant, std::move(lattice),
                               lattice_material(input), input.body.thickness);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where("body.spacing"), error.what(), "");
  }
}

CrackOpeningLaw softening_of(const MaterialSection& material) {
  const LatticeMaterialSection& own = *material.lattice;
  CrackOpeningLaw law;
  law.compression_ratio = own.compression_ratio;
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

Model lattice_places(const CaseFile& input, const LatticeShape& shape, const ExplicitModel& body,
                     std::span<const Index> slots) {
  Model model;
  model.problem = body.problem;
  model.lattice.pattern = input.body.pattern;
  model.lattice.dim = body.lattice.dim;
  model.lattice.spacing = body.lattice.spacing;
  model.lattice.cell_volume = body.lattice.cell_volume;
  model.network.particles = lattice_particles(body.lattice, slots, body.volume);
  GroupFinder groups(input, shape, model);
  groups.add("supports", input.supports);
  groups.add("displacements", input.displacements);
  groups.add("loads", input.loads);
  groups.add("gauges", input.gauges);
  return model;
}

Model build_lattice_model(const CaseFile& input) {
  const LatticeShape shape(input);
  std::vector<std::string> notes;
  const ExplicitModel body = build_lattice(input, shape, notes);
  LatticeNetwork statics = lattice_network(body);
  Model model = lattice_places(input, shape, body, statics.slots);
  model.notes = std::move(notes);
  model.network = std::move(statics.network);
  if (statics.left_out > 0) {
    model.notes.push_back(
        fmt::format("left out: {}, connected only by single bonds or a line of bonds",
                    counted(statics.left_out, "particle")));
  }
  if (body.rules == LatticeRules::least_2018) {
    model.notes.emplace_back(
        "variant = \"2018\": the smaller of two force states is not "
        "conservative; this elastic analysis uses their mean, as the other "
        "variants do");
  }
  return model;
}

}  // namespace perilink
