#include "support/random_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "support/analysis_bodies.hpp"
#include "support/staged_bodies.hpp"

namespace perilink::test {
namespace {

constexpr double limit = 1e-3;  ///< mean critical stretch [-]

/// Random numbers of one body.
class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(generator_);
  }

 private:
  std::mt19937 generator_;
};

std::array<int, 3> steps_of(int dim) {
  return dim == 2 ? std::array{8, 5, 1} : std::array{5, 3, 2};
}

void add_particle(Particles& particles, const Vector3& x, ParticleKind kind) {
  particles.positions.insert(particles.positions.end(), x.begin(), x.begin() + particles.dim);
  particles.volumes.push_back(1.0);
  particles.kind.push_back(kind);
  particles.material.push_back(kind == ParticleKind::solid ? 0 : no_index);
}

std::vector<BondLaw> laws_of(RandomLaws laws) {
  const BondLaw softening = three_segments();
  switch (laws) {
    case RandomLaws::brittle: return {BondLaw::brittle()};
    case RandomLaws::softening: return {softening};
    case RandomLaws::closing: return {softening.closing()};
    case RandomLaws::crushing:
      return {softening.crushing({{1.0, 1.0}, {0.5, 1.5}, {0.2, 3.0}}, 1.5, false),
              softening.crushing({{1.0, 1.0}, {0.4, 2.0}}, 2.0, true)};
    case RandomLaws::mixed: break;
  }
  return {BondLaw::brittle(), softening, softening.closing(), BondLaw::brittle().closing(),
          BondLaw::both_ways({{1.0, 1.0}, {0.4, 2.0}}, 0.0)};
}

/// Adds a bar along x between the particles of the solid: nodes, slip springs to the nearest
/// particles, bar elements.
void add_bar(Network& network, Draw& draw, std::vector<double>& strengths) {
  const int dim = network.dim();
  Particles& particles = network.particles;
  const Index solid = particles.size();
  const auto length = static_cast<double>(steps_of(dim)[0] - 1);
  std::vector<Index> nodes;
  for (double x = 0.9; x < length - 0.5; x += 0.8) {
    nodes.push_back(particles.size());
    add_particle(particles,
                 {x, 1.4 + draw.between(-0.1, 0.1), dim == 3 ? 1.5 + draw.between(-0.1, 0.1) : 0.0},
                 ParticleKind::rebar);
  }
  network.laws.push_back(BondLaw::both_ways({{1.0, 1.0}, {0.5, 2.0}}, 0.0));
  network.laws.push_back(BondLaw::plateau(1.2));
  const auto add = [&](Index i, Index j, double stiffness, double strength, int law) {
    network.bonds.append(particles, i, j);
    network.stiffness.push_back(stiffness);
    strengths.push_back(strength);
    network.law_of.push_back(static_cast<Index>(network.laws.size()) - law);
  };
  for (const Index node : nodes) {
    std::vector<std::pair<double, Index>> near;
    for (Index i = 0; i < solid; ++i) {
      double square = 0.0;
      for (int a = 0; a < dim; ++a) {
        square += std::pow(particles.position(i)[a] - particles.position(node)[a], 2);
      }
      near.emplace_back(square, i);
    }
    std::ranges::sort(near);
    near.resize(static_cast<std::size_t>(dim) + 2);
    std::ranges::sort(near, {}, &std::pair<double, Index>::second);
    for (const auto& [square, i] : near) {
      add(i, node, draw.between(1.0, 2.0), 2.0 * limit * draw.between(0.8, 1.2), 2);
    }
  }
  network.first_embedded_slip_spring = network.first_bar_element = network.num_elements();
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    add(nodes[k], nodes[k + 1], draw.between(3.0, 5.0), limit * draw.between(0.6, 0.8), 1);
    network.bars.area.push_back(0.01);
    network.bars.bar.push_back(0);
    network.bars.turned.push_back(0);
  }
}

bool is_left(const Network& network, Index i) { return network.particles.position(i)[0] < 0.5; }

bool is_right(const Network& network, Index i) {
  const double length = steps_of(network.dim())[0] - 1;
  return network.particles.kind[i] == ParticleKind::solid &&
         network.particles.position(i)[0] > length - 0.5;
}

