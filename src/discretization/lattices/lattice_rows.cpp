#include "discretization/lattices/lattice_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace perilink {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;
using Step = std::array<int, 3>;
using RowBasis = std::array<Vector3, 3>;
using RowKey = std::pair<int, int>;  ///< second and third lattice coordinate

/// Rows are padded with empty slots to a multiple of this number. Otherwise vectorised loops would
/// process the remainder one particle at a time.
constexpr int lanes = 8;

Vector3 turned(const Vector3& v, double angle) {
  return {v[0] * std::cos(angle) - v[1] * std::sin(angle),
          v[0] * std::sin(angle) + v[1] * std::cos(angle), v[2]};
}

Vector3 combine(const RowBasis& basis, const std::array<double, 3>& factor) {
  Vector3 sum{};
  for (int n = 0; n < 3; ++n) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += factor[n] * basis[n][axis];
  }
  return sum;
}

Vector3 combine(const RowBasis& basis, const Step& step) {
  return combine(basis, std::array<double, 3>{1.0 * step[0], 1.0 * step[1], 1.0 * step[2]});
}

/// Returns rows of the reciprocal lattice, which give the coordinates of a vector in the basis.
RowBasis inverse(const RowBasis& m) {
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  RowBasis rows{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
  double volume = 0.0;
  for (int axis = 0; axis < 3; ++axis) volume += m[0][axis] * rows[0][axis];
  for (Vector3& row : rows) {
    for (double& entry : row) entry /= volume;
  }
  return rows;
}

OwnBond own_bond(const RowBasis& basis, const Step& step) {
  OwnBond bond{step, combine(basis, step), 0.0};
  bond.length = std::hypot(bond.direction[0], bond.direction[1], bond.direction[2]);
  for (double& entry : bond.direction) entry /= bond.length;
  return bond;
}

struct Pattern3 {
  int dim = 2;
  RowBasis basis{};
  std::vector<Step> own;
};

class RowBuilder {
 public:
  RowBuilder(const Pattern3& pattern, const LatticeCut& cut) : pattern_(pattern), cut_(cut) {
    lattice_.dim = pattern.dim;
    lattice_.spacing = cut.spacing;
    for (const Step& step : pattern.own) lattice_.bonds.push_back(own_bond(pattern.basis, step));
  }

  LatticeRows build() {
    collect_particles();
    number_slots();
    place_particles();
    mark_bonds();
    return std::move(lattice_);
  }

 private:
  struct Row {
    int first = 0, last = -1;   ///< particles and padding
    int lower = 0, upper = -1;  ///< slots
    Index begin = 0;            ///< slot of `lower`
    Index number = no_index;    ///< among the rows with particles
    std::vector<int> columns;   ///< columns of the row's particles, ascending
    bool empty() const { return columns.empty(); }
    Index slot(int column) const { return begin + (column - lower); }
    void cover(int from, int to) {
      lower = upper < lower ? from : std::min(lower, from);
      upper = upper < lower ? to : std::max(upper, to);
    }
  };

  Vector3 point(int i, const RowKey& key) const {
    Vector3 x = combine(pattern_.basis, Step{i, key.first, key.second});
    for (int axis = 0; axis < 3; ++axis) x[axis] += cut_.origin[axis];
    return x;
  }

  bool in_box(const Vector3& x) const {
    for (int axis = 0; axis < pattern_.dim; ++axis) {
      if (x[axis] < cut_.lower[axis] || x[axis] > cut_.upper[axis]) return false;
    }
    return true;
  }

  /// Returns bounds of the lattice coordinates in the box, taken at its corners.
  std::array<std::array<int, 2>, 3> coordinate_range() const {
    const RowBasis rows = inverse(pattern_.basis);
    std::array<std::array<int, 2>, 3> range{};
    for (int n = 0; n < pattern_.dim; ++n) {
      double low = 0.0, high = 0.0;
      for (int axis = 0; axis < pattern_.dim; ++axis) {
        const double a = rows[n][axis] * (cut_.lower[axis] - cut_.origin[axis]);
        const double b = rows[n][axis] * (cut_.upper[axis] - cut_.origin[axis]);
        low += std::min(a, b);
        high += std::max(a, b);
      }
      range[n] = {static_cast<int>(std::floor(low)), static_cast<int>(std::ceil(high))};
    }
    return range;
  }

  void collect_particles() {
    const auto range = coordinate_range();
    for (int k = range[2][0]; k <= range[2][1]; ++k) {
      for (int j = range[1][0]; j <= range[1][1]; ++j) {
        for (int i = range[0][0]; i <= range[0][1]; ++i) {
          const Vector3 x = point(i, {j, k});
          if (in_box(x) && cut_.inside(x)) table_[{k, j}].columns.push_back(i);
        }
      }
    }
    if (table_.empty()) throw std::invalid_argument("no lattice point lies in the body");
    for (auto& [key, row] : table_) {
      row.first = row.columns.front();
      const int size = row.columns.back() - row.first + 1;
      row.last = row.first + (size + lanes - 1) / lanes * lanes - 1;
    }
  }

  /// Returns the key of the row that a step leads to; the table is sorted by layer, then row.
  static RowKey moved(const RowKey& key, const Step& step, int sign) {
    return {key.first + sign * step[2], key.second + sign * step[1]};
  }

  void number_slots() {
    const std::map<RowKey, Row> filled = table_;
    for (const auto& [key, row] : filled) {
      table_[key].cover(row.first, row.last);
      for (const Step& step : pattern_.own) {
        for (const int sign : {-1, 1}) {
          table_[moved(key, step, sign)].cover(row.first + sign * step[0],
                                               row.last + sign * step[0]);
        }
      }
    }
    Index rows = 0;
    for (auto& [key, row] : table_) {
      if (!row.empty()) row.number = rows++;
      row.begin = lattice_.slots;
      lattice_.slots += row.upper - row.lower + 1;
    }
  }

  void place_particles() {
    const auto slots = static_cast<std::size_t>(lattice_.slots);
    lattice_.positions.assign(slots * lattice_.dim, 0.0);
    lattice_.present.assign(slots * lattice_.bonds.size(), 0.0);
    lattice_.bond_count.assign(slots, 0);
    solid_.assign(slots, false);
    for (const auto& [key, row] : table_) {
      if (row.empty()) continue;
      lattice_.rows.push_back({row.slot(row.first), row.last - row.first + 1});
      for (const Step& step : pattern_.own) {
        const Row& out = table_.at(moved(key, step, 1));
        const Row& in = table_.at(moved(key, step, -1));
        lattice_.shift_out.push_back(out.slot(row.first + step[0]) - row.slot(row.first));
        lattice_.row_out.push_back(out.number);
        if (out.number != no_index) {
          lattice_.reach = std::max(lattice_.reach, std::abs(out.number - row.number));
        }
        lattice_.row_in.push_back(in.number);
        lattice_.shift_in.push_back(row.slot(row.first) - in.slot(row.first - step[0]));
      }
      for (const int column : row.columns) {
        const Index slot = row.slot(column);
        const Vector3 x = point(column, {key.second, key.first});
        for (int axis = 0; axis < lattice_.dim; ++axis) {
          lattice_.positions[lattice_.at(axis, slot)] = x[axis];
        }
        solid_[slot] = true;
        lattice_.particle_slot.push_back(slot);
      }
    }
  }

  void mark_bonds() {
    for (std::size_t r = 0; r < lattice_.rows.size(); ++r) {
      const LatticeRow& row = lattice_.rows[r];
      for (int k = 0; k < lattice_.own_bonds(); ++k) {
        const Index shift = lattice_.shift_out[r * lattice_.bonds.size() + k];
        for (Index slot = row.first; slot < row.first + row.size; ++slot) {
          if (!solid_[slot] || !solid_[slot + shift]) continue;
          lattice_.present[lattice_.at(k, slot)] = 1.0;
          ++lattice_.bond_count[slot];
          ++lattice_.bond_count[slot + shift];
        }
      }
    }
  }

  Pattern3 pattern_;
  const LatticeCut& cut_;
  LatticeRows lattice_;
  std::map<RowKey, Row> table_;
  std::vector<bool> solid_;
};

LatticeRows build(Pattern3 pattern, const LatticeCut& cut) {
  for (Vector3& vector : pattern.basis) {
    vector = turned(vector, cut.rotation);
    for (double& entry : vector) entry *= cut.spacing;
  }
  return RowBuilder(pattern, cut).build();
}

}  // namespace

