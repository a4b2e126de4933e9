#include "network/builder/bar_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "discretization/cuts/bonds_across_gaps.hpp"
#include "discretization/cuts/outside_bonds.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/neighbor_search.hpp"
#include "network/bond_strength.hpp"

namespace perilink {
namespace {

/// Length below which slip springs do not become stiffer, in spacings.
constexpr double shortest_slip_spring = 0.1;

/// Stiffness of rigid slip springs over the stiffness of the bar elements. Loads pass from the bar
/// to the solid within a third of a bar element.
constexpr double rigid = 10.0;

/// Flags nodes of bars with unbreakable slip springs.
std::vector<std::uint8_t> perfectly_tied(const RebarMesh& mesh, const NetworkInput& input,
                                         Index num_particles) {
  std::vector<std::uint8_t> perfect(static_cast<std::size_t>(num_particles), 0);
  for (Index segment = 0; segment < mesh.segments.size(); ++segment) {
    if (input.bar_materials[mesh.bar_of_element[segment]].slip_springs_break) continue;
    perfect[mesh.segments.first[segment]] = 1;
    perfect[mesh.segments.second[segment]] = 1;
  }
  return perfect;
}

/// Adds slip springs between bar nodes and the solid particles around them.
void add_bonded_slip_springs(const Body& body, const NetworkInput& input, RebarMesh& mesh,
                             const std::function<SlipSpringConstants(Index)>& constants_of,
                             Network& network) {
  const Particles& particles = network.particles;
  if (!input.cracks.empty()) {
    const CutBonds cut = find_cut_bonds(particles, mesh.ties, input.cracks, body.lattice.spacing);
    keep_bonds(mesh.ties, cut.keep);
  }
  const auto perfect = perfectly_tied(mesh, input, particles.size());
  const double least_length = shortest_slip_spring * body.lattice.spacing;
  for (Index tie = 0; tie < mesh.ties.size(); ++tie) {
    const Index solid = mesh.ties.first[tie];
    const Index node = mesh.ties.second[tie];
    const auto [micromodulus, stretch] = constants_of(particles.material[solid]);
    network.bonds.append(particles, solid, node);
    network.stiffness.push_back(micromodulus * particles.volumes[solid] * particles.volumes[node] /
                                std::max(mesh.ties.length(tie), least_length));
    add_critical_stretch(input, perfect[node] ? infinity : stretch, network);
  }
}

/// Returns the vectors from bar nodes to nearby particles of the solid that do not leave the solid.
Bonds ways_to_solid(const Body& body, const NetworkInput& input, const RebarMesh& mesh,
                    const Particles& particles) {
  const int dim = particles.dim;
  const auto num_solid = static_cast<Index>(
      std::find_if(particles.kind.begin(), particles.kind.end(),
                   [](ParticleKind kind) { return kind != ParticleKind::solid; }) -
      particles.kind.begin());
  std::vector<double> nodes;
  for (const BarNode& node : mesh.embedded) {
    const auto x = particles.position(node.particle);
    nodes.insert(nodes.end(), x.begin(), x.end());
  }
  const std::span<const double> solid(particles.positions.data(),
                                      static_cast<std::size_t>(num_solid) * dim);
  const Csr near = find_neighbors(solid, nodes, dim, embedded_point_reach * body.lattice.spacing);
  Bonds ways;
  ways.dim = dim;
  for (Index k = 0; k < near.rows(); ++k) {
    const auto x = particles.position(mesh.embedded[k].particle);
    const auto holds = [&](const Box& box) { return box.contains(x, 1e-6 * body.lattice.spacing); };
    if (!input.solid.empty() && std::none_of(input.solid.begin(), input.solid.end(), holds)) {
      continue;  // the node is outside the body
    }
    for (const Index i : near.row(k)) ways.append(particles, i, mesh.embedded[k].particle);
  }
  if (!input.cracks.empty()) {
    keep_bonds(ways, find_cut_bonds(particles, ways, input.cracks, body.lattice.spacing).keep);
  }
  Particles as_solid = particles;
  std::fill(as_solid.kind.begin(), as_solid.kind.end(), ParticleKind::solid);
  remove_bonds_across_gaps(as_solid, ways, input.solid, 1e-6 * body.lattice.spacing);
  if (body.lattice.pattern == Pattern::irregular) {
    remove_bonds_outside(as_solid, ways, body.facets, body.lattice.spacing);
  }
  return ways;
}

/// Returns unit vectors along the bar and across it.
std::vector<Vector3> frame_of(const Vector3& along, int dim) {
  if (dim == 2) return {along, {-along[1], along[0], 0.0}};
  Vector3 axis{};
  axis[std::min_element(along.begin(), along.end(),
                        [](double a, double b) { return std::abs(a) < std::abs(b); }) -
       along.begin()] = 1.0;
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  Vector3 first = cross(along, axis);
  const double length = norm(first);
  for (double& component : first) component /= length;
  return {along, first, cross(along, first)};
}

/// Stores the law of each bar once for all its elements.
class BarLaws {
 public:
  explicit BarLaws(Network& network) : network_(network) {}

