#include "analysis/quasistatic/ranks/body_part.hpp"

#include <algorithm>
#include <utility>

#include "discretization/point_boxes.hpp"
#include "network/stiffness_members.hpp"

namespace perilink {
namespace {

/// Visits all that a rank has to know, in one order for sender and receiver.
template <class Part, class Visit>
void for_each_member(Part& part, Visit visit) {
  for_each_stiffness_member(part.network, visit);
  visit(part.axial);
  visit(part.other);
  visit(part.elements);
  visit(part.unknowns.width);
  visit(part.unknowns.count);
  visit(part.unknowns.number);
  visit(part.unknowns.prescribed);
  visit(part.ghosts.places);
  visit(part.ghosts.owners);
  visit(part.ghosts.numbers);
  visit(part.blocks);
  visit(part.subdomains);
  visit(part.rows);
  visit(part.motions);
  visit(part.changes);
}

std::vector<int> owners_of(const Partition& partition, Index count) {
  std::vector<int> owners(static_cast<std::size_t>(count));
  for (std::size_t r = 0; r < partition.particles.size(); ++r) {
    for (const GlobalIndex p : partition.particles[r]) entry(owners, p) = static_cast<int>(r);
  }
  return owners;
}

/// Numbers that particles have in a part, given in the order in which they are met.
class LocalNumbers {
 public:
  LocalNumbers(const std::vector<GlobalIndex>& owned, Index count)
      : number_(static_cast<std::size_t>(count), no_index), particles(owned) {
    for (std::size_t k = 0; k < owned.size(); ++k) entry(number_, owned[k]) = static_cast<Index>(k);
  }
  Index of(GlobalIndex particle) {
    Index& number = entry(number_, particle);
    if (number == no_index) {
      number = static_cast<Index>(particles.size());
      particles.push_back(particle);
    }
    return number;
  }

 private:
  std::vector<Index> number_;

 public:
  std::vector<GlobalIndex> particles;  ///< owned, then ghosts
};

/// Particles whose elements a rank has to know.
std::vector<bool> sources(const Network& network, const std::vector<int>& owners, int rank) {
  std::vector<bool> is_source(owners.size());
  for (std::size_t p = 0; p < owners.size(); ++p) is_source[p] = owners[p] == rank;
  if (!network.has_states()) return is_source;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    if (owners[i] == rank) is_source[j] = true;
    if (owners[j] == rank) is_source[i] = true;
  }
  return is_source;
}

/// Copies these elements.
void cut_elements(const Network& network, Secants secants, const std::vector<int>& owners, int rank,
                  LocalNumbers& local, BodyPart& part) {
  Network& own = part.network;
  const std::vector<bool> is_source = sources(network, owners, rank);
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    if (!is_source[i] && !is_source[j]) continue;
    // One after the other: numbers are given as particles are met.
    const Index own_first = local.of(GlobalIndex{i}), own_second = local.of(GlobalIndex{j});
    own.bonds.append(own_first, own_second, network.bonds.length(e), network.bonds.direction(e));
    own.stiffness.push_back(network.stiffness[e]);
    if (!network.bending.empty()) own.bending.push_back(network.bending[e]);
    if (!network.inflection.empty()) own.inflection.push_back(network.inflection[e]);
    if (!network.hinged.empty()) own.hinged.push_back(network.hinged[e]);
    if (!network.state_of.empty()) own.state_of.push_back(network.state_of[e]);
    part.axial.push_back(secants.axial(e));
    part.other.push_back(secants[e]);
    part.elements.push_back(GlobalIndex{e});
  }
  if (!network.has_states()) return;
  for (const GlobalIndex p : local.particles) {
    own.state_stiffness.push_back(entry(network.state_stiffness, p));
  }
}

