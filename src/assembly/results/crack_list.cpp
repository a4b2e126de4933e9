#include "assembly/results/crack_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/joined_parts.hpp"
#include "material/principal_values.hpp"

namespace perilink {
namespace {

/// Least opening between two maxima of one crack, over the smaller maximum [-].
constexpr double least_saddle = 0.5;
/// Least opening of a cell of a crack over its largest one, and of a crack over the widest one [-];
/// what opens less is diffuse damage.
constexpr double least_part = 0.1;
/// Least length of the mean direction of the bonds of a particle at a surface [-]; a flat face of a
/// lattice has 0.4 to 0.6, the next layer less than 0.3.
constexpr double one_sided = 0.35;

using Key = std::array<Index, 3>;

/// Damaged bonds with their middles in a cube of one spacing.
struct Cell {
  std::vector<std::size_t> places;  ///< in CrackOpenings::bonds
  Vector3 centre{};                 ///< of the middles, weighted with openings [length]
  double weight = 0.0;              ///< sum of openings [length]
  double opening = 0.0;             ///< of its bonds, the upper quartile [length]
};

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 padded(std::span<const double> values) {
  Vector3 result{};
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

/// Lists the cracks of one state.
class CrackLister {
 public:
  CrackLister(const Network& network, const Csr& neighbourhoods, const CrackOpenings& openings,
              double spacing)
      : network_(network), neighbourhoods_(neighbourhoods), openings_(openings), spacing_(spacing) {
    for (std::size_t k = 0; k < openings.bonds.size(); ++k) {
      Cell& cell = cells_[key_of(middle(k))];
      cell.places.push_back(k);
      const double opening = openings.opening[k];
      for (int a = 0; a < 3; ++a) cell.centre[a] += opening * middle(k)[a];
      cell.weight += opening;
    }
    for (auto& [key, cell] : cells_) {
      for (double& x : cell.centre) x /= cell.weight;
      cell.opening = upper_quartile(cell);
    }
    std::erase_if(cells_, [](const auto& entry) { return !(entry.second.opening > 0.0); });
    find_bars();
  }

  std::vector<GrownCrack> list() const {
    std::vector<GrownCrack> cracks;
    for (const std::vector<Key>& cells : connected_cells()) cracks.push_back(crack_of(cells));
    std::stable_sort(cracks.begin(), cracks.end(), [](const GrownCrack& a, const GrownCrack& b) {
      return a.largest_opening > b.largest_opening;
    });
    std::erase_if(cracks, [&, widest = cracks.empty() ? 0.0 : cracks.front().largest_opening](
                              const GrownCrack& crack) {
      return crack.largest_opening < least_part * widest;
    });
    return cracks;
  }

 private:
  double upper_quartile(const Cell& cell) const {
    std::vector<double> sorted;
    for (const std::size_t k : cell.places) sorted.push_back(openings_.opening[k]);
    std::sort(sorted.begin(), sorted.end());
    return sorted[3 * (sorted.size() - 1) / 4];
  }

  Vector3 position(Index particle) const { return padded(network_.particles.position(particle)); }

  Vector3 middle_of(Index element) const {
    const Vector3 first = position(network_.bonds.first[element]);
    const Vector3 second = position(network_.bonds.second[element]);
    return {0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1]),
            0.5 * (first[2] + second[2])};
  }
  Vector3 middle(std::size_t place) const { return middle_of(openings_.bonds[place]); }

  /// Middles of a lattice's bonds lie at multiples of half a spacing, away from the cells' sides.
  Key key_of(const Vector3& at) const {
    Key key{};
    for (int a = 0; a < network_.dim(); ++a) {
      key[a] = static_cast<Index>(std::floor(at[a] / spacing_ + 0.25));
    }
    return key;
  }

  /// Notes the bars that pass through each cell.
  void find_bars() {
    for (std::size_t s = 0; s < network_.bars.bar.size(); ++s) {
      const Index e = network_.first_bar_element + static_cast<Index>(s);
      const auto cell = cells_.find(key_of(middle_of(e)));
      if (cell != cells_.end()) bars_[cell->first].push_back(e);
    }
  }

