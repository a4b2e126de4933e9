#include "model/conditions/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "model/conditions/formula_field.hpp"
#include "model/conditions/loads.hpp"
#include "model/model_regions.hpp"
#include "network/builder/loose_parts.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {
namespace {

/// Relative difference allowed between two entries that prescribe the same displacement.
constexpr double same_value = 1e-9;

/// Distance within which a particle lies in a plane of symmetry, in spacings.
constexpr double in_plane = 1e-6;

std::string name_of_component(const Network& network, int component) {
  const int dim = network.dim();
  if (component < dim) return fmt::format("displacement along {}", "xyz"[component]);
  return dim == 2 ? "rotation" : fmt::format("rotation about {}", "xyz"[component - dim]);
}

/// Returns the motion component of a particle for an entry of SupportSection::fix.
int component_of(const Network& network, int entry) {
  return entry < 3 || network.dim() == 3 ? entry : network.dim();
}

void prescribe(const CaseFile& input, const Model& model, Prescription& prescription,
               std::span<const Index> particles, const std::string& key, int component,
               const PositionField& values, double factor = 1.0) {
  for (const Index i : particles) {
    const std::size_t slot = static_cast<std::size_t>(i) * model.network.width() + component;
    const std::span<const double> x = model.network.places().position(i);
    const double value = factor * values.at(x)[0];
    const double before = prescription.value[slot];
    if (prescription.held[slot]) {
      const double largest = std::max(std::abs(value), std::abs(before));
      if (std::abs(value - before) <= same_value * largest) continue;
      throw InputError(
          input.where(key),
          fmt::format(
              "sets the {} of the particle at ({}) to {}, where another entry sets it to {}",
              name_of_component(model.network, component), joined(x), value, before),
          "separate the regions of [[supports]], [[symmetry]], [[displacements]] "
          "and [[velocities]], or give equal values where they overlap");
    }
    prescription.held[slot] = 1;
    prescription.value[slot] = value;
  }
}

/// Refuses prescribed rotations of particles without rotational stiffness.
void refuse_idle_rotation(const CaseFile& input, const Model& model,
                          std::span<const Index> particles, const std::string& key, int component) {
  if (component < model.network.dim()) return;
  const std::vector<std::uint8_t> rotating = rotating_particles(model.network);
  const auto turns = [&](Index i) { return !rotating.empty() && rotating[i] != 0; };
  if (particles.empty() || std::any_of(particles.begin(), particles.end(), turns)) return;
  if (!model.network.hinged.empty()) {
    throw InputError(input.where(key),
                     "prescribes rotations of particles without rotation: they lie in the "
                     "interface of two layers",
                     "prescribe rotations of the particles beside the interface");
  }
  throw InputError(input.where(key),
                   "prescribes rotations of particles whose bonds have no rotational "
                   "stiffness",
                   "prescribe displacements by formulas that rotate the region");
}

void clamped(const Network& network, Prescription& prescription, std::span<const Index> particles,
             int component) {
  if (component >= network.dim()) return;  // a rotation
  for (const Index i : particles) prescription.gripped[i] = 1;
}

/// Refuses planes of symmetry off the faces of the body.
/// \param inside  particles in the plane
void refuse_inner_plane(const CaseFile& input, const Model& model, std::size_t k,
                        std::span<const Index> inside) {
  const SymmetrySection& section = input.symmetry[k];
  if (!section.at) return;
  const Particles& particles = model.network.places();
  double nearest = INFINITY, low = INFINITY, high = -INFINITY;
  for (Index i = 0; i < particles.size(); ++i) {
    if (!is_material(particles.kind[i])) continue;
    const double coordinate = particles.position(i)[section.axis];
    low = std::min(low, coordinate);
    high = std::max(high, coordinate);
    if (std::abs(coordinate - *section.at) < std::abs(nearest - *section.at)) nearest = coordinate;
  }
  if (inside.empty()) {
    throw InputError(
        input.where(item_key("symmetry", k, "at")),
        fmt::format("is {}, but no particle lies in that plane", *section.at),
        fmt::format("the nearest particle has {} = {:.6g}", "xyz"[section.axis], nearest));
  }
  const double width = in_plane * model.lattice.spacing;
  if (low < *section.at - width && high > *section.at + width) {
    throw InputError(
        input.where(item_key("symmetry", k, "at")),
        fmt::format("is {}, but the body lies on both sides of that plane", *section.at),
        fmt::format("give a face: {0} = {1:.6g} or {0} = {2:.6g}", "xyz"[section.axis], low, high));
  }
}

/// Applies a plane of symmetry. Displacements in the plane and the rotation about its normal are
/// free.
void hold_in_plane(const CaseFile& input, const Model& model, std::size_t k,
                   Prescription& prescription) {
  const std::vector<Index> particles = particles_of_plane(input, model, k);
  refuse_inner_plane(input, model, k, particles);
  const std::string key = item_key("symmetry", k);
  const Expression zero;
  const PositionField values(input, key, {&zero, 1});
  const int axis = input.symmetry[k].axis;
  const int dim = model.network.dim();
  prescribe(input, model, prescription, particles, key, axis, values);
  prescription.kept[axis] = true;
  for (int component = dim; component < model.network.width(); ++component) {
    if (dim == 3 && component - dim == axis) continue;
    prescribe(input, model, prescription, particles, key, component, values);
  }
}

/// Records that a boundary region prescribes a component of particles with known values.
void note_driven(const Network& network, Prescription& prescription,
                 std::span<const Index> particles, int component, const std::string& region) {
  PrescribedRegion& place = place_named(prescription.driven, region);
  for (const Index i : particles) {
    const std::size_t slot = static_cast<std::size_t>(i) * network.width() + component;
    const double value = prescription.value[slot];
    const bool first = !place.drives[component];
    place.low[component] = first ? value : std::min(place.low[component], value);
    place.high[component] = first ? value : std::max(place.high[component], value);
    place.drives[component] = true;
    place.slots.push_back(slot);
  }
}

/// Whether a stage follows another one.
bool comes_after(const CaseFile& input, const std::string& stage, const std::string& other) {
  for (const StageSection& section : input.stages) {
    if (section.name == stage) return false;
    if (section.name == other) return true;
  }
  return false;
}

/// \param factor  displacement over the values of the sections
/// \param stage   see collect_prescriptions()
void drive(const CaseFile& input, const Model& model, Prescription& prescription,
           const std::string& table, const std::vector<DisplacementSection>& sections,
           double factor, const std::string& stage = "") {
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const bool rests = !stage.empty() && sections[k].stage != stage;
    if (rests && comes_after(input, sections[k].stage, stage)) continue;
    const std::vector<Index> particles =
        particles_of_region(input, model, sections[k].region, item_key(table, k, "region"));
    for (int entry = 0; entry < 6; ++entry) {
      const auto& value = sections[k].value[entry];
      if (!value) continue;
      const std::string name = motion_name(model.network.dim(), entry);
      const PositionField values(input, item_key(table, k, name), {&*value, 1});
      const int component = component_of(model.network, entry);
      if (!value->is_zero()) {
        refuse_idle_rotation(input, model, particles, item_key(table, k, name), component);
      }
      prescribe(input, model, prescription, particles, item_key(table, k), component, values,
                rests ? 0.0 : factor);
      if (rests) {
        prescription.kept[component] = true;
      } else {
        note_driven(model.network, prescription, particles, component, sections[k].region);
      }
      clamped(model.network, prescription, particles, component);
    }
  }
}

