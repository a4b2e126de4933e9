#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/model.hpp"
#include "io/case/case_file.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Where the path of the events is to dissipate the fracture energy (critical_stretch =
/// "dissipated"), bonds may release only a part of it: divides the fracture energies of the
/// network's materials, and those of its brittle interfaces, by what a crack costs.
/// \return crack_cost() of each material [-]; empty with the other rules and in elastic analyses
std::vector<double> count_on_the_path(const CaseFile& input, const Body& body,
                                      NetworkInput& network);

/// Says that the energy of a crack is uncertain, where bonds can break that reach less than
/// least_ratio_of_cracks spacings.
std::optional<std::string> short_horizon_note(const Model& model);

/// Says that nobody measured what a crack costs in such a body, where its bonds can break: lattices
/// whose steps differ by more than a tenth, and irregular clouds in space whose bonds bend.
std::optional<std::string> unmeasured_cost_note(const Model& model);

}  // namespace perilink
