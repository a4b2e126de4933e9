#include "assembly/embedded_stiffness.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "assembly/cell_terms.hpp"
#include "assembly/element_blocks.hpp"
#include "base/csr.hpp"

namespace perilink {
namespace {

/// Groups of particles that the same unknowns move. A free particle is a group by itself; the
/// particles in a host element form one group.
class Bundles {
 public:
  Bundles(const Network& network, const Unknowns& motion)
      : of_particle(static_cast<std::size_t>(network.particles.size())) {
    std::map<std::vector<Index>, Index> numbers;
    std::vector<Index> moving;
    for (Index i = 0; i < network.particles.size(); ++i) {
      moving.clear();
      const std::size_t slot = static_cast<std::size_t>(i) * motion.width;
      for (int a = 0; a < motion.width; ++a) {
        motion.for_each(slot + a, [&](Index k, double) { moving.push_back(k); });
      }
      std::sort(moving.begin(), moving.end());
      moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
      const auto [entry, is_new] = numbers.emplace(moving, unknowns.rows());
      if (is_new) {
        unknowns.values.insert(unknowns.values.end(), moving.begin(), moving.end());
        unknowns.offsets.push_back(static_cast<Index>(unknowns.values.size()));
      }
      of_particle[i] = entry->second;
    }
    particles = sorted_into_rows(unknowns.rows(), [&](const auto& add) {
      for (Index i = 0; i < network.particles.size(); ++i) add(of_particle[i], i);
    });
  }

  Index size() const { return unknowns.rows(); }

  Csr unknowns;                    ///< that move each bundle, ascending
  Csr particles;                   ///< in each bundle
  std::vector<Index> of_particle;  ///< bundle of each particle
};

/// Returns the rows that couple with the unknowns of each bundle: the unknowns of all bundles that
/// its elements reach.
Csr coupled_unknowns(const Network& network, const Bundles& bundles, const Csr& neighbourhoods,
                     Index num_unknowns) {
  Csr rows;
  std::vector<Index> seen_bundle(static_cast<std::size_t>(bundles.size()), no_index);
  std::vector<Index> seen(static_cast<std::size_t>(num_unknowns), no_index);
  std::vector<Index> found;
  for (Index b = 0; b < bundles.size(); ++b) {
    found.clear();
    const auto look_at = [&](Index other) {
      if (seen_bundle[other] == b) return;
      seen_bundle[other] = b;
      for (const Index k : bundles.unknowns.row(other)) {
        if (seen[k] == b) continue;
        seen[k] = b;
        found.push_back(k);
      }
    };
    look_at(b);
    for (const Index i : bundles.particles.row(b)) {
      for (const Index e : neighbourhoods.row(i)) {
        look_at(bundles.of_particle[network.bonds.other_end(e, i)]);
      }
    }
    std::sort(found.begin(), found.end());
    rows.values.insert(rows.values.end(), found.begin(), found.end());
    rows.offsets.push_back(static_cast<Index>(rows.values.size()));
  }
  return rows;
}

/// Returns a zero matrix with an entry for every coupled pair of unknowns.
SparseMatrix lay_out(const Bundles& bundles, const Csr& coupled, Index num_unknowns) {
  const Csr bundles_of = sorted_into_rows(num_unknowns, [&](const auto& add) {
    for (Index b = 0; b < bundles.size(); ++b) {
      for (const Index k : bundles.unknowns.row(b)) add(k, b);
    }
  });
  SparseMatrix matrix(num_unknowns, num_unknowns);
  std::vector<Index> rows, seen(static_cast<std::size_t>(num_unknowns), no_index);
  for (Index column = 0; column < num_unknowns; ++column) {
    const std::size_t begin = rows.size();
    for (const Index b : bundles_of.row(column)) {
      for (const Index k : coupled.row(b)) {
        if (k < column || seen[k] == column) continue;
        seen[k] = column;
        rows.push_back(k);
      }
    }
    std::sort(rows.begin() + static_cast<std::ptrdiff_t>(begin), rows.end());
    matrix.outerIndexPtr()[column + 1] = static_cast<Index>(rows.size());
  }
  matrix.resizeNonZeros(static_cast<Index>(rows.size()));
  std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), rows.size(), 0.0);
  return matrix;
}

template <class Element>
class Assembler {
 public:
  Assembler(const Network& network, Secants secants, const Unknowns& unknowns)
      : network_(network),
        secants_(secants),
        unknowns_(unknowns),
        neighbourhoods_(bonds_of_particles(network.bonds, network.particles.size())),
        bundles_(network, unknowns),
        coupled_(coupled_unknowns(network, bundles_, neighbourhoods_, unknowns.count)),
        matrix_(lay_out(bundles_, coupled_, unknowns.count)),
        row_of_(static_cast<std::size_t>(unknowns.count)) {
    if (network.cells) cells_.emplace(*network.cells);
  }