  /// Assigns the law of its bar to the newest element.
  /// \param make  creates the law
  template <class Make>
  void give(Index bar, Make make) {
    if (bar != bar_) {
      bar_ = bar;
      number_ = static_cast<Index>(network_.laws.size());
      network_.laws.push_back(make());
    }
    network_.law_of.resize(network_.stiffness.size() - 1, 0);
    network_.law_of.push_back(number_);
  }

 private:
  Network& network_;
  Index bar_ = no_index, number_ = 0;
};

void append_element(Network& network, Index first, Index second, double length,
                    const Vector3& direction, double stiffness) {
  const auto dim = static_cast<std::size_t>(network.dim());
  network.bonds.append(first, second, length, std::span(direction).first(dim));
  network.stiffness.push_back(stiffness);
}

/// Adds an embedded point at the position of a particle and returns its number.
Index add_embedded_point(Network& network, Index at, std::span<const Index> particles,
                         std::span<const double> weights) {
  Particles& all = network.particles;
  for (int a = 0; a < all.dim; ++a) {
    all.positions.push_back(all.positions[static_cast<std::size_t>(at) * all.dim + a]);
  }
  all.volumes.push_back(all.volumes[at]);
  all.material.push_back(no_index);
  all.kind.push_back(ParticleKind::embedded_point);
  network.embedded_points.append(particles, weights);
  return all.size() - 1;
}

/// Adds the embedded point of each bar node and its slip springs: one along the bar with the bond
/// law, and rigid ones across it.
class EmbeddedSlipSprings {
 public:
  EmbeddedSlipSprings(const Body& body, const NetworkInput& input, const RebarMesh& mesh,
                      Network& network)
      : input_(input),
        spacing_(body.lattice.spacing),
        network_(network),
        laws_(network),
        ways_(ways_to_solid(body, input, mesh, network.particles)) {
    std::size_t next = 0;
    for (const BarNode& node : mesh.embedded) {
      const std::size_t begin = next;
      while (next < ways_.second.size() && ways_.second[next] == node.particle) ++next;
      add(node, begin, next);
    }
  }

 private:
  void add(const BarNode& node, std::size_t begin, std::size_t end) {
    const auto dim = static_cast<std::size_t>(network_.particles.dim);
    std::vector<double> arms;
    for (std::size_t k = begin; k < end; ++k) {
      for (std::size_t a = 0; a < dim; ++a) {
        arms.push_back(-ways_.length(static_cast<Index>(k)) *
                       ways_.direction(static_cast<Index>(k))[a]);
      }
    }
    for (double& arm : arms) arm = std::isnan(arm) ? 0.0 : arm;  // a particle at the node
    const std::vector<double> all = linear_weights(arms, static_cast<int>(dim), spacing_);
    std::vector<Index> particles;
    std::vector<double> weights;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k] == 0.0) continue;
      particles.push_back(ways_.first[begin + k]);
      weights.push_back(all[k]);
    }
    if (particles.empty() || node.length == 0.0) return;  // only its bar holds the node
    const Index embedded_point = add_embedded_point(network_, node.particle, particles, weights);
    add_slip_springs(node, embedded_point);
  }

  void add_slip_springs(const BarNode& node, Index embedded_point) {
    const BarMaterial& bar = input_.bar_materials[node.bar];
    const BarBond& bond = bar.bond;
    const double firm = rigid * bar.youngs_modulus * bar.area / (spacing_ * spacing_) * node.length;
    const std::vector<Vector3> frame = frame_of(node.along, network_.particles.dim);
    const bool hooked = (node.begins && bond.hook_from) || (node.ends && bond.hook_to);
    for (std::size_t k = 0; k < frame.size(); ++k) {
      // From node to embedded point, against the bar: the spring lengthens if the node moves along
      // the bar.
      const Vector3 against = {-frame[k][0], -frame[k][1], -frame[k][2]};
      const bool slips = k == 0 && bond.curve && !hooked;
      const double stiffness =
          slips ? bond.curve->initial_stiffness() * bond.perimeter * node.length : firm;
      const bool limited = slips && !bond.elastic;
      const double stretch = limited ? bond.curve->points.front()[0] / spacing_ : infinity;
      append_element(network_, node.particle, embedded_point, spacing_, against, stiffness);
      add_critical_stretch(input_, stretch, network_);
      if (limited) laws_.give(node.bar, [&] { return law_of(*bond.curve, BondLaw::usual_ratio); });
    }
  }

  const NetworkInput& input_;
  double spacing_;
  Network& network_;
  BarLaws laws_;
  Bonds ways_;
};

