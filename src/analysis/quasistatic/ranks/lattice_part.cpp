#include "analysis/quasistatic/ranks/lattice_part.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "discretization/point_boxes.hpp"
#include "network/stiffness_members.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// Visits all that a rank has to be told, in one order for sender and receiver.
template <class Share, class Visit>
void for_each_share_member(Share& share, Visit visit) {
  visit(share.pattern.grid);
  visit(share.pattern.small);
  visit(share.pattern.reach);
  visit(share.pattern.depth);
  for_each_stiffness_member(share.pattern.sample, visit);
  visit(share.pattern.sample.particles.positions);
  visit(share.pattern.sample.particles.volumes);
  visit(share.windows);
  visit(share.particles_of_box);
  visit(share.width);
  visit(share.held);
  visit(share.materials);
  visit(share.springs);
}

/// Around the window of a rank as far as its bonds reach.
GridWindow known_to(const LatticePattern& pattern, const GridWindow& window) {
  return pattern.grid.grown(window, pattern.reach);
}

/// Makes the particles and bonds of a part: own particles in their order, then others as bonds meet
/// them.
class PartMaker {
 public:
  PartMaker(const PatternShare& share, int rank, BodyPart& part)
      : share_(share),
        grid_(share.pattern.grid),
        own_(share.windows[rank]),
        known_(known_to(share.pattern, own_)),
        part_(part),
        number_(static_cast<std::size_t>(grid_.size(known_)), no_index) {}

  void make() {
    Network& network = part_.network;
    const Network& sample = share_.pattern.sample;
    network.particles.dim = grid_.dim;
    network.torsion = sample.torsion;
    grid_.for_each(own_, [&](const GridPoint& point) { add_particle(point); });
    const PatternBonds pattern(share_.pattern);
    std::size_t count = 0;
    pattern.for_each(own_, [&](const GridPoint&, const GridPoint&, Index) { ++count; });
    network.bonds.begin_alike(sample.bonds, count);
    for (const auto member : members_) {
      if (!(sample.*member).empty()) (network.*member).reserve(count);
    }
    pattern.for_each(own_, [&](const GridPoint& first, const GridPoint& second, Index element) {
      if (!own_.contains(first)) part_.others_elements.push_back(network.num_elements());
      // One after the other: numbers are given as particles are met.
      const Index i = number(first), j = number(second);
      network.bonds.append_alike(i, j, sample.bonds.kind_of(element));
      for (const auto member : members_) {
        if (!(sample.*member).empty()) (network.*member).push_back((sample.*member)[element]);
      }
    });
    network.first_slip_spring = network.first_embedded_slip_spring = network.first_bar_element =
        network.num_elements();
    part_.other.assign(count, 1.0);
  }

  /// Whether components are held, of all particles of the part, shape (particles, width).
  std::vector<std::uint8_t> held() const {
    const std::ptrdiff_t width = share_.width;
    std::vector<std::uint8_t> held(static_cast<std::size_t>(part_.network.particles.size()) *
                                   width);
    for (std::size_t k = 0; k < number_.size(); ++k) {
      if (number_[k] == no_index) continue;
      std::copy_n(share_.held.begin() + k * width, width, held.begin() + number_[k] * width);
    }
    return held;
  }

 private:
  /// What a bond has in common with that of the sample.
  static constexpr std::array members_ = {&Network::stiffness, &Network::bending,
                                          &Network::inflection};

  Index number(const GridPoint& point) {
    const Index known = number_[grid_.number(known_, point)];
    return known == no_index ? add_ghost(point) : known;
  }
  Index add_particle(const GridPoint& point) {
    Particles& particles = part_.network.particles;
    const Index known = grid_.number(known_, point);
    const Index number = number_[known] = particles.size();
    const LatticePattern& pattern = share_.pattern;
    const Index like = pattern.small.number(pattern.small.all(), pattern.place(point));
    const Vector3 x = grid_.position(point);
    particles.positions.insert(particles.positions.end(), x.begin(), x.begin() + grid_.dim);
    particles.volumes.push_back(pattern.sample.particles.volumes[like]);
    particles.kind.push_back(ParticleKind::solid);
    particles.material.push_back(share_.materials[known]);
    return number;
  }
  Index add_ghost(const GridPoint& point) {
    const Index number = add_particle(point);
    int owner = 0;
    while (!share_.windows[owner].contains(point)) ++owner;
    part_.ghosts.places.push_back(number);
    part_.ghosts.owners.push_back(owner);
    part_.ghosts.numbers.push_back(grid_.number(share_.windows[owner], point));
    return number;
  }

  const PatternShare& share_;
  const LatticeGrid& grid_;
  GridWindow own_, known_;
  BodyPart& part_;
  std::vector<Index> number_;  // in the part, of the particles of known_
};

/// Sums of a number that each rank has: over the ranks before this one, and over all.
std::pair<Index, Index> before_and_in_all(Ranks& ranks, Index own) {
  std::vector<double> counts(static_cast<std::size_t>(ranks.count()), 0.0);
  counts[ranks.own()] = own;
  ranks.sum(counts);
  const auto sum_to = [&](auto end) {
    return static_cast<Index>(std::accumulate(counts.begin(), end, 0.0));
  };
  return {sum_to(counts.begin() + ranks.own()), sum_to(counts.end())};
}

