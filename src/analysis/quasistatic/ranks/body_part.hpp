#pragma once

#include <array>
#include <vector>

#include "assembly/subdomains/subdomain_stiffness.hpp"
#include "base/parcel.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Number in the whole body of a particle, element or unknown; a plain one is that of a rank's
/// part.
enum class GlobalIndex : Index {};

/// What a rank knows of a body: the particles that it owns, then those of other ranks that its
/// elements reach, and these elements. Particles with states pull at their neighbours by sums over
/// their own bonds: of these the elements of all neighbours are known, too. Numbers are the part's
/// own.
struct BodyPart {
  /// Parts that are sent have no positions: products need directions and lengths alone.
  Network network;
  /// Secants of the elements; where no element changes the first may be empty, as the second.
  std::vector<double> axial, other;
  std::vector<GlobalIndex> elements;  ///< their numbers, ascending, where they may change
  /// Elements whose first end another rank owns, in parts that ranks make.
  std::vector<Index> others_elements;
  Unknowns unknowns;  ///< owned particles have some, ghosts none
  Ghosts ghosts;

  /// Inverse stiffness of each owned particle alone, shape (owned, width, width).
  std::vector<double> blocks;
  SparseMatrix coarse;                      ///< P'K P of the whole body, lower triangle
  std::vector<Index> subdomains;            ///< per owned particle
  std::vector<std::array<double, 6>> rows;  ///< rows of P, shape (owned, width)
  int motions = 3;                          ///< that a box has
  bool changes = false;                     ///< whether elements do, and blocks are solved for

  Index owned() const { return static_cast<Index>(subdomains.size()); }
  Secants secants() const { return axial.empty() ? Secants(other) : Secants(other, axial); }

  Parcel pack() const;
  static BodyPart unpack(Parcel parcel);
};

void pack(const SparseMatrix& matrix, Parcel& parcel);
SparseMatrix unpack_matrix(Parcel& parcel);

/// Which rank owns each particle, and where its unknowns are in its part.
struct Partition {
  std::vector<std::vector<GlobalIndex>> particles;  ///< per rank, ascending
  std::vector<std::vector<GlobalIndex>> unknowns;   ///< per rank, in the order of its part
};

/// An entry of a list, shape (whole body,) or (whole body, width).
template <class List>
auto& entry(List& all, GlobalIndex number, std::size_t width = 1, std::size_t component = 0) {
  return all[static_cast<std::size_t>(number) * width + component];
}

Partition share_out(const Network& network, const Unknowns& unknowns, int ranks);

/// \param stiffness  boxes and particles of the whole body, its blocks inverted
BodyPart cut_part(const Network& network, Secants secants, const Unknowns& unknowns,
                  const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
                  const Partition& partition, int rank);

}  // namespace perilink