Network random_network(const RandomBody& choice, Draw& draw) {
  Network network;
  network.particles.dim = choice.dim;
  const auto [columns, rows, layers] = steps_of(choice.dim);
  const auto shifted = [&](int step) { return step + draw.between(-0.15, 0.15); };
  for (int x = 0; x < columns; ++x) {
    for (int y = 0; y < rows; ++y) {
      for (int z = 0; z < layers; ++z) {
        add_particle(network.particles, {shifted(x), shifted(y), shifted(z)}, ParticleKind::solid);
      }
    }
  }
  network.bonds = make_bonds(network.particles, choice.dim == 2 ? 1.8 : 1.65);
  network.bonds.kind.clear();
  network.laws = laws_of(choice.laws);
  std::vector<double> strengths;
  for (Index e = 0; e < network.bonds.size(); ++e) {
    network.stiffness.push_back(draw.between(0.7, 1.3) / network.bonds.length(e));
    strengths.push_back(limit * draw.between(0.8, 1.2));
    network.law_of.push_back(static_cast<Index>(draw.below(network.laws.size())));
    if (choice.micropolar) network.bending.push_back(draw.between(0.2, 0.4) * network.stiffness[e]);
  }
  network.torsion = 1.3;
  network.first_slip_spring = network.first_embedded_slip_spring = network.first_bar_element =
      network.num_elements();
  if (choice.bar) add_bar(network, draw, strengths);
  if (choice.micropolar) network.bending.resize(network.stiffness.size(), 0.0);
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      if (is_left(network, i) || is_right(network, i)) strengths[e] = infinity;
    }
  }
  network.critical_stretch = strengths;
  return network;
}

}  // namespace

std::string to_string(const RandomBody& choice) {
  static constexpr const char* names[] = {"brittle", "softening", "closing", "crushing", "mixed"};
  return std::string(names[static_cast<int>(choice.laws)]) + (choice.dim == 2 ? "_2d" : "_3d") +
         (choice.micropolar ? "_micropolar" : "") + (choice.driven ? "_driven" : "_pulled") +
         (choice.supports ? "_supports" : "") + (choice.bar ? "_bar" : "") + "_" +
         std::to_string(choice.seed);
}

LoadedNetwork random_body(const RandomBody& choice) {
  Draw draw(choice.seed);
  LoadedNetwork body = free_body(random_network(choice, draw));
  Network& network = body.network;
  const auto width = static_cast<std::size_t>(network.width());
  double total = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (!is_right(network, i)) continue;
    (choice.driven ? body.unknowns.prescribed : body.loads.forces)[slot(body, i, 0)] = 1.0;
    total += 1.0;
    body.loads.forces[slot(body, i, 1)] = (choice.driven ? 0.01 : 0.3) * draw.between(-1.0, 1.0);
  }
  if (choice.supports) {
    network.support_stiffness.assign(body.loads.forces.size(), 0.0);
    for (Index i = 0; i < network.particles.size(); i += 4) {
      network.support_stiffness[i * width + draw.below(static_cast<std::size_t>(choice.dim))] =
          draw.between(0.05, 0.2);
    }
  }
  number(body, [&](Index i, int axis) {
    return is_left(network, i) || (choice.driven && axis == 0 && is_right(network, i));
  });
  body.reference = {choice.driven, choice.driven ? 1.0 : total};
  return body;
}

LoadedNetwork random_staged_body(const RandomBody& choice) {
  LoadedNetwork body = random_body(choice);
  RandomBody pulled = choice;
  pulled.driven = false;
  LoadedNetwork weight = random_body(pulled);
  Draw draw(choice.seed + 1000);
  std::ranges::fill(weight.loads.forces, 0.0);
  for (Index i = 0; i < weight.network.particles.size(); ++i) {
    if (weight.network.particles.kind[i] != ParticleKind::solid) continue;
    weight.loads.forces[slot(weight, i, 0)] = draw.between(0.0, 0.2);
    weight.loads.forces[slot(weight, i, 1)] = -draw.between(0.2, 0.5);
  }
  weight.reference = {false, 1.0};
  weight.sets = {set_of(weight), set_of(body)};
  return weight;
}

}  // namespace perilink::test
