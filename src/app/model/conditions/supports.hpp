#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/model/model.hpp"

namespace perilink {

/// Displacements and rotations that are prescribed.
struct Prescription {
  std::vector<std::uint8_t> held;     ///< shape (particles, width)
  std::vector<double> value;          ///< at load factor 1 [length], of rotations [-];
                                      ///< of velocities at the end of the duration
  std::vector<std::uint8_t> gripped;  ///< see Model::gripped
  std::vector<PrescribedRegion> driven;
  double stretched = 0.0;      ///< by which the bar stretches most that gets a prestrain [length]
  std::array<bool, 6> kept{};  ///< components that supports or planes of symmetry hold at zero
};

/// Supports, planes of symmetry, driven displacements and velocities of a case.
/// \param stage  what earlier stages drive is held at zero, what later ones drive is free; empty:
///               all is driven
/// \throws InputError  for regions without particles and entries that contradict each other
Prescription collect_prescriptions(const CaseFile& input, const Model& model,
                                   const std::string& stage = "");

/// Stiffness of the elastic supports of a case, Network::support_stiffness; empty: none. Facets
/// share their area equally among their corners, a total is shared in proportion to the volumes.
/// \throws InputError  for regions that catch no particle or no facet
std::vector<double> collect_springs(const CaseFile& input, const Model& model);

/// Parts that pre-cracks cut off, or leave too few bonds, and that no load of any stage acts on.
struct CutOffParts {
  std::vector<std::uint8_t> particles;  ///< per particle, nonzero where it belongs to such a part
  std::vector<double> springs;          ///< that hold the parts, too soft to change the result; as
      ///< Network::support_stiffness; empty: there are no such parts
  std::string note;  ///< how many there are, and where
};
CutOffParts find_cut_off_parts(const CaseFile& input, const Model& model,
                               const Prescription& prescription);

/// Key of the first pre-crack that cuts a bond of these particles; empty: none does.
std::string crack_beside(const CaseFile& input, const Model& model,
                         std::span<const Index> particles);

}  // namespace perilink
