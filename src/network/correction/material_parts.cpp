#include "network/correction/material_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "discretization/cuts/outside_bonds.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "material/critical_stretch.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// Largest unbalanced force of calibrated parts, over the force on a cell, in the mean over the
/// particles on joints.
constexpr double balanced = 0.15;

/// Returns the number of the bond between two particles at or after bond `at`.
Index find_bond(const Bonds& bonds, Index at, Index i, Index j) {
  while (bonds.first[at] != i || bonds.second[at] != j) ++at;
  return at;
}

/// Bonds and facets of one stiffness, by the particles of the whole body.
struct Piece {
  Index material = 0;            // the first with this stiffness
  std::vector<Index> materials;  // per particle; no_index: does not belong to the piece
  Bonds bonds;                   // that stay within the piece
  Facets facets;                 // surface and joints, with normals outwards
  std::vector<Index> facet_of;   // facet of the whole body, per facet
};

/// Divides a body along its joints.
class Division {
 public:
  Division(const Body& body, const NetworkInput& input, const Network& whole);
  bool has_joints() const { return !has_tied_cells_ && std::ranges::count(on_joint_, 1) > 0; }
  std::vector<MaterialPart> make() const;

 private:
  Index like(Index material) const {
    return material == no_index ? no_index : first_like_[material];
  }
  bool is_joint(Index facet) const {
    const Facets& facets = whole_.facets;
    return !facets.on_surface(facet) && like(facets.inside[facet]) != like(facets.outside[facet]);
  }
  Piece piece_of(Index material) const;
  void add_facets(Piece& piece) const;
  std::vector<std::vector<double>> volumes_of(const std::vector<Piece>& pieces) const;
  MaterialPart part_of(const Piece& piece, const std::vector<double>& volumes) const;
  void add_bonds(const Piece& piece, const std::vector<Index>& number, MaterialPart& part) const;

  const Body& body_;
  const NetworkInput& input_;
  const Network& whole_;
  std::vector<Index> first_like_;  // per material: the first one of its stiffness
  std::vector<MicropolarModuli> moduli_;
  std::vector<std::uint8_t> on_joint_;  // per particle
  bool has_tied_cells_ = false;
};

Division::Division(const Body& body, const NetworkInput& input, const Network& whole)
    : body_(body), input_(input), whole_(whole) {
  std::vector<LameConstants> constants;
  for (const SolidMaterial& m : input.materials) {
    constants.push_back(lame_constants(input, m));
    const auto same = std::ranges::find(constants, constants.back());
    first_like_.push_back(static_cast<Index>(same - constants.begin()));
    moduli_.push_back(moduli_of(body, input, m));
  }
  on_joint_.assign(static_cast<std::size_t>(whole.particles.size()), 0);
  for (Index f = 0; f < whole.facets.size(); ++f) {
    has_tied_cells_ = has_tied_cells_ || whole.facets.is_tied(f);
    if (!is_joint(f)) continue;
    for (const Index i : whole.facets.corners.row(f)) on_joint_[i] = 1;
  }
}

/// Adds the facets, and their particles on joints.
void Division::add_facets(Piece& piece) const {
  const Facets& facets = whole_.facets;
  piece.facets.dim = facets.dim;
  for (Index f = 0; f < facets.size(); ++f) {
    const Index inside = facets.inside[f], outside = facets.outside[f];
    const bool is_inside = like(inside) == piece.material;
    if (is_inside == (like(outside) == piece.material)) continue;
    for (const Index i : facets.corners.row(f)) {
      if (is_joint(f)) piece.materials[i] = is_inside ? inside : outside;
    }
    const Vector3 area = point_of(facets.area_vectors, facets.dim, f);
    piece.facets.append(facets.corners.row(f), is_inside ? area : minus({}, area), piece.material,
                        no_index);
    piece.facets.tied.push_back(is_joint(f) ? 1 : 0);
    piece.facet_of.push_back(f);
  }
}

Piece Division::piece_of(Index material) const {
  const Particles& particles = whole_.particles;
  Piece piece{material, {}, {}, {}, {}};
  for (Index i = 0; i < particles.size(); ++i) {
    const Index own = particles.material[i];
    piece.materials.push_back(on_joint_[i] == 0 && like(own) == material ? own : no_index);
  }
  add_facets(piece);
  piece.bonds.dim = particles.dim;
  for (Index b = 0; b < whole_.bonds.size(); ++b) {
    const Index i = whole_.bonds.first[b], j = whole_.bonds.second[b];
    if (piece.materials[i] == no_index || piece.materials[j] == no_index) continue;
    piece.bonds.append(i, j, whole_.bonds.length(b), whole_.bonds.direction(b));
  }
  remove_bonds_outside(particles, piece.bonds, piece.facets, body_.lattice.spacing);
  return piece;
}

