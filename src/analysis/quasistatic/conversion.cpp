#include "analysis/quasistatic/conversion.hpp"

#include <algorithm>

namespace perilink {

Conversion::Conversion(const Network& network, const CarriedBody& body)
    : network_(network),
      body_(body),
      whole_(body.whole),
      carrier_(carrier_of_particles(body.carriers, whole_, network.particles.size())),
      num_whole_(static_cast<Index>(std::count(whole_.begin(), whole_.end(), 1))) {}

std::vector<Index> Conversion::carried_bonds() const {
  std::vector<Index> carried;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (is_carried(e)) carried.push_back(e);
  }
  return carried;
}

void Conversion::mark_around(Index element, std::vector<std::uint8_t>& marked) const {
  const auto dim = static_cast<std::size_t>(body_.carriers.dim);
  const std::vector<double>&lower = body_.carriers.lower, &upper = body_.carriers.upper;
  const std::size_t own = static_cast<std::size_t>(element) * dim;
  for (std::size_t e = 0; e < whole_.size(); ++e) {
    if (whole_[e] == 0 || marked[e] != 0) continue;
    double square = 0.0;
    for (std::size_t a = 0; a < dim; ++a) {
      const double gap =
          std::max({0.0, lower[e * dim + a] - upper[own + a], lower[own + a] - upper[e * dim + a]});
      square += gap * gap;
    }
    if (square <= body_.halo * body_.halo) marked[e] = 1;
  }
}

const Unknowns& Conversion::convert(std::span<const Index> bonds) {
  std::vector<std::uint8_t> alarmed(whole_.size(), 0);
  for (const Index bond : bonds) {
    for (const Index i : {network_.bonds.first[bond], network_.bonds.second[bond]}) {
      if (carrier_[i] != no_index) alarmed[carrier_[i]] = 1;
    }
  }
  std::vector<std::uint8_t> marked = alarmed;
  for (std::size_t e = 0; e < whole_.size(); ++e) {
    if (alarmed[e] != 0) mark_around(static_cast<Index>(e), marked);
  }
  for (std::size_t e = 0; e < whole_.size(); ++e) {
    if (marked[e] == 0) continue;
    whole_[e] = 0;
    --num_whole_;
  }
  const std::vector<Index> before = carried_bonds();
  carrier_ = carrier_of_particles(body_.carriers, whole_, network_.particles.size());
  freed_.clear();
  for (const Index bond : before) {
    if (!is_carried(bond)) freed_.push_back(bond);
  }
  former_ = std::move(present_);
  present_ = std::make_unique<Unknowns>(carried_motion(body_, whole_));
  return *present_;
}

}  // namespace perilink