void add_segments(const NetworkInput& input, const RebarMesh& mesh, Network& network) {
  BarLaws laws(network), plateau(network);
  for (Index segment = 0; segment < mesh.segments.size(); ++segment) {
    const Index number = mesh.bar_of_element[segment];
    const BarMaterial& bar = input.bar_materials[number];
    const double yield =
        bar.curve ? bar.curve->points.front()[0] : bar.yield_strength / bar.youngs_modulus;
    const Index first = mesh.segments.first[segment];
    Index second = mesh.segments.second[segment];
    if (bar.shifts) {
      // The second end follows the node with an offset, the prestrain or flow of the bar.
      const double one = 1.0;
      second = add_embedded_point(network, second, {&second, 1}, {&one, 1});
    }
    const auto n = mesh.segments.direction(segment);
    Vector3 direction{};
    std::copy(n.begin(), n.end(), direction.begin());
    const double length = mesh.segments.length(segment);
    append_element(network, first, second, length, direction,
                   bar.youngs_modulus * bar.area / length);
    add_critical_stretch(input, yield, network);
    if (bar.curve) {
      laws.give(number, [&] { return law_of(*bar.curve, BondLaw::usual_ratio); });
    } else {
      plateau.give(0, [] { return BondLaw::plateau(); });
    }
    network.bars.area.push_back(bar.area);
    network.bars.perimeter.push_back(bar.bond.perimeter > 0.0
                                         ? bar.bond.perimeter
                                         : std::sqrt(4.0 * std::numbers::pi * bar.area));
    if (!bar.bends) continue;
    if (network.bending.empty()) network.bending.assign(network.stiffness.size(), 0.0);
    network.bending.resize(network.stiffness.size(), 0.0);
    const double inertia = bar.area * bar.area / (4.0 * std::numbers::pi);
    network.bending.back() = 12.0 * bar.youngs_modulus * inertia / (length * length * length);
  }
}

}  // namespace

void add_bars(const Body& body, const NetworkInput& input, RebarMesh mesh,
              const std::function<SlipSpringConstants(Index)>& constants_of, Network& network) {
  network.first_slip_spring = network.bonds.size();
  add_bonded_slip_springs(body, input, mesh, constants_of, network);
  network.first_embedded_slip_spring = network.bonds.size();
  if (!mesh.embedded.empty()) EmbeddedSlipSprings(body, input, mesh, network);
  network.first_bar_element = network.bonds.size();
  if (mesh.segments.size() == 0) return;
  add_segments(input, mesh, network);
  for (const BarMaterial& bar : input.bar_materials) {
    ForceCurve curve = bar.curve.value_or(ForceCurve{});
    for (auto& [strain, stress] : curve.points) {
      strain *= bar.youngs_modulus / bar.curve->points.front()[1];
      stress /= bar.curve->points.front()[1];
    }
    network.bars.curves.push_back(std::move(curve));
  }
  network.bars.bar = std::move(mesh.bar_of_element);
  network.bars.turned = std::move(mesh.turned);
  network.bars.tied_parts = std::move(mesh.tied_parts);
}

}  // namespace perilink