  SparseMatrix build() {
    for (Index b = 0; b < bundles_.size(); ++b) {
      if (!bundles_.unknowns.row(b).empty()) add_bundle(b);
    }
    return std::move(matrix_);
  }

 private:
  /// Adds the bundle's elements to a dense block of its columns, then to the matrix.
  void add_bundle(Index b) {
    const auto rows = coupled_.row(b);
    const auto columns = bundles_.unknowns.row(b);
    for (std::size_t k = 0; k < rows.size(); ++k) row_of_[rows[k]] = static_cast<Index>(k);
    dense_.assign(rows.size() * columns.size(), 0.0);
    for (const Index i : bundles_.particles.row(b)) add_particle(i, columns, rows.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Index column = columns[c];
      const Index* row = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
      double* value = matrix_.valuePtr() + matrix_.outerIndexPtr()[column];
      for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k] < column) continue;
        while (*row < rows[k]) {
          ++row;
          ++value;
        }
        *value += dense_[c * rows.size() + k];
      }
    }
  }

  /// Computes the columns of the particle's own components and distributes them to the unknowns
  /// that move it.
  void add_particle(Index i, std::span<const Index> columns, std::size_t num_rows) {
    constexpr int width = Element::width;
    const std::size_t slot = static_cast<std::size_t>(i) * width;
    own_.assign(num_rows * width, 0.0);
    std::array<double, width * width> diagonal{};
    for (int a = 0; a < width && !network_.support_stiffness.empty(); ++a) {
      diagonal[a * width + a] = network_.support_stiffness[slot + a];
    }
    for (const Index e : neighbourhoods_.row(i)) {
      const Element element(network_, e, secants_);
      const int end = network_.bonds.first[e] == i ? 0 : 1;
      const std::size_t other = static_cast<std::size_t>(network_.bonds.other_end(e, i)) * width;
      for (int col = 0; col < width; ++col) {
        for (int row = 0; row < width; ++row) {
          diagonal[row * width + col] += element.entry(end, end, row, col);
          add(other + row, element.entry(1 - end, end, row, col), col * num_rows);
        }
      }
    }
    if (cells_) add_cells_of(i, num_rows);
    for (int col = 0; col < width; ++col) {
      for (int row = 0; row < width; ++row) {
        add(slot + row, diagonal[row * width + col], col * num_rows);
      }
      const double* from = own_.data() + col * num_rows;
      unknowns_.for_each(slot + col, [&](Index k, double weight) {
        const auto at = std::lower_bound(columns.begin(), columns.end(), k) - columns.begin();
        double* column = dense_.data() + static_cast<std::size_t>(at) * num_rows;
        for (std::size_t row = 0; row < num_rows; ++row) column[row] += weight * from[row];
      });
    }
  }

  void add_cells_of(Index i, std::size_t num_rows) {
    cells_->visit(i, [&](Index j, auto&& entry) {
      const std::size_t slot = static_cast<std::size_t>(j) * Element::width;
      for (int col = 0; col < Element::dim; ++col) {
        for (int row = 0; row < Element::dim; ++row) {
          add(slot + row, entry(row, col), col * num_rows);
        }
      }
    });
  }

  void add(std::size_t slot, double value, std::size_t first) {
    unknowns_.for_each(slot,
                       [&](Index k, double weight) { own_[first + row_of_[k]] += weight * value; });
  }

  const Network& network_;
  Secants secants_;
  const Unknowns& unknowns_;
  Csr neighbourhoods_;
  std::optional<CellBlocks<Element::dim>> cells_;
  Bundles bundles_;
  Csr coupled_;
  SparseMatrix matrix_;
  std::vector<Index> row_of_;  ///< per unknown: its position among the rows of the current bundle
  std::vector<double> dense_;  ///< columns of the current bundle
  std::vector<double> own_;    ///< columns of the components of the current particle
};

}  // namespace

SparseMatrix assemble_embedded(const Network& network, Secants secants, const Unknowns& unknowns) {
  const bool plane = network.dim() == 2;
  if (network.has_states()) expect_nothing_embedded(unknowns);
  if (network.carries_moments()) {
    return plane ? Assembler<Frame<2>>(network, secants, unknowns).build()
                 : Assembler<Frame<3>>(network, secants, unknowns).build();
  }
  return plane ? Assembler<Truss<2>>(network, secants, unknowns).build()
               : Assembler<Truss<3>>(network, secants, unknowns).build();
}

}  // namespace perilink
