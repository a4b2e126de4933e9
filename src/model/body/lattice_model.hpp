#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "io/case/case_file.hpp"
#include "model/body/lattice_shape.hpp"
#include "model/model.hpp"

namespace perilink {

/// Builds the lattice of a case with model = "lattice", without prescribed motions. Lattices of
/// elastic analyses have neither damage nor damping.
/// \param notes  receives notes on the body
/// \throws InputError where the case does not fit its body: no lattice point in it, too many,
/// a spacing too large for the softening
ExplicitModel build_lattice(const CaseFile& input, const LatticeShape& shape,
                            std::vector<std::string>& notes);

/// Returns the softening law of a material of the case; strength zero where it is unbreakable.
CrackOpeningLaw softening_of(const MaterialSection& material);

/// Returns a model with particles and groups only, for supports, loads and gauges to refer to.
/// \param slots  slots of its particles in the lattice
/// \throws InputError where a region is a group of the mesh without area (2D) or volume (3D)
Model lattice_places(const CaseFile& input, const LatticeShape& shape, const ExplicitModel& body,
                     std::span<const Index> slots);

/// Builds particles and bonds of an elastic analysis, with notes on particles left out.
/// \throws InputError if build_lattice() or lattice_places() does
Model build_lattice_model(const CaseFile& input);

}  // namespace perilink
