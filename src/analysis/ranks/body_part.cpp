#include "analysis/ranks/body_part.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "network/element_columns.hpp"

namespace perilink {
namespace {

/// Visits the plain lists and values of a part, in one order for sender and receiver.
template <class Part, class Visit>
void for_each_member(Part& part, Visit visit) {
  auto& network = part.body.network;
  visit(network.particles.dim);
  visit(network.particles.volumes);
  visit(network.particles.material);
  visit(network.torsion);
  visit(network.bonds.dim);
  visit(network.bonds.first);
  visit(network.bonds.second);
  visit(network.bonds.lengths);
  visit(network.bonds.directions);
  visit(network.bonds.kind);
  for_each_element_column([&](auto list, auto) { visit(list(network)); });
  visit(network.support_stiffness);
  visit(network.first_embedded_slip_spring);
  visit(network.first_bar_element);
  visit(network.embedded_points.particles.offsets);
  visit(network.embedded_points.particles.values);
  visit(network.embedded_points.weights);
  visit(network.embedded_points.strain_weights);
  visit(network.embedded_points.normals);
  visit(part.body.unknowns.width);
  visit(part.body.unknowns.number);
  visit(part.body.unknowns.prescribed);
  visit(part.elements);
  visit(part.first_particle);
  visit(part.own_begin);
  visit(part.own_end);
  visit(part.ghosts.places);
  visit(part.ghosts.owners);
  visit(part.ghosts.numbers);
}

/// Returns the elements with an end among the particles [begin, end).
std::vector<Index> elements_of(const Network& network, Index begin, Index end) {
  std::vector<Index> elements;
  for (Index e = 0; e < network.num_elements(); ++e) {
    bool is_own = false;
    for_each_end(network, e, [&](Index p, bool, double) { is_own |= p >= begin && p < end; });
    if (is_own) elements.push_back(e);
  }
  return elements;
}

/// Returns the embedded points among the particles [first, past) of a part. A part with slip
/// springs of an embedded point also numbers the particles around that point.
EmbeddedPoints cut_embedded_points(const Network& network, Index first, Index past) {
  EmbeddedPoints own;
  const Index embedded_points = network.first_embedded_point();
  for (Index embedded_point = std::max(first, embedded_points); embedded_point < past;
       ++embedded_point) {
    std::vector<Index> particles;
    for (const Index p : network.embedded_points.particles.row(embedded_point - embedded_points)) {
      particles.push_back(p - first);
    }
    const EmbeddedPoints& all = network.embedded_points;
    const Index k = embedded_point - embedded_points;
    const auto normal = all.normal_of(k, network.dim());
    if (normal.empty()) {
      own.append(particles, all.weights_of(k));
    } else {
      own.append(particles, all.weights_of(k), all.strain_weights_of(k, network.dim()), normal);
    }
  }
  return own;
}

Network cut_network(const Network& network, const std::vector<Index>& elements, Index first,
                    Index past) {
  Network own;
  own.particles.dim = own.bonds.dim = network.dim();
  own.particles.volumes = slice(network.particles.volumes, first, past, 1);
  own.particles.material = slice(network.particles.material, first, past, 1);
  own.support_stiffness = slice(network.support_stiffness, first, past, network.width());
  own.torsion = network.torsion;
  own.laws = network.laws;
  const auto pick = [&](const auto& all, auto& picked, std::size_t width = 1) {
    if (all.empty()) return;
    picked.reserve(elements.size() * width);
    for (const Index e : elements) {
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(e * width);
      picked.insert(picked.end(), from, from + static_cast<std::ptrdiff_t>(width));
    }
  };
  pick(network.bonds.first, own.bonds.first);
  pick(network.bonds.second, own.bonds.second);
  for (Index& particle : own.bonds.first) particle -= first;
  for (Index& particle : own.bonds.second) particle -= first;
  if (network.bonds.kind.empty()) {
    pick(network.bonds.lengths, own.bonds.lengths);
    pick(network.bonds.directions, own.bonds.directions, static_cast<std::size_t>(network.dim()));
  } else {
    pick(network.bonds.kind, own.bonds.kind);
    own.bonds.lengths = network.bonds.lengths;
    own.bonds.directions = network.bonds.directions;
  }
  for_each_element_column([&](auto list, auto) { pick(list(network), list(own)); });
  const auto count_before = [&](Index element) {
    return static_cast<Index>(std::ranges::lower_bound(elements, element) - elements.begin());
  };
  own.first_embedded_slip_spring = count_before(network.first_embedded_slip_spring);
  own.first_bar_element = count_before(network.first_bar_element);
  own.embedded_points = cut_embedded_points(network, first, past);
  return own;
}

}  // namespace

std::vector<Index> in_part(const std::vector<Index>& all, const std::vector<Index>& elements) {
  std::vector<Index> own;
  for (const Index e : all) {
    const auto at = std::lower_bound(elements.begin(), elements.end(), e);
    if (at != elements.end() && *at == e) own.push_back(static_cast<Index>(at - elements.begin()));
  }
  return own;
}

Partition::Partition(const Network& network, const ParticleBlocks& all_blocks, int ranks)
    : blocks(all_blocks) {
  for (int rank = 0; rank <= ranks; ++rank) {
    first_block.push_back(static_cast<Index>(std::int64_t{blocks.count()} * rank / ranks));
  }
  for (int rank = 0; rank < ranks; ++rank) {
    first_particle.push_back(own_begin(rank));
    past_particle.push_back(own_end(rank));
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index upper = std::max(network.bonds.first[e], network.bonds.second[e]);
    Index lower = upper;
    for_each_end(network, e, [&](Index p, bool, double) { lower = std::min(lower, p); });
    for_each_end(network, e, [&](Index p, bool, double) {
      const int rank = owner(p);
      first_particle[rank] = std::min(first_particle[rank], blocks.begin(blocks.of(lower)));
      past_particle[rank] = std::max(past_particle[rank], upper + 1);
    });
  }
}

int Partition::owner(Index particle) const {
  const auto next = std::upper_bound(first_block.begin(), first_block.end(), blocks.of(particle));
  return static_cast<int>(next - first_block.begin()) - 1;
}

Ghosts Partition::ghosts(const Network& network, int rank) const {
  std::vector<Index> reached;
  const auto is_own = [&](Index p) { return p >= own_begin(rank) && p < own_end(rank); };
  for (Index e = 0; e < network.num_elements(); ++e) {
    bool any_own = false;
    for_each_end(network, e, [&](Index p, bool, double) { any_own |= is_own(p); });
    if (!any_own) continue;
    for_each_end(network, e, [&](Index p, bool, double) {
      if (!is_own(p)) reached.push_back(p);
    });
  }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  Ghosts ghosts;
  for (const Index p : reached) {
    ghosts.places.push_back(p - first_particle[rank]);
    ghosts.owners.push_back(owner(p));
    ghosts.numbers.push_back(p - first_particle[owner(p)]);
  }
  return ghosts;
}

BodyPart cut_part(const Network& network, const Unknowns& unknowns, const Partition& partition,
                  int rank) {
  const Index first = partition.first_particle[rank], past = partition.past_particle[rank];
  BodyPart part;
  part.own_begin = partition.own_begin(rank) - first;
  part.own_end = partition.own_end(rank) - first;
  part.elements = elements_of(network, partition.own_begin(rank), partition.own_end(rank));
  part.body.network = cut_network(network, part.elements, first, past);
  part.body.unknowns.width = unknowns.width;
  part.body.unknowns.number = slice(unknowns.number, first, past, unknowns.width);
  part.body.unknowns.prescribed = slice(unknowns.prescribed, first, past, unknowns.width);
  part.first_particle = first;
  part.ghosts = partition.ghosts(network, rank);
  return part;
}

void BodyPart::pack(Parcel& parcel) const {
  const auto put = [&](const auto& member) { parcel.put(member); };
  for_each_member(*this, put);
  parcel.put(body.network.laws.size());
  for (const BondLaw& law : body.network.laws) BondLaw::for_each_member(law, put);
}

BodyPart BodyPart::unpack(Parcel& parcel) {
  BodyPart part;
  const auto get = [&](auto& member) { parcel.get(member); };
  for_each_member(part, get);
  part.body.network.laws.resize(parcel.get<std::size_t>(), BondLaw::brittle());
  for (BondLaw& law : part.body.network.laws) BondLaw::for_each_member(law, get);
  return part;
}

}  // namespace perilink