LatticeRows hexagonal_rows(const LatticeCut& cut) {
  const Pattern3 pattern{2,
                         {{{1.0, 0.0, 0.0}, {0.5, 0.5 * sqrt3, 0.0}, {0.0, 0.0, 1.0}}},
                         {{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}}};
  LatticeRows lattice = build(pattern, cut);
  lattice.cell_volume = 0.5 * sqrt3 * cut.spacing * cut.spacing * cut.thickness;
  return lattice;
}

LatticeRows face_centred_rows(const LatticeCut& cut) {
  const double half = 1.0 / sqrt2;
  // Vectors along face diagonals; sums such as a - b + c are edges of the cube.
  const Pattern3 pattern{3,
                         {{{half, half, 0.0}, {0.0, half, half}, {half, 0.0, half}}},
                         {{1, 0, 0},
                          {0, 1, 0},
                          {0, 0, 1},
                          {-1, 1, 0},
                          {0, -1, 1},
                          {-1, 0, 1},
                          {1, -1, 1},
                          {-1, -1, 1},
                          {-1, 1, 1}}};
  LatticeRows lattice = build(pattern, cut);
  lattice.cell_volume = cut.spacing * cut.spacing * cut.spacing / sqrt2;
  return lattice;
}

}  // namespace perilink