  /// Returns the cells of each crack: joined from the widest to the narrowest.
  std::vector<std::vector<Key>> connected_cells() const {
    std::vector<Key> keys;
    for (const auto& [key, cell] : cells_) keys.push_back(key);
    std::stable_sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
      return cells_.at(a).opening > cells_.at(b).opening;
    });
    std::map<Key, Index> number;
    JoinedParts parts(static_cast<Index>(keys.size()));
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const Index own = number[keys[k]] = static_cast<Index>(k);
      std::vector<Index> around = roots_around(keys[k], number, parts);
      // The smallest number has the largest maximum.
      const auto reaches = [&](Index root, double part) {
        return cells_.at(keys[k]).opening >= part * cells_.at(keys[root]).opening;
      };
      std::erase_if(around, [&](Index root) { return !reaches(root, least_part); });
      for (const Index root : around) {
        if (root == around.front() || reaches(root, least_saddle)) parts.join(around.front(), root);
      }
      if (!around.empty()) parts.join(around.front(), own);
    }
    std::map<Index, std::vector<Key>> by_root;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      by_root[parts.find(static_cast<Index>(k))].push_back(keys[k]);
    }
    std::vector<std::vector<Key>> cracks;
    for (auto& [root, cells] : by_root) cracks.push_back(std::move(cells));
    return cracks;
  }

  /// Returns the parts of the cells around a cell that have numbers, ascending.
  std::vector<Index> roots_around(const Key& key, const std::map<Key, Index>& number,
                                  JoinedParts& parts) const {
    std::vector<Index> roots;
    for (int n = 0; n < 27; ++n) {
      const auto found =
          number.find({key[0] + n % 3 - 1, key[1] + n / 3 % 3 - 1, key[2] + n / 9 - 1});
      if (found != number.end() && found->first != key) roots.push_back(parts.find(found->second));
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    return roots;
  }

  bool is_at_surface(Index particle) const {
    Vector3 sum{};
    double count = 0.0;
    for (const Index b : neighbourhoods_.row(particle)) {
      if (b >= network_.first_contact()) continue;
      const double sign = network_.bonds.first[b] == particle ? 1.0 : -1.0;
      const Vector3 n = padded(network_.bonds.direction(b));
      for (int a = 0; a < 3; ++a) sum[a] += sign * n[a];
      count += 1.0;
    }
    return dot(sum, sum) > std::pow(one_sided * count, 2);
  }

  /// Returns whether a bond of a cell lies in a surface.
  bool is_at_surface(const Cell& cell) const {
    return std::any_of(cell.places.begin(), cell.places.end(), [&](std::size_t k) {
      const Index e = openings_.bonds[k];
      return is_at_surface(network_.bonds.first[e]) && is_at_surface(network_.bonds.second[e]);
    });
  }

  /// Adds the openings of a cell to those of its crack, whose normal is known.
  void add_openings(GrownCrack& crack, const Key& key) const {
    constexpr double least_cosine = 0.5;
    const Cell& cell = cells_.at(key);
    if (cell.opening > crack.largest_opening) {
      crack.largest_opening = cell.opening;
      crack.widest_at.assign(cell.centre.begin(), cell.centre.begin() + network_.dim());
    }
    if (cell.opening > crack.face_opening.value_or(0.0) && is_at_surface(cell)) {
      crack.face_opening = cell.opening;
    }
    const auto bars = bars_.find(key);
    if (bars == bars_.end() || !(cell.opening > crack.bar_opening)) return;
    for (const Index e : bars->second) {
      const auto along = network_.bonds.direction(e);
      const double cosine =
          std::inner_product(along.begin(), along.end(), crack.normal.begin(), 0.0);
      if (std::abs(cosine) < least_cosine) continue;
      crack.bar = network_.bars.bar[e - network_.first_bar_element];
      crack.bar_opening = cell.opening;
    }
  }

  /// Fits a line or a plane to the middles of a crack's bonds, weighted with their openings.
  void fit(GrownCrack& crack, const std::vector<Key>& keys) const {
    double weight = 0.0;
    Vector3 middle{};
    for_each_bond(keys, [&](const Vector3& at, double opening) {
      ++crack.bonds;
      weight += opening;
      for (int a = 0; a < 3; ++a) middle[a] += opening * at[a];
    });
    for (double& x : middle) x /= weight;
    crack.mean_opening = weight / crack.bonds;
    SymmetricTensor spread{}, opposite{};
    for_each_bond(keys, [&](const Vector3& at, double opening) {
      add_square(spread, opening, {at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]});
    });
    for (std::size_t c = 0; c < spread.size(); ++c) opposite[c] = -spread[c];
    const int dim = network_.dim();
    const Vector3 along = principal_direction(spread, dim);
    const Vector3 normal = principal_direction(opposite, dim);
    double least = infinity, largest = -infinity;
    for_each_bond(keys, [&](const Vector3& at, double) {
      least = std::min(least, dot(at, along));
      largest = std::max(largest, dot(at, along));
    });
    crack.length = largest - least;
    crack.middle.assign(middle.begin(), middle.begin() + dim);
    crack.normal.assign(normal.begin(), normal.begin() + dim);
  }

  GrownCrack crack_of(const std::vector<Key>& keys) const {
    GrownCrack crack;
    fit(crack, keys);
    for (const Key& key : keys) add_openings(crack, key);
    return crack;
  }

  /// Calls visit(middle, opening) for the bonds of cells.
  template <class Visit>
  void for_each_bond(const std::vector<Key>& keys, Visit visit) const {
    for (const Key& key : keys) {
      for (const std::size_t k : cells_.at(key).places) visit(middle(k), openings_.opening[k]);
    }
  }

  const Network& network_;
  const Csr& neighbourhoods_;
  const CrackOpenings& openings_;
  double spacing_;
  std::map<Key, Cell> cells_;
  std::map<Key, std::vector<Index>> bars_;  ///< bar elements with their middles in a cell
};

}  // namespace

std::vector<GrownCrack> list_cracks(const Network& network, const Csr& neighbourhoods,
                                    const CrackOpenings& openings, double spacing) {
  return CrackLister(network, neighbourhoods, openings, spacing).list();
}

}  // namespace perilink
