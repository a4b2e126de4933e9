#include "network/correction/layered_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "discretization/lattices/triangulate.hpp"
#include "material/critical_stretch.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// Largest unbalanced force of calibrated layers, over the force on a cell, in the mean over the
/// particles in the planes.
constexpr double balanced = 0.15;

enum class Side : std::uint8_t { none, inside, outside };

/// Selects the particles, facets and bonds of a layer.
class Cut {
 public:
  Cut(const Body& body, const NetworkInput& input, const Network& whole, const Joint& joint,
      std::size_t layer)
      : body_(body), input_(input), whole_(whole), joint_(joint), layer_(layer) {
    for (const SolidMaterial& m : input.materials) {
      constants_.push_back(lame_constants(input, m));
      moduli_.push_back(moduli_of(body, input, m));
    }
  }

  LayerBody make();

 private:
  const LameConstants& own() const { return constants_[joint_.layers[layer_]]; }
  double height(Index particle) const { return joint_.height(whole_.particles.position(particle)); }
  double facet_height(Index facet) const;
  bool between_planes(double height) const;
  Side side_of(Index facet) const;
  void choose_particles(LayerBody& cut);
  void add_facets(LayerBody& cut) const;
  void measure(LayerBody& cut) const;
  void add_bonds(LayerBody& cut) const;

  const Body& body_;
  const NetworkInput& input_;
  const Network& whole_;
  const Joint& joint_;
  std::size_t layer_;
  std::vector<LameConstants> constants_;
  std::vector<MicropolarModuli> moduli_;
  std::vector<Index> number_;         // per particle: number in the layer, no_index outside
  std::vector<std::uint8_t> shared_;  // per particle: whether a neighbouring layer shares it
};

double Cut::facet_height(Index facet) const {
  const Vector3 centre = whole_.facets.centre(facet, whole_.particles.positions);
  return joint_.height({centre.data(), static_cast<std::size_t>(joint_.dim)});
}

bool Cut::between_planes(double height) const {
  const bool above = layer_ == 0 || height >= joint_.planes[layer_ - 1] - joint_.tolerance;
  return above &&
         (layer_ == joint_.planes.size() || height <= joint_.planes[layer_] + joint_.tolerance);
}

/// Returns the side of a facet on which the layer lies; none also where it is on both sides.
Side Cut::side_of(Index facet) const {
  const Index inside = whole_.facets.inside[facet], outside = whole_.facets.outside[facet];
  if (!between_planes(facet_height(facet))) return Side::none;
  const bool is_inside = constants_[inside] == own();
  if (outside == no_index) return is_inside ? Side::inside : Side::none;
  const bool is_outside = constants_[outside] == own();
  if (is_inside == is_outside) return Side::none;
  return is_inside ? Side::inside : Side::outside;
}

/// Selects particles between the planes, and corners of the layer's facets, with the material of
/// the layer.
void Cut::choose_particles(LayerBody& cut) {
  const auto count = static_cast<std::size_t>(whole_.particles.size());
  std::vector<std::uint8_t> member(count, 0);
  shared_.assign(count, 0);
  for (Index i = 0; i < whole_.particles.size(); ++i) {
    member[i] = between_planes(height(i)) && !joint_.in_plane(height(i)) ? 1 : 0;
  }
  std::vector<Index> material = whole_.particles.material;
  for (Index f = 0; f < whole_.facets.size(); ++f) {
    const Side side = side_of(f);
    if (side == Side::none) continue;
    for (const Index i : whole_.facets.corners.row(f)) {
      member[i] = 1;
      if (whole_.facets.on_surface(f)) continue;
      shared_[i] = 1;
      material[i] = side == Side::inside ? whole_.facets.inside[f] : whole_.facets.outside[f];
    }
  }
  number_.assign(count, no_index);
  Particles& particles = cut.body.particles;
  particles.dim = joint_.dim;
  for (Index i = 0; i < whole_.particles.size(); ++i) {
    if (member[i] == 0) continue;
    number_[i] = particles.size();
    cut.particle_of.push_back(i);
    const auto x = whole_.particles.position(i);
    particles.positions.insert(particles.positions.end(), x.begin(), x.end());
    particles.volumes.push_back(whole_.particles.volumes[i]);
    particles.material.push_back(material[i]);
  }
  particles.kind.assign(cut.particle_of.size(), ParticleKind::solid);
}

