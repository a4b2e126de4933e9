#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace perilink {

/// Prescribed displacements and rotations.
struct Prescription {
  std::vector<std::uint8_t> held;     ///< shape (particles, width)
  std::vector<double> value;          ///< at load factor 1 [length], of rotations [-];
                                      ///< velocities: at the end of the duration
  std::vector<std::uint8_t> gripped;  ///< see Model::gripped
  std::vector<PrescribedRegion> driven;
  double stretched = 0.0;      ///< largest elongation of a bar by its prestrain [length]
  std::array<bool, 6> kept{};  ///< components that supports or planes of symmetry fix at zero
};

/// Collects supports, planes of symmetry, prescribed displacements and velocities of a case.
/// \param stage  displacements of earlier stages are fixed at zero, those of later stages are free;
///               empty: all are prescribed
/// \throws InputError  for regions without particles and entries that contradict each other
Prescription collect_prescriptions(const CaseFile& input, const Model& model,
                                   const std::string& stage = "");

/// Collects the stiffness of elastic supports, Network::support_stiffness; empty: none. Facets
/// distribute their area equally to their corners. A total is distributed in proportion to volumes.
/// \throws InputError  for regions without particles or facets
std::vector<double> collect_springs(const CaseFile& input, const Model& model);

/// Unloaded parts that pre-cracks cut off or leave with too few bonds.
struct CutOffParts {
  std::vector<std::uint8_t> particles;  ///< per particle, nonzero where it belongs to such a part
  std::vector<double> springs;  ///< springs that hold the parts, too soft to change the result; as
                                ///< Network::support_stiffness; empty: there are no such parts
  std::string note;             ///< number and positions of the parts
};
CutOffParts find_cut_off_parts(const CaseFile& input, const Model& model,
                               const Prescription& prescription);

/// Returns the key of the first pre-crack that cuts a bond of these particles; empty: none does.
std::string crack_beside(const Model& model, std::span<const Index> particles);

}  // namespace perilink