/// The sum of the matrices of all ranks, for all.
SparseMatrix sum_of(Ranks& ranks, SparseMatrix own) {
  if (!ranks.leads()) {
    Parcel parcel;
    pack(own, parcel);
    ranks.send(0, parcel.bytes());
    parcel = Parcel(ranks.receive(0));
    return unpack_matrix(parcel);
  }
  for (int rank = 1; rank < ranks.count(); ++rank) {
    Parcel parcel(ranks.receive(rank));
    own += unpack_matrix(parcel);
  }
  Parcel parcel;
  pack(own, parcel);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, parcel.bytes());
  return own;
}

/// Boxes of the own particles and their stiffness, and that of the particles.
/// \param unknowns  those of all particles of the part, ghosts too
void add_subdomains(Ranks& ranks, Index particles_of_box, Index owned, const Unknowns& unknowns,
                    BodyPart& part) {
  const Particles& particles = part.network.particles;
  const int width = unknowns.width;
  const std::size_t positions = static_cast<std::size_t>(owned) * particles.dim;
  std::vector<std::vector<Index>> own =
      split_by_cracks(split_into_subdomains({particles.positions.data(), positions}, particles.dim,
                                            particles_of_box),
                      part.network, part.secants());
  const auto [before, all] = before_and_in_all(ranks, static_cast<Index>(own.size()));
  const SubdomainMotions motions(particles, unknowns, std::move(own), before, all,
                                 [&](std::span<double> known, int numbers) {
                                   GhostLayer(ranks, part.ghosts).update(numbers, {known});
                                 });
  SubdomainStiffness stiffness =
      assemble_subdomain_stiffness(part.network, part.secants(), unknowns, motions);
  stiffness.blocks.resize(static_cast<std::size_t>(owned) * width * width);
  double faults = stiffness.invert_blocks(width) ? 0.0 : 1.0;
  ranks.sum({&faults, 1});
  if (faults > 0.0) {
    throw NotPositiveDefinite("the stiffness of a particle is not positive definite");
  }
  part.blocks = std::move(stiffness.blocks);
  part.motions = motions.num_motions();
  for (Index p = 0; p < owned; ++p) {
    part.subdomains.push_back(motions.box_of(p));
    for (int a = 0; a < width; ++a) part.rows.push_back(motions.row(p, a));
  }
  part.coarse = sum_of(ranks, std::move(stiffness.coarse));
}

}  // namespace

void PatternShare::pack(Parcel& parcel) const {
  for_each_share_member(*this, [&](const auto& member) { parcel.put(member); });
  parcel.put(pattern.cracks.size());
  for (const Crack& crack : pattern.cracks) parcel.put(crack.points);
}

PatternShare PatternShare::unpack(Parcel& parcel) {
  PatternShare share;
  for_each_share_member(share, [&](auto& member) { parcel.get(member); });
  share.pattern.cracks.resize(parcel.get<std::size_t>());
  for (Crack& crack : share.pattern.cracks) parcel.get(crack.points);
  return share;
}

Partition share_out(const LatticeGrid& grid, const std::vector<GridWindow>& windows,
                    const Unknowns& unknowns) {
  Partition partition;
  for (const GridWindow& window : windows) {
    std::vector<GlobalIndex>& particles = partition.particles.emplace_back();
    std::vector<GlobalIndex>& numbers = partition.unknowns.emplace_back();
    grid.for_each(window, [&](const GridPoint& point) {
      const Index p = grid.number(grid.all(), point);
      particles.push_back(GlobalIndex{p});
      for (int a = 0; a < unknowns.width; ++a) {
        if (unknowns.at(p, a) >= 0) numbers.push_back(GlobalIndex{unknowns.at(p, a)});
      }
    });
  }
  return partition;
}

PatternShare share_of(const LatticePattern& pattern, const std::vector<GridWindow>& windows,
                      const Network& places, const Unknowns& unknowns, Index particles_of_box,
                      int rank) {
  PatternShare share{pattern, windows, particles_of_box, unknowns.width, {}, {}, {}};
  const std::ptrdiff_t width = unknowns.width;
  const LatticeGrid& grid = pattern.grid;
  const std::vector<double>& springs = places.support_stiffness;
  const auto number = [&](const GridPoint& point) { return grid.number(grid.all(), point); };
  grid.for_each(known_to(pattern, windows[rank]), [&](const GridPoint& point) {
    for (int a = 0; a < width; ++a) share.held.push_back(unknowns.at(number(point), a) < 0);
    share.materials.push_back(places.particles.material[number(point)]);
  });
  if (springs.empty()) return share;
  grid.for_each(windows[rank], [&](const GridPoint& point) {
    const auto own = springs.begin() + number(point) * width;
    share.springs.insert(share.springs.end(), own, own + width);
  });
  return share;
}

BodyPart make_part(Ranks& ranks, const PatternShare& share) {
  BodyPart part;
  PartMaker maker(share, ranks.own(), part);
  maker.make();
  const Network& network = part.network;
  const std::size_t slots =
      static_cast<std::size_t>(network.particles.size()) * static_cast<std::size_t>(share.width);
  if (!share.springs.empty()) {
    part.network.support_stiffness = share.springs;
    part.network.support_stiffness.resize(slots, 0.0);
  }
  const Index owned = share.pattern.grid.size(share.windows[ranks.own()]);
  std::vector<std::uint8_t> held = maker.held();
  const std::vector<double> at_rest(slots, 0.0);
  add_subdomains(ranks, share.particles_of_box, owned, number_unknowns(share.width, held, at_rest),
                 part);
  std::fill(held.begin() + static_cast<std::ptrdiff_t>(owned) * share.width, held.end(), 1);
  part.unknowns = number_unknowns(share.width, held, at_rest);
  return part;
}

}  // namespace perilink