void Cut::add_facets(LayerBody& cut) const {
  Facets& facets = cut.network.facets;
  facets.dim = joint_.dim;
  for (Index f = 0; f < whole_.facets.size(); ++f) {
    const Side side = side_of(f);
    if (side == Side::none) continue;
    std::vector<Index> corners;
    for (const Index i : whole_.facets.corners.row(f)) corners.push_back(number_[i]);
    Vector3 area{};
    for (int a = 0; a < joint_.dim; ++a) {
      const double outwards = whole_.facets.area_vector(f)[a];
      area[a] = side == Side::inside ? outwards : -outwards;
    }
    facets.append(corners, area, joint_.layers[layer_], no_index);
    facets.tied.push_back(whole_.facets.on_surface(f) ? 0 : 1);
    cut.facet_of.push_back(f);
  }
}

/// Sets volumes: each side has half of a particle in a plane of a lattice.
void Cut::measure(LayerBody& cut) const {
  Particles& particles = cut.body.particles;
  if (body_.cells.size() == 0) {
    for (std::size_t i = 0; i < cut.particle_of.size(); ++i) {
      if (shared_[cut.particle_of[i]] != 0) particles.volumes[i] *= 0.5;
    }
    return;
  }
  Simplices cells;
  cells.dim = joint_.dim;
  for (Index c = 0; c < body_.cells.size(); ++c) {
    double middle = 0.0;
    for (const Index i : body_.cells.cell(c)) middle += height(i) / (joint_.dim + 1.0);
    if (!between_planes(middle)) continue;
    cells.material.push_back(joint_.layers[layer_]);
    for (const Index i : body_.cells.cell(c)) cells.vertices.push_back(number_[i]);
  }
  particles.volumes = shape_integrals(cells, particles.positions, input_.thickness);
}

/// Adds the bonds with moduli and volumes of the layer and the critical stretches of its continuum.
/// Bonds that carry moments are hinged at particles in a plane.
void Cut::add_bonds(LayerBody& cut) const {
  Network& layer = cut.network;
  layer.bonds.dim = joint_.dim;
  layer.torsion = whole_.torsion;
  const auto share = [&](Index i) {
    return layer.particles.volumes[number_[i]] / whole_.particles.volumes[i];
  };
  const auto over_mean = [&](double MicropolarModuli::*modulus, Index i, Index j) {
    const std::vector<Index>& material = whole_.particles.material;
    const double mean = 0.5 * (moduli_[material[i]].*modulus + moduli_[material[j]].*modulus);
    return mean > 0.0 ? moduli_[joint_.layers[layer_]].*modulus / mean : 0.0;
  };
  const auto stretch = [&](Index bond) {
    const auto material = [&](Index i) { return input_.materials[layer.particles.material[i]]; };
    return continuum_critical_stretch(
        input_.problem,
        energy_between(material(layer.bonds.first[bond]), material(layer.bonds.second[bond])),
        moduli_[joint_.layers[layer_]].micromodulus, input_.horizon, input_.thickness);
  };
  for (Index b = 0; b < whole_.bonds.size(); ++b) {
    const Index i = whole_.bonds.first[b], j = whole_.bonds.second[b];
    if (number_[i] == no_index || number_[j] == no_index) continue;
    layer.bonds.append(layer.particles, number_[i], number_[j]);
    const double part = share(i) * share(j);
    layer.stiffness.push_back(whole_.stiffness[b] * part *
                              over_mean(&MicropolarModuli::micromodulus, i, j));
    if (!input_.elastic) layer.critical_stretch.push_back(stretch(layer.bonds.size() - 1));
    if (!whole_.carries_moments()) continue;
    layer.bending.push_back(whole_.bending[b] * part *
                            over_mean(&MicropolarModuli::bending_modulus, i, j));
    layer.hinged.push_back(static_cast<std::uint8_t>((shared_[i] != 0 ? first_end : 0) |
                                                     (shared_[j] != 0 ? second_end : 0)));
  }
}

LayerBody Cut::make() {
  LayerBody cut;
  cut.body.lattice = body_.lattice;
  choose_particles(cut);
  add_facets(cut);
  measure(cut);
  cut.network.particles = cut.body.particles;
  add_bonds(cut);
  return cut;
}

/// Rounds a stretch to one percent: every stretch of softening bonds needs its own law.
double in_few_steps(double stretch) {
  return std::exp(0.01 * std::round(100.0 * std::log(stretch)));
}

/// New stiffness and critical stretch of the body's bonds.
struct NewBonds {
  std::vector<double> stiffness;  // zero at first
  std::vector<double> stretch;    // critical stretch; may be empty
};

