#include "analysis/dynamics/bonds/bond_stencil.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace perilink {
namespace {

/// Limit far above the number of kinds inside a lattice; surfaces may add kinds, most of which are
/// dropped.
constexpr std::size_t most_kinds = 1 << 16;
/// Bodies with fewer bonds per kind are unstructured.
constexpr std::size_t least_repeats = 2;
/// Least average number of directed bonds in a line, which costs as much as this many single ones.
constexpr double least_fill = 3.0;
/// Round-off of positions, relative to the shortest distances between them.
constexpr double same = 1e-11;
constexpr int no_kind = -1;

bool near(double a, double b, double scale) { return a == b || std::abs(a - b) <= same * scale; }

bool alike(const BondKind& a, const BondKind& b) {
  bool result = near(a.length, b.length, b.length) && near(a.modulus, b.modulus, b.modulus) &&
                near(a.limit, b.limit, b.limit);
  for (int axis = 0; axis < 3; ++axis) result &= near(a.direction[axis], b.direction[axis], 1.0);
  return result;
}

/// Sorts elements into kinds by cells that are far wider than round-off and far narrower than real
/// differences.
class Kinds {
 public:
  /// Returns the kind of an element. Returns no_kind where a cell holds different bonds, and for
  /// new kinds beyond the limit.
  int find(const Network& network, Index element) {
    const BondKind kind = kind_of(network, element);
    if (!(std::isfinite(kind.modulus) && kind.modulus > 0.0 && kind.limit > 0.0)) return no_kind;
    const Cell at = cell(kind);
    auto entry = number_.find(at);
    if (entry == number_.end()) {
      if (is_full()) return no_kind;
      entry = number_.emplace(at, static_cast<int>(kinds.size())).first;
      kinds.push_back(kind);
    }
    return alike(kinds[entry->second], kind) ? entry->second : no_kind;
  }

  bool is_full() const { return kinds.size() >= most_kinds; }

  std::vector<BondKind> kinds;

 private:
  using Cell = std::tuple<std::array<int, 3>, float, float, float>;

  static BondKind kind_of(const Network& network, Index element) {
    const Bonds& bonds = network.bonds;
    const std::vector<double>& volumes = network.particles.volumes;
    BondKind kind;
    for (int a = 0; a < network.dim(); ++a) kind.direction[a] = bonds.direction(element)[a];
    kind.length = bonds.length(element);
    kind.modulus = network.stiffness[element] /
                   (volumes[bonds.first[element]] * volumes[bonds.second[element]]);
    kind.limit =
        network.critical_stretch_of(element) * network.law(element).segment(0).limit * kind.length;
    return kind;
  }

  static Cell cell(const BondKind& kind) {
    std::array<int, 3> direction;
    for (int a = 0; a < 3; ++a) {
      direction[a] = static_cast<int>(std::lround(1e7 * kind.direction[a]));
    }
    return {direction, static_cast<float>(kind.length), static_cast<float>(kind.modulus),
            static_cast<float>(kind.limit)};
  }

  std::map<Cell, int> number_;
};

/// Directed bond on the stencil, at one of the particles of a group.
struct Half {
  int kind;
  bool incoming;
  Index shift;
  int lane;
  Index element;

  auto line() const { return std::tie(kind, incoming, shift); }
  friend bool operator<(const Half& a, const Half& b) {
    return std::tie(a.kind, a.incoming, a.shift, a.lane, a.element) <
           std::tie(b.kind, b.incoming, b.shift, b.lane, b.element);
  }
};

using HalvesOfGroups = std::vector<std::vector<Half>>;

/// Returns the directed bonds of elements with a kind, sorted by lines.
HalvesOfGroups sort_halves(const Network& network, const std::vector<int>& kind) {
  constexpr int lanes = BondStencil::lanes;
  HalvesOfGroups groups((network.particles.size() + lanes - 1) / lanes);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (kind[e] == no_kind) continue;
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    groups[i / lanes].push_back({kind[e], false, j - i, i % lanes, e});
    groups[j / lanes].push_back({kind[e], true, j - i, j % lanes, e});
  }
  for (std::vector<Half>& halves : groups) std::sort(halves.begin(), halves.end());
  return groups;
}