/// Returns the volume of each particle in each piece. Lattices divide a particle on a joint like
/// its bonds.
std::vector<std::vector<double>> Division::volumes_of(const std::vector<Piece>& pieces) const {
  std::vector<std::vector<double>> volumes;
  if (body_.cells.size() > 0) {
    for (const Piece& piece : pieces) {
      Simplices cells{whole_.particles.dim, {}, {}};
      for (Index c = 0; c < body_.cells.size(); ++c) {
        if (like(body_.cells.material[c]) != piece.material) continue;
        cells.material.push_back(piece.material);
        const auto corners = body_.cells.cell(c);
        cells.vertices.insert(cells.vertices.end(), corners.begin(), corners.end());
      }
      volumes.push_back(shape_integrals(cells, whole_.particles.positions, input_.thickness));
    }
    return volumes;
  }
  std::vector<double> owners(static_cast<std::size_t>(whole_.bonds.size()), 0.0);
  const auto visit = [&](const Piece& piece, const auto& use) {
    Index at = 0;
    for (Index b = 0; b < piece.bonds.size(); ++b) {
      const Index i = piece.bonds.first[b], j = piece.bonds.second[b];
      at = find_bond(whole_.bonds, at, i, j);
      use(at, i, j);
    }
  };
  for (const Piece& piece : pieces) {
    visit(piece, [&](Index bond, Index, Index) { owners[bond] += 1.0; });
  }
  std::vector<double> sums(on_joint_.size(), 0.0);
  for (const Piece& piece : pieces) {
    std::vector<double>& own = volumes.emplace_back(on_joint_.size(), 0.0);
    visit(piece, [&](Index bond, Index i, Index j) {
      for (const Index end : {i, j}) own[end] += 1.0 / owners[bond];
    });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += own[i];
  }
  for (std::vector<double>& own : volumes) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      own[i] *= whole_.particles.volumes[i] / std::max(sums[i], 1.0);
    }
  }
  return volumes;
}

/// Adds the bonds with moduli and volumes of the part and the critical stretches of its continuum.
/// Bonds that carry moments are hinged at particles on joints.
void Division::add_bonds(const Piece& piece, const std::vector<Index>& number,
                         MaterialPart& part) const {
  Network& network = part.network;
  network.bonds.dim = whole_.particles.dim;
  network.torsion = whole_.torsion;
  const std::vector<double>& volumes = network.particles.volumes;
  const auto over_mean = [&](double MicropolarModuli::*modulus, Index i, Index j) {
    const std::vector<Index>& material = whole_.particles.material;
    const double mean = 0.5 * (moduli_[material[i]].*modulus + moduli_[material[j]].*modulus);
    return mean > 0.0 ? moduli_[piece.material].*modulus / mean : 0.0;
  };
  Index at = 0;
  for (Index b = 0; b < piece.bonds.size(); ++b) {
    const Index i = piece.bonds.first[b], j = piece.bonds.second[b];
    at = find_bond(whole_.bonds, at, i, j);
    network.bonds.append(number[i], number[j], piece.bonds.length(b), piece.bonds.direction(b));
    const double shares = volumes[number[i]] / whole_.particles.volumes[i] *
                          (volumes[number[j]] / whole_.particles.volumes[j]);
    network.stiffness.push_back(whole_.stiffness[at] * shares *
                                over_mean(&MicropolarModuli::micromodulus, i, j));
    if (!input_.elastic) {
      auto [first, second] = materials_of_bond(whole_, at);
      if (on_joint_[i] != 0) first = piece.materials[i];
      if (on_joint_[j] != 0) second = piece.materials[j];
      network.materials_of.push_back({first, second});
      network.critical_stretch.push_back(continuum_critical_stretch(
          input_.problem, energy_between(input_.materials[first], input_.materials[second]),
          moduli_[piece.material].micromodulus, input_.horizon, input_.thickness));
    }
    if (!whole_.carries_moments()) continue;
    network.bending.push_back(whole_.bending[at] * shares *
                              over_mean(&MicropolarModuli::bending_modulus, i, j));
    network.hinged.push_back(static_cast<std::uint8_t>((on_joint_[i] != 0 ? first_end : 0) |
                                                       (on_joint_[j] != 0 ? second_end : 0)));
  }
}