/// Prescribes displacements of the embedded points of bars with a prestrain.
void stretch_bars(const CaseFile& input, const Model& model, const std::string& stage,
                  Prescription& prescription) {
  const Network& network = model.network;
  double stretched = 0.0;
  for (std::size_t s = 0; s < network.bars.bar.size(); ++s) {
    const RebarSection& bar = input.rebar[model.entry_of_bar[network.bars.bar[s]]];
    if (bar.prestrain == 0.0 || (!stage.empty() && bar.stage != stage)) continue;
    const Index e = network.first_bar_element + static_cast<Index>(s);
    const double extension = bar.prestrain * network.bonds.length(e);
    const std::size_t slot = static_cast<std::size_t>(network.bonds.second[e]) * network.width();
    for (int a = 0; a < network.dim(); ++a) {
      prescription.value[slot + a] = extension * network.bonds.direction(e)[a];
    }
    stretched = (network.bars.continues(s) ? stretched : 0.0) + std::abs(extension);
    prescription.stretched = std::max(prescription.stretched, stretched);
  }
}

}  // namespace

Prescription collect_prescriptions(const CaseFile& input, const Model& model,
                                   const std::string& stage) {
  const std::size_t width = model.network.width();
  Prescription prescription;
  prescription.held.assign(width * model.network.places().size(), 0);
  prescription.value.assign(prescription.held.size(), 0.0);
  prescription.gripped.assign(static_cast<std::size_t>(model.network.places().size()), 0);
  for (std::size_t k = 0; k < input.supports.size(); ++k) {
    const Expression zero;
    const PositionField values(input, item_key("supports", k), {&zero, 1});
    const std::vector<Index> particles = particles_of_region(input, model, input.supports[k].region,
                                                             item_key("supports", k, "region"));
    for (int entry = 0; entry < 6; ++entry) {
      if (!input.supports[k].fix[entry]) continue;
      const int component = component_of(model.network, entry);
      prescribe(input, model, prescription, particles, item_key("supports", k), component, values);
      prescription.kept[component] = true;
      clamped(model.network, prescription, particles, component);
    }
  }
  for (std::size_t k = 0; k < input.symmetry.size(); ++k) {
    hold_in_plane(input, model, k, prescription);
  }
  drive(input, model, prescription, "displacements", input.displacements, 1.0, stage);
  stretch_bars(input, model, stage, prescription);
  drive(input, model, prescription, "velocities", input.velocities, input.analysis.duration);
  return prescription;
}