/// Removes kinds that fill their lines too thinly, and all but one of parallel bonds.
void drop_thin_kinds(const HalvesOfGroups& groups, std::size_t kinds, std::vector<int>& kind) {
  std::vector<double> halves(kinds, 0.0), lines(kinds, 0.0);
  std::vector<std::array<int, 2>> sides(kinds);  // lines of outgoing and incoming halves
  for (const std::vector<Half>& group : groups) {
    const Half* last = nullptr;
    for (const Half& half : group) {
      ++halves[half.kind];
      const bool same_line = last != nullptr && last->line() == half.line();
      if (!same_line) ++sides[half.kind][half.incoming];
      if (same_line && last->lane == half.lane) kind[half.element] = no_kind;
      last = &half;
    }
    for (const Half& half : group) {
      auto& count = sides[half.kind];
      lines[half.kind] += std::max(count[0], count[1]);
      count = {};
    }
  }
  for (int& k : kind) {
    if (k != no_kind && halves[k] < least_fill * lines[k]) k = no_kind;
  }
}

/// Returns the lines of a group, with outgoing and incoming bonds of a kind in one line, and
/// appends its elements.
std::vector<StencilLine> make_lines(const std::vector<Half>& halves, std::vector<Index>& element) {
  constexpr int lanes = BondStencil::lanes;
  std::vector<StencilLine> lines;
  const std::size_t first_slot = element.size();
  std::size_t first_of_kind = 0, next = 0;
  for (std::size_t h = 0; h < halves.size(); ++h) {
    const Half& half = halves[h];
    const bool new_kind = h == 0 || halves[h - 1].kind != half.kind;
    if (new_kind) first_of_kind = lines.size();
    if (new_kind || halves[h - 1].incoming != half.incoming) {
      next = first_of_kind;
    } else if (halves[h - 1].shift != half.shift) {
      ++next;
    }
    if (next == lines.size()) {
      lines.push_back({half.kind, 0, 0});
      element.resize(element.size() + BondStencil::line_slots, no_index);
    }
    (half.incoming ? lines[next].in : lines[next].out) = half.shift;
    const std::size_t side = 2 * next + half.incoming;
    element[first_slot + side * lanes + half.lane] = half.element;
  }
  return lines;
}

}  // namespace

BondStencil find_stencil(const Network& network) {
  Kinds found;
  std::vector<int> kind(static_cast<std::size_t>(network.num_elements()), no_kind);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.law(e).is_brittle() || network.is_embedded(e)) continue;
    const bool was_full = found.is_full();
    kind[e] = found.find(network, e);
    const bool fills_up = found.is_full() && !was_full;
    if (fills_up && static_cast<std::size_t>(e) < least_repeats * most_kinds) {
      std::fill(kind.begin(), kind.end(), no_kind);
      break;
    }
  }
  HalvesOfGroups groups = sort_halves(network, kind);
  drop_thin_kinds(groups, found.kinds.size(), kind);

  BondStencil stencil;
  std::map<std::vector<StencilLine>, int> patterns;
  for (std::vector<Half>& halves : groups) {
    std::erase_if(halves, [&](const Half& half) { return kind[half.element] == no_kind; });
    const std::size_t first_slot = stencil.element.size();
    std::vector<StencilLine> lines = make_lines(halves, stencil.element);
    const auto [entry, is_new] =
        patterns.try_emplace(std::move(lines), static_cast<int>(patterns.size()));
    if (is_new) stencil.patterns.push_back(entry->first);
    stencil.groups.push_back({entry->second, first_slot});
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (kind[e] == no_kind && !network.is_embedded(e)) stencil.rest.push_back(e);
  }
  if (!stencil.element.empty()) stencil.kinds = std::move(found.kinds);
  return stencil;
}

}  // namespace perilink