MaterialPart Division::part_of(const Piece& piece, const std::vector<double>& volumes) const {
  MaterialPart part;
  part.body.lattice = body_.lattice;
  Particles& particles = part.body.particles;
  particles.dim = whole_.particles.dim;
  std::vector<Index> number(piece.materials.size(), no_index);
  for (Index i = 0; i < whole_.particles.size(); ++i) {
    if (piece.materials[i] == no_index) continue;
    number[i] = particles.size();
    part.particle_of.push_back(i);
    const auto x = whole_.particles.position(i);
    particles.positions.insert(particles.positions.end(), x.begin(), x.end());
    particles.volumes.push_back(volumes[i]);
    particles.material.push_back(piece.materials[i]);
  }
  particles.kind.assign(part.particle_of.size(), ParticleKind::solid);
  part.network.particles = particles;
  part.network.facets = piece.facets;
  for (Index& corner : part.network.facets.corners.values) corner = number[corner];
  part.facet_of = piece.facet_of;
  add_bonds(piece, number, part);
  return part;
}

std::vector<MaterialPart> Division::make() const {
  std::vector<Piece> pieces;
  for (std::size_t m = 0; m < first_like_.size(); ++m) {
    const auto material = static_cast<Index>(m);
    if (first_like_[m] == material) pieces.push_back(piece_of(material));
  }
  std::erase_if(pieces, [](const Piece& piece) { return piece.bonds.size() == 0; });
  const std::vector<std::vector<double>> volumes = volumes_of(pieces);
  std::vector<MaterialPart> parts;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    parts.push_back(part_of(pieces[p], volumes[p]));
  }
  return parts;
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

/// Adds stiffnesses and facet fractions of a part to the body. Each bond with moments belongs to a
/// single part.
void put_back(const MaterialPart& part, NewBonds& made, Network& whole) {
  const Bonds& bonds = part.network.bonds;
  Index at = 0;
  for (Index b = 0; b < bonds.size(); ++b) {
    at = find_bond(whole.bonds, at, part.particle_of[bonds.first[b]],
                   part.particle_of[bonds.second[b]]);
    const double own = part.network.stiffness[b];
    double& stiffness = made.stiffness[at];
    const bool again = stiffness > 0.0;  // along a joint: the bond is in both parts
    if (!made.stretch.empty()) {
      const double limit = part.network.critical_stretch[b];
      double& stretch = made.stretch[at];
      const double held = stiffness * stretch * stretch + own * limit * limit;
      stretch = again ? in_few_steps(std::sqrt(held / (stiffness + own))) : limit;
    }
    stiffness += own;
    if (!whole.materials_of.empty()) {
      const auto [first, second] = part.network.materials_of[b];
      whole.materials_of[at] = {again ? whole.materials_of[at][0] : first, second};
    }
    if (!whole.carries_moments()) continue;
    whole.bending[at] = part.network.bending[b];
    whole.inflection[at] = part.network.inflection[b];
    whole.hinged[at] = part.network.hinged[b];
    if (!whole.bending_ratio.empty()) whole.bending_ratio[at] = part.network.bending_ratio[b];
  }
  const Facets& facets = part.network.facets;
  for (Index f = 0; f < facets.size(); ++f) {
    if (facets.is_tied(f)) continue;
    std::copy(facets.shares.begin() + facets.corners.offsets[f],
              facets.shares.begin() + facets.corners.offsets[f + 1],
              whole.facets.shares.begin() + whole.facets.corners.offsets[part.facet_of[f]]);
  }
}

void add_report(const MaterialPart& part, CalibrationReport& sum) {
  const CalibrationReport& own = *part.network.report.calibration;
  if (own.residual_after >= sum.residual_after && own.worst_particle != no_index) {
    sum.worst_particle = part.particle_of[own.worst_particle];
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

std::vector<MaterialPart> cut_parts(const Body& body, const NetworkInput& input,
                                    const Network& whole) {
  const Division division(body, input, whole);
  return division.has_joints() ? division.make() : std::vector<MaterialPart>{};
}

bool calibrate_parts(const Body& body, const NetworkInput& input, const PartCalibration& calibrate,
                     Network& whole) {
  std::vector<MaterialPart> parts = cut_parts(body, input, whole);
  if (parts.size() < 2) return false;
  double particles_on_joints = -static_cast<double>(whole.particles.size());
  for (const MaterialPart& part : parts) {
    particles_on_joints += static_cast<double>(part.particle_of.size());
  }
  CalibrationReport report;
  report.in_parts = true;
  for (MaterialPart& part : parts) {
    calibrate(part.body, part.network);
    add_report(part, report);
    if (!(report.sum_after <= balanced * particles_on_joints)) return false;
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
  for (const MaterialPart& part : parts) put_back(part, made, whole);
  whole.stiffness = std::move(made.stiffness);
  whole.critical_stretch = std::move(made.stretch);
  whole.report.calibration = report;
  std::vector<std::uint8_t> keep;
  for (const double k : whole.stiffness) keep.push_back(k > 0.0 ? 1 : 0);
  keep_elements(whole, keep);
  return true;
}

}  // namespace perilink