std::vector<double> collect_springs(const CaseFile& input, const Model& model) {
  if (input.springs.empty()) return {};
  const Particles& particles = model.network.places();
  const std::size_t width = model.network.width();
  std::vector<double> stiffness(width * particles.size(), 0.0);
  for (std::size_t k = 0; k < input.springs.size(); ++k) {
    const SpringSection& section = input.springs[k];
    const std::string key = item_key("springs", k, "region");
    const std::vector<Index> inside = particles_of_region(input, model, section.region, key);
    std::vector<double> shares(static_cast<std::size_t>(particles.size()), 0.0);
    double whole = 1.0;
    if (section.stiffness) {
      for (const Index facet : facets_of_region(input, model, section.region, key)) {
        const std::span<const Index> corners = model.facets.corners.row(facet);
        double square = 0.0;
        for (const double component : model.facets.area_vector(facet)) {
          square += component * component;
        }
        for (const Index i : corners) {
          shares[i] += std::sqrt(square) / static_cast<double>(corners.size());
        }
      }
    } else {
      whole = 0.0;
      for (const Index i : inside) {
        if (particles.kind[i] != ParticleKind::solid) continue;
        whole += shares[i] = particles.volumes[i];
      }
    }
    const Vector3& along = section.stiffness ? *section.stiffness : *section.total;
    for (Index i = 0; i < particles.size(); ++i) {
      for (int a = 0; a < particles.dim; ++a) {
        stiffness[i * width + a] += along[a] * shares[i] / whole;
      }
    }
  }
  return stiffness;
}

