#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "model/model.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Divides the fracture energies of materials and brittle interfaces by crack_cost() where
/// critical_stretch = "dissipated". The path of events then dissipates the fracture energy given.
/// \return crack_cost() of each material [-]; empty with the other rules and in elastic analyses
std::vector<double> count_on_the_path(const CaseFile& input, const Body& body,
                                      NetworkInput& network);

/// Returns a note that the energy of a crack is uncertain, where breakable bonds reach less than
/// least_ratio_of_cracks spacings.
std::optional<std::string> short_horizon_note(const Model& model);

/// Returns a note that the fracture-energy correction was not measured for a body with breakable
/// bonds. This holds for lattices with steps that differ by more than a tenth. It also holds for
/// three-dimensional unstructured particle sets with bending bonds.
std::optional<std::string> unmeasured_cost_note(const Model& model);

}  // namespace perilink