/// Springs and numbers of unknowns of owned particles; ghosts have neither.
void cut_slots(const Network& network, const Unknowns& unknowns,
               const std::vector<GlobalIndex>& owned, std::size_t particles, BodyPart& part) {
  const std::size_t width = static_cast<std::size_t>(unknowns.width);
  part.unknowns.width = unknowns.width;
  part.unknowns.number.assign(particles * width, no_index);
  part.unknowns.prescribed.assign(particles * width, 0.0);
  if (!network.support_stiffness.empty()) {
    part.network.support_stiffness.assign(particles * width, 0.0);
  }
  for (std::size_t k = 0; k < owned.size(); ++k) {
    for (std::size_t a = 0; a < width; ++a) {
      const std::size_t own = k * width + a;
      if (entry(unknowns.number, owned[k], width, a) >= 0) {
        part.unknowns.number[own] = part.unknowns.count++;
      }
      if (!network.support_stiffness.empty()) {
        part.network.support_stiffness[own] = entry(network.support_stiffness, owned[k], width, a);
      }
    }
  }
}

}  // namespace

void pack(const SparseMatrix& matrix, Parcel& parcel) {
  parcel.put(matrix.rows());
  std::vector<Index> rows, columns;
  std::vector<double> values;
  for (Index column = 0; column < static_cast<Index>(matrix.outerSize()); ++column) {
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      rows.push_back(static_cast<Index>(entry.row()));
      columns.push_back(column);
      values.push_back(entry.value());
    }
  }
  parcel.put(rows);
  parcel.put(columns);
  parcel.put(values);
}

SparseMatrix unpack_matrix(Parcel& parcel) {
  SparseMatrix matrix;
  const auto size = parcel.get<decltype(matrix.rows())>();
  std::vector<Index> rows, columns;
  std::vector<double> values;
  parcel.get(rows);
  parcel.get(columns);
  parcel.get(values);
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    entries.emplace_back(rows[k], columns[k], values[k]);
  }
  matrix.resize(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Parcel BodyPart::pack() const {
  Parcel parcel;
  for_each_member(*this, [&](const auto& member) { parcel.put(member); });
  perilink::pack(coarse, parcel);
  return parcel;
}

BodyPart BodyPart::unpack(Parcel parcel) {
  BodyPart part;
  for_each_member(part, [&](auto& member) { parcel.get(member); });
  part.coarse = unpack_matrix(parcel);
  return part;
}

Partition share_out(const Network& network, const Unknowns& unknowns, int ranks) {
  Partition partition;
  for (const std::vector<Index>& owned :
       split_into_parts(network.particles.positions, network.dim(), ranks)) {
    std::vector<GlobalIndex>& particles = partition.particles.emplace_back();
    std::vector<GlobalIndex>& numbers = partition.unknowns.emplace_back();
    for (const Index p : owned) {
      particles.push_back(GlobalIndex{p});
      for (int a = 0; a < unknowns.width; ++a) {
        if (unknowns.at(p, a) >= 0) numbers.push_back(GlobalIndex{unknowns.at(p, a)});
      }
    }
  }
  return partition;
}

BodyPart cut_part(const Network& network, Secants secants, const Unknowns& unknowns,
                  const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
                  const Partition& partition, int rank) {
  const std::vector<int> owners = owners_of(partition, network.particles.size());
  const std::vector<GlobalIndex>& owned = partition.particles[rank];
  LocalNumbers local(owned, network.particles.size());
  BodyPart part;
  part.network.particles.dim = part.network.bonds.dim = network.dim();
  part.network.torsion = network.torsion;
  cut_elements(network, secants, owners, rank, local, part);
  cut_slots(network, unknowns, owned, local.particles.size(), part);
  for (std::size_t k = owned.size(); k < local.particles.size(); ++k) {
    const GlobalIndex ghost = local.particles[k];
    const int owner = entry(owners, ghost);
    const std::vector<GlobalIndex>& there = partition.particles[owner];
    part.ghosts.places.push_back(static_cast<Index>(k));
    part.ghosts.owners.push_back(owner);
    part.ghosts.numbers.push_back(
        static_cast<Index>(std::lower_bound(there.begin(), there.end(), ghost) - there.begin()));
  }
  part.coarse = stiffness.coarse;
  part.motions = motions.num_motions();
  const std::size_t block = static_cast<std::size_t>(unknowns.width) * unknowns.width;
  for (const GlobalIndex number : owned) {
    const Index p = static_cast<Index>(number);
    const double* own = &entry(stiffness.blocks, number, block);
    part.blocks.insert(part.blocks.end(), own, own + block);
    part.subdomains.push_back(motions.box_of(p));
    for (int a = 0; a < unknowns.width; ++a) part.rows.push_back(motions.row(p, a));
  }
  return part;
}

}  // namespace perilink
