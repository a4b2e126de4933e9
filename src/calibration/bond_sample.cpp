#include "calibration/bond_sample.hpp"

namespace perilink {

std::vector<std::uint8_t> mark_ends(const Bonds& bonds, std::span<const std::uint8_t> marked,
                                    Index num_particles) {
  std::vector<std::uint8_t> ends(static_cast<std::size_t>(num_particles), 0);
  for (Index b = 0; b < bonds.size(); ++b) {
    if (marked[b]) ends[bonds.first[b]] = ends[bonds.second[b]] = 1;
  }
  return ends;
}

BondSample sample_bonds(std::span<const std::uint8_t> marked, const Bonds& bonds,
                        std::span<const std::uint8_t> free, const BondStiffness& stiffness) {
  BondSample sample;
  sample.bonds.dim = bonds.dim;
  for (Index b = 0; b < bonds.size(); ++b) {
    if (!marked[bonds.first[b]] && !marked[bonds.second[b]]) continue;
    sample.numbers.push_back(b);
    sample.bonds.append(bonds.first[b], bonds.second[b], bonds.length(b), bonds.direction(b));
    sample.free.push_back(free[b]);
    sample.stiffness.axial.push_back(stiffness.axial[b]);
    if (stiffness.bending.empty()) continue;
    sample.stiffness.bending.push_back(stiffness.bending[b]);
    sample.stiffness.inflection.push_back(stiffness.inflection[b]);
  }
  return sample;
}

void BondSample::put_back(const BondStiffness& found, BondStiffness& body) const {
  for (std::size_t s = 0; s < numbers.size(); ++s) {
    body.axial[numbers[s]] = found.axial[s];
    if (body.bending.empty()) continue;
    body.bending[numbers[s]] = found.bending[s];
    body.inflection[numbers[s]] = found.inflection[s];
  }
}

}  // namespace perilink