/// Adds stiffnesses and facet fractions of a layer to the body. Each bond with moments belongs to a
/// single layer.
void put_back(const LayerBody& layer, NewBonds& made, Network& whole) {
  const Bonds& bonds = layer.network.bonds;
  Index at = 0;  // both are sorted by their ends
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = layer.particle_of[bonds.first[b]], j = layer.particle_of[bonds.second[b]];
    while (whole.bonds.first[at] != i || whole.bonds.second[at] != j) ++at;
    const double own = layer.network.stiffness[b];
    double& stiffness = made.stiffness[at];
    const bool again = stiffness > 0.0;  // in a plane: the bond is in both layers
    if (!made.stretch.empty()) {
      const double limit = layer.network.critical_stretch[b];
      double& stretch = made.stretch[at];
      const double held = stiffness * stretch * stretch + own * limit * limit;
      stretch = again ? in_few_steps(std::sqrt(held / (stiffness + own))) : limit;
    }
    stiffness += own;
    if (!whole.materials_of.empty()) {
      const std::vector<Index>& material = layer.body.particles.material;
      const Index first = material[bonds.first[b]], second = material[bonds.second[b]];
      whole.materials_of[at] = {again ? whole.materials_of[at][0] : first, second};
    }
    if (!whole.carries_moments()) continue;
    whole.bending[at] = layer.network.bending[b];
    whole.inflection[at] = layer.network.inflection[b];
    whole.hinged[at] = layer.network.hinged[b];
    if (!whole.bending_ratio.empty()) whole.bending_ratio[at] = layer.network.bending_ratio[b];
  }
  const Facets& facets = layer.network.facets;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.is_tied(f)) continue;
    std::copy(facets.shares.begin() + facets.corners.offsets[f],
              facets.shares.begin() + facets.corners.offsets[f + 1],
              whole.facets.shares.begin() + whole.facets.corners.offsets[layer.facet_of[f]]);
  }
}

void add_report(const LayerBody& layer, CalibrationReport& sum) {
  const CalibrationReport& own = *layer.network.calibration;
  if (own.residual_after >= sum.residual_after && own.worst_particle != no_index) {
    sum.worst_particle = layer.particle_of[own.worst_particle];
  }
  sum.free_bonds += own.free_bonds;
  sum.residual_before = std::max(sum.residual_before, own.residual_before);
  sum.residual_after = std::max(sum.residual_after, own.residual_after);
  sum.moment_after = std::max(sum.moment_after, own.moment_after);
  sum.sum_after += own.sum_after;
  sum.unmet += own.unmet;
  sum.smallest_weight = std::min(sum.smallest_weight, own.smallest_weight);
  sum.largest_weight = std::max(sum.largest_weight, own.largest_weight);
  sum.at_least_weight += own.at_least_weight;
  sum.dropped += own.dropped;
  sum.iterations += own.iterations;
}

}  // namespace

LayerBody cut_layer(const Body& body, const NetworkInput& input, const Network& whole,
                    const Joint& joint, std::size_t layer) {
  return Cut(body, input, whole, joint, layer).make();
}

bool calibrate_layers(const Body& body, const NetworkInput& input, const Joint& joint,
                      const LayerCalibration& calibrate, Network& whole) {
  double particles_in_planes = 0.0;
  for (Index i = 0; i < whole.particles.size(); ++i) {
    if (joint.in_plane(joint.height(whole.particles.position(i)))) particles_in_planes += 1.0;
  }
  std::vector<LayerBody> layers;
  CalibrationReport report;
  report.layered = true;
  for (std::size_t k = 0; k < joint.layers.size(); ++k) {
    layers.push_back(cut_layer(body, input, whole, joint, k));
    calibrate(k, layers.back().body, layers.back().network);
    add_report(layers.back(), report);
    if (!(report.sum_after <= balanced * particles_in_planes)) return false;
  }
  const std::size_t count = whole.stiffness.size();
  NewBonds made{std::vector<double>(count, 0.0), {}};
  if (!input.elastic) made.stretch.assign(count, 0.0);
  if (!input.elastic &&
      std::any_of(input.materials.begin(), input.materials.end(),
                  [](const SolidMaterial& m) { return std::isfinite(m.fracture_energy); })) {
    whole.materials_of.assign(count, {no_index, no_index});
  }
  if (whole.carries_moments()) {
    whole.inflection.assign(count, 0.5);
    if (!input.elastic) whole.bending_ratio.assign(count, 0.0);
    whole.hinged.assign(count, 0);
  }
  for (const LayerBody& layer : layers) put_back(layer, made, whole);
  whole.stiffness = std::move(made.stiffness);
  whole.critical_stretch = std::move(made.stretch);
  whole.calibration = report;
  std::vector<std::uint8_t> keep;
  for (const double k : whole.stiffness) keep.push_back(k > 0.0 ? 1 : 0);
  keep_elements(whole, keep);
  return true;
}

}  // namespace perilink