namespace {

/// Stiffness of the springs over that of the stiffest bond: far above the round-off of a factor,
/// with negligible forces.
constexpr double softness = 1e-7;

/// Marks the particles with loads in any stage.
std::vector<std::uint8_t> loaded_particles(const CaseFile& input, const Model& model) {
  const std::size_t width = model.network.width();
  std::vector<std::uint8_t> loaded(static_cast<std::size_t>(model.network.particles.size()), 0);
  const auto mark = [&](const Loads& loads) {
    for (std::size_t slot = 0; slot < loads.forces.size(); ++slot) {
      if (loads.forces[slot] != 0.0) loaded[slot / width] = 1;
    }
  };
  mark(model.loads);
  for (const StageSection& stage : input.stages) {
    mark(collect_loads(input, model, model.network.width(), stage.loads).loads);
  }
  return loaded;
}

/// Returns, per particle, the first pre-crack that cuts one of its bonds, else the number of
/// pre-cracks.
std::vector<std::size_t> cracks_beside(const Model& model, std::span<const Index> particles) {
  const Particles& all = model.network.places();
  std::vector<CrackCutter> cutters;
  for (const Crack& crack : model.cracks) {
    cutters.emplace_back(std::span(&crack, 1), all.dim, model.lattice.spacing);
  }
  std::vector<double> places;
  for (const Index i : particles) {
    const auto at = all.position(i);
    places.insert(places.end(), at.begin(), at.end());
  }
  const Csr near = find_neighbors(all.positions, places, all.dim, model.horizon);
  std::vector<std::size_t> first;
  for (std::size_t q = 0; q < particles.size(); ++q) {
    const Vector3 from = point_of(all.positions, all.dim, particles[q]);
    const auto cuts = [&](const CrackCutter& cutter) {
      return std::ranges::any_of(near.row(static_cast<Index>(q)), [&](Index j) {
        return cutter.cuts(from, point_of(all.positions, all.dim, j));
      });
    };
    first.push_back(std::ranges::find_if(cutters, cuts) - cutters.begin());
  }
  return first;
}

/// Adds springs to the fewest components that hold the part.
void add_springs(const Model& model, const Fragment& part, const std::vector<std::uint8_t>& held,
                 std::vector<double>& springs) {
  const Network& network = model.network;
  const double stiffest = *std::max_element(network.stiffness.begin(),
                                            network.stiffness.begin() + network.first_slip_spring);
  std::vector<std::uint8_t> pinned = held;
  pin_rigid_modes(network, part, pinned);
  const std::size_t width = network.width(), dim = network.dim();
  for (const Index i : part.particles) {
    for (std::size_t slot = i * width; slot < (i + 1) * width; ++slot) {
      if (pinned[slot] == held[slot]) continue;
      const double lever = slot % width < dim ? 1.0 : model.horizon;
      springs[slot] = softness * stiffest * lever * lever;
    }
  }
}

}  // namespace

CutOffParts find_cut_off_parts(const CaseFile& input, const Model& model,
                               const Prescription& prescription) {
  constexpr std::size_t most_places = 5;
  const Network& network = model.network;
  CutOffParts off;
  off.particles.assign(static_cast<std::size_t>(network.particles.size()), 0);
  if (model.cracks.empty() || network.has_states()) return off;
  std::vector<Fragment> parts = find_loose_parts(network, prescription.held);
  if (parts.empty()) return off;
  std::vector<std::uint8_t> loaded = loaded_particles(input, model);
  for (std::size_t slot = 0; slot < prescription.held.size(); ++slot) {
    if (prescription.held[slot] != 0 && prescription.value[slot] != 0.0) {
      loaded[slot / network.width()] = 1;
    }
  }
  std::erase_if(parts, [&](const Fragment& part) {
    return std::ranges::any_of(part.particles, [&](Index i) { return loaded[i] != 0; }) ||
           crack_beside(model, part.particles).empty();
  });
  if (parts.empty()) return off;
  off.springs.assign(prescription.held.size(), 0.0);
  std::vector<std::string> places;
  std::size_t count = 0;
  for (const Fragment& part : parts) {
    add_springs(model, part, prescription.held, off.springs);
    for (const Index i : part.particles) off.particles[i] = 1;
    count += part.particles.size();
    const auto at = network.places().position(part.particles.front());
    if (places.size() < most_places) places.push_back(fmt::format("({})", joined(at)));
  }
  off.note = fmt::format(
      "cracks leave {} unsupported, in {} at {}{}: no load "
      "acts on them, and springs of {:.0e} times the stiffest bond hold them "
      "in place",
      counted(count, "particle"), counted(parts.size(), "part"), joined(places),
      parts.size() > most_places ? ", ..." : "", softness);
  return off;
}

std::string crack_beside(const Model& model, std::span<const Index> particles) {
  const std::vector<std::size_t> beside = cracks_beside(model, particles);
  const auto first = std::ranges::find_if(beside, [&](auto k) { return k < model.cracks.size(); });
  return first == beside.end() ? "" : item_key("cracks", model.entry_of_crack[*first]);
}

}  // namespace perilink
