#include "analysis/quasistatic/host_release.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace perilink {

HostRelease::HostRelease(const Network& network, const EmbeddedBody& body,
                         std::vector<std::uint8_t> whole)
    : network_(network),
      body_(body),
      free_(&body.free),
      whole_(std::move(whole)),
      host_(host_of_particles(body.hosts, whole_, network.particles.size())),
      num_whole_(static_cast<Index>(std::count(whole_.begin(), whole_.end(), 1))),
      by_lower_x_(whole_.size()) {
  const Hosts& hosts = body.hosts;
  const auto dim = static_cast<std::size_t>(hosts.dim);
  std::iota(by_lower_x_.begin(), by_lower_x_.end(), 0);
  std::stable_sort(by_lower_x_.begin(), by_lower_x_.end(),
                   [&](Index a, Index b) { return hosts.lower[a * dim] < hosts.lower[b * dim]; });
  for (std::size_t e = 0; e < whole_.size(); ++e) {
    widest_ = std::max(widest_, hosts.upper[e * dim] - hosts.lower[e * dim]);
  }
}

std::vector<Index> HostRelease::embedded_bonds() const {
  std::vector<Index> embedded;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (is_embedded(e)) embedded.push_back(e);
  }
  return embedded;
}

bool HostRelease::is_near(Index element, Index other) const {
  const Hosts& hosts = body_.hosts;
  const auto dim = static_cast<std::size_t>(hosts.dim);
  const std::size_t e = static_cast<std::size_t>(element) * dim;
  const std::size_t o = static_cast<std::size_t>(other) * dim;
  double square = 0.0;
  for (std::size_t a = 0; a < dim; ++a) {
    const double gap = std::max(
        {0.0, hosts.lower[o + a] - hosts.upper[e + a], hosts.lower[e + a] - hosts.upper[o + a]});
    square += gap * gap;
  }
  return square <= body_.buffer_zone * body_.buffer_zone;
}

/// Returns these elements and the active hosts in the buffer zone around them.
std::vector<std::uint8_t> HostRelease::with_buffer_zone(
    const std::vector<std::uint8_t>& alarmed) const {
  const auto lower = [&](Index e) {
    return body_.hosts.lower[static_cast<std::size_t>(e) * body_.hosts.dim];
  };
  const auto upper = [&](Index e) {
    return body_.hosts.upper[static_cast<std::size_t>(e) * body_.hosts.dim];
  };
  std::vector<std::uint8_t> marked = alarmed;
  for (Index e = 0; e < body_.hosts.size(); ++e) {
    if (alarmed[e] == 0) continue;
    const auto first = std::partition_point(
        by_lower_x_.begin(), by_lower_x_.end(),
        [&](Index other) { return lower(other) + widest_ < lower(e) - body_.buffer_zone; });
    for (auto other = first; other != by_lower_x_.end(); ++other) {
      if (lower(*other) > upper(e) + body_.buffer_zone) break;
      if (whole_[*other] != 0 && marked[*other] == 0 && is_near(e, *other)) marked[*other] = 1;
    }
  }
  return marked;
}

std::vector<std::uint8_t> HostRelease::hosts_of(std::span<const Index> bonds) const {
  std::vector<std::uint8_t> elements(whole_.size(), 0);
  for (const Index bond : bonds) {
    for (const Index i : {network_.bonds.first[bond], network_.bonds.second[bond]}) {
      if (host_[i] != no_index) elements[host_[i]] = 1;
    }
  }
  return elements;
}

double HostRelease::release_threshold() const { return strains() ? 1.0 : body_.release_threshold; }

void HostRelease::watch_strains() {
  strains_.emplace();
  std::vector<Index> can_fail;
  std::vector<std::uint8_t> has_such(host_.size(), 0);
  for (Index bond = 0; bond < network_.num_elements(); ++bond) {
    if (!network_.has_limit(bond)) continue;
    can_fail.push_back(bond);
    has_such[network_.bonds.first[bond]] = has_such[network_.bonds.second[bond]] = 1;
  }
  const std::vector<std::uint8_t> elements = hosts_of(can_fail);
  for (Index e = 0; e < body_.hosts.size(); ++e) {
    if (elements[e] == 0) continue;
    std::vector<Index> inside;
    for (const Index i : body_.hosts.inside.row(e)) {
      if (has_such[i] != 0) inside.push_back(i);
    }
    strains_->emplace_back(network_.particles, e, inside);
  }
}

auto HostRelease::strained(std::span<const double> motion, double fraction) -> Strained {
  if (!strains_) watch_strains();
  std::vector<double> strain;
  double largest = 0.0;
  for (const ElementStrain& element : *strains_) {
    const bool whole = whole_[element.number()] != 0;
    strain.push_back(whole ? element.principal(motion, network_.width()) : 0.0);
    largest = std::max(largest, strain.back());
  }
  Strained found{std::vector<std::uint8_t>(whole_.size(), 0),
                 std::numeric_limits<double>::infinity()};
  if (largest <= 0.0) return found;
  found.load_factor = *body_.release_strain / largest;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (strain[k] >= fraction * largest) found.elements[(*strains_)[k].number()] = 1;
  }
  return found;
}

const Unknowns& HostRelease::convert(const std::vector<std::uint8_t>& alarmed) {
  const std::vector<std::uint8_t> marked = with_buffer_zone(alarmed);
  for (std::size_t e = 0; e < whole_.size(); ++e) {
    if (marked[e] == 0) continue;
    whole_[e] = 0;
    --num_whole_;
  }
  const std::vector<Index> before = embedded_bonds();
  host_ = host_of_particles(body_.hosts, whole_, network_.particles.size());
  freed_.clear();
  for (const Index bond : before) {
    if (!is_embedded(bond)) freed_.push_back(bond);
  }
  return hold(*free_);
}

const Unknowns& HostRelease::hold(const Unknowns& free) {
  free_ = &free;
  former_ = std::move(present_);
  present_ = std::make_unique<Unknowns>(embedded_motion(body_.hosts, free, whole_));
  return *present_;
}

}  // namespace perilink
