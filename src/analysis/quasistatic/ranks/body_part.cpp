#include "analysis/quasistatic/ranks/body_part.hpp"

#include <algorithm>
#include <utility>

#include "discretization/point_boxes.hpp"

namespace perilink {
namespace {

/// Visits all that a rank has to know, in one order for sender and receiver.
template <class Part, class Visit>
void for_each_member(Part& part, Visit visit) {
  auto& network = part.network;
  visit(network.particles.dim);
  visit(network.torsion);
  visit(network.bonds.dim);
  visit(network.bonds.first);
  visit(network.bonds.second);
  visit(network.bonds.lengths);
  visit(network.bonds.directions);
  visit(network.stiffness);
  visit(network.bending);
  visit(network.inflection);
  visit(network.support_stiffness);
  visit(part.axial);
  visit(part.other);
  visit(part.unknowns.width);
  visit(part.unknowns.count);
  visit(part.unknowns.number);
  visit(part.unknowns.prescribed);
  visit(part.ghosts.owners);
  visit(part.ghosts.numbers);
  visit(part.blocks);
  visit(part.boxes);
  visit(part.rows);
  visit(part.motions);
}

std::vector<int> owners_of(const Partition& partition, Index count) {
  std::vector<int> owners(static_cast<std::size_t>(count));
  for (std::size_t r = 0; r < partition.particles.size(); ++r) {
    for (const Index p : partition.particles[r]) owners[p] = static_cast<int>(r);
  }
  return owners;
}

/// Numbers that particles have in a part, given in the order in which they are met.
class LocalNumbers {
 public:
  LocalNumbers(const std::vector<Index>& owned, Index count)
      : number_(static_cast<std::size_t>(count), no_index), particles(owned) {
    for (std::size_t k = 0; k < owned.size(); ++k) number_[owned[k]] = static_cast<Index>(k);
  }
  Index of(Index particle) {
    Index& number = number_[particle];
    if (number == no_index) {
      number = static_cast<Index>(particles.size());
      particles.push_back(particle);
    }
    return number;
  }

 private:
  std::vector<Index> number_;

 public:
  std::vector<Index> particles;  ///< owned, then ghosts
};

/// Copies the elements with an owned end.
void cut_elements(const Network& network, Secants secants, const std::vector<int>& owners, int rank,
                  LocalNumbers& local, BodyPart& part) {
  Network& own = part.network;
  const std::size_t dim = static_cast<std::size_t>(network.dim());
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    if (owners[i] != rank && owners[j] != rank) continue;
    own.bonds.first.push_back(local.of(i));
    own.bonds.second.push_back(local.of(j));
    own.bonds.lengths.push_back(network.bonds.lengths[e]);
    const double* n = network.bonds.directions.data() + static_cast<std::size_t>(e) * dim;
    own.bonds.directions.insert(own.bonds.directions.end(), n, n + dim);
    own.stiffness.push_back(network.stiffness[e]);
    if (!network.bending.empty()) own.bending.push_back(network.bending[e]);
    if (!network.inflection.empty()) own.inflection.push_back(network.inflection[e]);
    part.axial.push_back(secants.axial(e));
    part.other.push_back(secants[e]);
  }
}

/// Springs and numbers of unknowns of owned particles; ghosts have neither.
void cut_slots(const Network& network, const Unknowns& unknowns, const std::vector<Index>& owned,
               std::size_t particles, BodyPart& part) {
  const std::size_t width = static_cast<std::size_t>(unknowns.width);
  part.unknowns.width = unknowns.width;
  part.unknowns.number.assign(particles * width, no_index);
  part.unknowns.prescribed.assign(particles * width, 0.0);
  if (!network.support_stiffness.empty()) {
    part.network.support_stiffness.assign(particles * width, 0.0);
  }
  for (std::size_t k = 0; k < owned.size(); ++k) {
    for (std::size_t a = 0; a < width; ++a) {
      const std::size_t slot = static_cast<std::size_t>(owned[k]) * width + a;
      const std::size_t own = k * width + a;
      if (unknowns.number[slot] >= 0) part.unknowns.number[own] = part.unknowns.count++;
      if (!network.support_stiffness.empty()) {
        part.network.support_stiffness[own] = network.support_stiffness[slot];
      }
    }
  }
}

}  // namespace

