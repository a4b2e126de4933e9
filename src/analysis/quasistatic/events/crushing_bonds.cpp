#include "analysis/quasistatic/events/crushing_bonds.hpp"

#include <numeric>

namespace perilink {

CrushingBonds::CrushingBonds(const Network& network)
    : network_(network),
      begin_(static_cast<std::size_t>(network.particles.size()) + 1, 0),
      awake_(static_cast<std::size_t>(network.particles.size()), 0) {
  const auto for_each_end = [&](const auto& act) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (!network.has_limit(e) || !network.law(e).crushes()) continue;
      act(network.bonds.first[e], e);
      act(network.bonds.second[e], e);
    }
  };
  for_each_end([&](Index particle, Index) { ++begin_[static_cast<std::size_t>(particle) + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  bonds_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each_end([&](Index particle, Index bond) { bonds_[next[particle]++] = bond; });
}

std::vector<Index> CrushingBonds::wake(Index stretched) {
  std::vector<Index> woken;
  for (const Index particle : {network_.bonds.first[stretched], network_.bonds.second[stretched]}) {
    if (awake_[particle] != 0) continue;
    awake_[particle] = 1;
    for (std::size_t k = begin_[particle]; k < begin_[particle + 1]; ++k) {
      woken.push_back(bonds_[k]);
    }
  }
  return woken;
}

bool is_shorter(const Network& network, Index element, std::span<const double> motion) {
  const auto width = static_cast<std::size_t>(network.width());
  const double* i = motion.data() + width * network.bonds.first[element];
  const double* j = motion.data() + width * network.bonds.second[element];
  const std::span<const double> n = network.bonds.direction(element);
  double extension = 0.0;
  for (int a = 0; a < network.dim(); ++a) extension += n[a] * (j[a] - i[a]);
  return extension < 0.0;
}

}  // namespace perilink
