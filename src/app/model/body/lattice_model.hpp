#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "app/model/body/lattice_shape.hpp"
#include "app/model/model.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// The lattice of a case with model = "lattice" before anything is prescribed; for an elastic
/// analysis without damage and damping.
/// \param notes  gets what the user should know of the body
/// \throws InputError where the case makes no sense for its body: no lattice point in it, too many,
/// a spacing too large for the softening
ExplicitModel build_lattice(const CaseFile& input, const LatticeShape& shape,
                            std::vector<std::string>& notes);

/// The softening that a material of the case asks for; strength zero where it is unbreakable.
CrackOpeningLaw softening_of(const MaterialSection& material);

/// A model with particles and groups only, in which supports, loads and gauges find their places.
/// \param slots  where its particles are in the lattice
/// \throws InputError where a region is a group of the mesh without area (2D) or volume (3D)
Model lattice_places(const CaseFile& input, const LatticeShape& shape, const ExplicitModel& body,
                     std::span<const Index> slots);

/// Particles and bonds of the model of an elastic analysis, with notes on what is left out of it.
/// \throws InputError as above
Model build_lattice_model(const CaseFile& input);

}  // namespace perilink