Parcel BodyPart::pack() const {
  Parcel parcel;
  for_each_member(*this, [&](const auto& member) { parcel.put(member); });
  parcel.put(coarse.rows());
  std::vector<Index> rows_of, columns;
  std::vector<double> values;
  for (Index column = 0; column < static_cast<Index>(coarse.outerSize()); ++column) {
    for (SparseMatrix::InnerIterator entry(coarse, column); entry; ++entry) {
      rows_of.push_back(static_cast<Index>(entry.row()));
      columns.push_back(column);
      values.push_back(entry.value());
    }
  }
  parcel.put(rows_of);
  parcel.put(columns);
  parcel.put(values);
  return parcel;
}

BodyPart BodyPart::unpack(Parcel parcel) {
  BodyPart part;
  for_each_member(part, [&](auto& member) { parcel.get(member); });
  const auto size = parcel.get<decltype(part.coarse.rows())>();
  std::vector<Index> rows_of, columns;
  std::vector<double> values;
  parcel.get(rows_of);
  parcel.get(columns);
  parcel.get(values);
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    entries.emplace_back(rows_of[k], columns[k], values[k]);
  }
  part.coarse.resize(size, size);
  part.coarse.setFromTriplets(entries.begin(), entries.end());
  return part;
}

Partition share_out(const Network& network, const Unknowns& unknowns, int ranks) {
  Partition partition;
  partition.particles = split_into_parts(network.particles.positions, network.dim(), ranks);
  for (const std::vector<Index>& owned : partition.particles) {
    std::vector<Index>& numbers = partition.unknowns.emplace_back();
    for (const Index p : owned) {
      for (int a = 0; a < unknowns.width; ++a) {
        if (unknowns.at(p, a) >= 0) numbers.push_back(unknowns.at(p, a));
      }
    }
  }
  return partition;
}

BodyPart cut_part(const Network& network, Secants secants, const Unknowns& unknowns,
                  const BoxMotions& motions, const BoxStiffness& stiffness,
                  const Partition& partition, int rank) {
  const std::vector<int> owners = owners_of(partition, network.particles.size());
  const std::vector<Index>& owned = partition.particles[rank];
  LocalNumbers local(owned, network.particles.size());
  BodyPart part;
  part.network.particles.dim = part.network.bonds.dim = network.dim();
  part.network.torsion = network.torsion;
  cut_elements(network, secants, owners, rank, local, part);
  cut_slots(network, unknowns, owned, local.particles.size(), part);
  for (std::size_t k = owned.size(); k < local.particles.size(); ++k) {
    const Index ghost = local.particles[k];
    const std::vector<Index>& there = partition.particles[owners[ghost]];
    part.ghosts.owners.push_back(owners[ghost]);
    part.ghosts.numbers.push_back(
        static_cast<Index>(std::lower_bound(there.begin(), there.end(), ghost) - there.begin()));
  }
  part.coarse = stiffness.coarse;
  part.motions = motions.num_motions();
  const std::size_t block = static_cast<std::size_t>(unknowns.width) * unknowns.width;
  for (const Index p : owned) {
    const double* own = stiffness.blocks.data() + static_cast<std::size_t>(p) * block;
    part.blocks.insert(part.blocks.end(), own, own + block);
    part.boxes.push_back(motions.box_of(p));
    for (int a = 0; a < unknowns.width; ++a) part.rows.push_back(motions.row(p, a));
  }
  return part;
}

}  // namespace perilink
