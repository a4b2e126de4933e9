#pragma once

#include <cstddef>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Bars of all [[rebar]] entries, in their order.
struct LaidBars {
  std::vector<RebarLine> lines;
  std::vector<BarMaterial> materials;  ///< per bar
  std::vector<std::size_t> sections;   ///< index of the entry, per bar
};

/// Lays the bars of all [[rebar]] entries.
/// \param body  with the groups of its mesh
/// \throws InputError  where the cover leaves no room, or the mesh has no such curves
LaidBars lay_bars(const CaseFile& input, const Body& body);

/// Refuses bars that leave the body, including through gaps, unless their entry sets across_gaps.
void refuse_bars_outside(const CaseFile& input, const Body& body, const LaidBars& bars);

}  // namespace perilink
