#include "assembly/stiffness.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "assembly/element_vector.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/state_stiffness.hpp"
#include "base/csr.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

Index low_end(const Bonds& bonds, Index e) { return std::min(bonds.first[e], bonds.second[e]); }
Index high_end(const Bonds& bonds, Index e) { return std::max(bonds.first[e], bonds.second[e]); }

/// Elements of every particle to particles of higher number, sorted by that number.
Csr elements_by_low_end(const Bonds& bonds, Index num_particles) {
  Csr rows;
  rows.offsets.assign(static_cast<std::size_t>(num_particles) + 1, 0);
  for (Index e = 0; e < bonds.size(); ++e) ++rows.offsets[low_end(bonds, e) + 1];
  for (Index i = 0; i < num_particles; ++i) rows.offsets[i + 1] += rows.offsets[i];
  rows.values.resize(static_cast<std::size_t>(bonds.size()));
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  for (Index e = 0; e < bonds.size(); ++e) rows.values[next[low_end(bonds, e)]++] = e;
  // Bonds come sorted; only ties and bars that start at a solid particle can be out of order.
  const auto by_high_end = [&](Index a, Index b) {
    return high_end(bonds, a) < high_end(bonds, b);
  };
  for (Index i = 0; i < num_particles; ++i) {
    const auto begin = rows.values.begin() + rows.offsets[i];
    const auto end = rows.values.begin() + rows.offsets[i + 1];
    if (!std::is_sorted(begin, end, by_high_end)) std::stable_sort(begin, end, by_high_end);
  }
  return rows;
}

/// Two blocks of an element's stiffness, entry by entry: that of an end with itself and that which
/// couples the rows of the higher end to the columns of the lower one.
template <int Dim>
struct TrussBlocks {
  static constexpr int width = Dim;

  TrussBlocks(const Network& network, Index element, double secant)
      : n(network.bonds.direction(element).data()), k(network.stiffness[element] * secant) {}

  double of_first(int row, int col) const { return k * n[row] * n[col]; }
  double of_second(int row, int col) const { return k * n[row] * n[col]; }
  double coupling(int row, int col) const { return -k * n[row] * n[col]; }

  const double* n;
  double k;
};

template <int Dim>
struct FrameBlocks {
  using Modes = FrameModes<Dim>;
  static constexpr int width = Modes::width;

  FrameBlocks(const Network& network, Index element, double secant)
      : modes(frame_modes<Dim>(network, element)),
        low_is_first(network.bonds.first[element] < network.bonds.second[element]) {
    for (double& k : modes.stiffness) k *= secant;
  }

  double sum(int row, int col, const auto& rows, const auto& cols) const {
    double value = 0.0;
    for (int m = 0; m < Modes::count; ++m) {
      value += modes.stiffness[m] * rows[m][row] * cols[m][col];
    }
    return value;
  }
  double of_first(int row, int col) const { return sum(row, col, modes.first, modes.first); }
  double of_second(int row, int col) const { return sum(row, col, modes.second, modes.second); }
  double coupling(int row, int col) const {
    return low_is_first ? sum(row, col, modes.second, modes.first)
                        : sum(row, col, modes.first, modes.second);
  }

  Modes modes;
  bool low_is_first;
};

template <class ElementBlocks>
class StiffnessBuilder {
 public:
  static constexpr int width = ElementBlocks::width;

  StiffnessBuilder(const Network& network, std::span<const double> secants,
                   const Unknowns& unknowns)
      : network_(network),
        secants_(secants),
        unknowns_(unknowns),
        elements_(elements_by_low_end(network.bonds, network.particles.size())) {}

  SparseMatrix build() {
    SparseMatrix matrix(unknowns_.count, unknowns_.count);
    lay_out(matrix);
    sum_diagonal_blocks();
    const Index num_particles = network_.particles.size();
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < num_particles; ++i) fill_columns(i, matrix);
    return matrix;
  }

 private:
  using Block = std::array<double, width * width>;

  int num_free(Index particle) const {
    int count = 0;
    for (int axis = 0; axis < width; ++axis) count += unknowns_.at(particle, axis) != no_index;
    return count;
  }

  /// Column starts: the free axes of the particle itself from the column's own on, then those of
  /// every higher neighbour once, however many elements lead there.
  void lay_out(SparseMatrix& matrix) const {
    Index* outer = matrix.outerIndexPtr();
    std::size_t total = 0;
    outer[0] = 0;
    for (Index i = 0; i < network_.particles.size(); ++i) {
      std::size_t below = 0;
      Index last = no_index;
      for (const Index e : elements_.row(i)) {
        const Index j = high_end(network_.bonds, e);
        if (j != last) below += num_free(j);
        last = j;
      }
      int own = num_free(i);
      for (int axis = 0; axis < width; ++axis) {
        const Index column = unknowns_.at(i, axis);
        if (column == no_index) continue;
        total += own-- + below;
        if (total > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
          throw std::length_error("the stiffness matrix has more than 2^31 - 1 entries");
        }
        outer[column + 1] = static_cast<Index>(total);
      }
    }
    matrix.resizeNonZeros(static_cast<Index>(total));
  }

  void sum_diagonal_blocks() {
    diagonal_.assign(static_cast<std::size_t>(network_.particles.size()), Block{});
    for (Index e = 0; e < network_.num_elements(); ++e) {
      const ElementBlocks element(network_, e, secants_[e]);
      Block& first = diagonal_[network_.bonds.first[e]];
      Block& second = diagonal_[network_.bonds.second[e]];
      for (int row = 0; row < width; ++row) {
        for (int col = 0; col <= row; ++col) {
          first[row * width + col] += element.of_first(row, col);
          second[row * width + col] += element.of_second(row, col);
        }
      }
    }
    for (std::size_t slot = 0; slot < network_.support_stiffness.size(); ++slot) {
      const std::size_t row = slot % width;
      diagonal_[slot / width][row * width + row] += network_.support_stiffness[slot];
    }
  }

  /// Columns of one particle. Numbers of unknowns rise with those of the particles, so rows come
  /// out sorted.
  void fill_columns(Index i, SparseMatrix& matrix) const {
    Index* inner = matrix.innerIndexPtr();
    double* values = matrix.valuePtr();
    std::array<Index, width> position{};  // next entry of each column, no_index for a held one
    for (int col = 0; col < width; ++col) {
      const Index column = unknowns_.at(i, col);
      position[col] = column == no_index ? no_index : matrix.outerIndexPtr()[column];
      if (column == no_index) continue;
      for (int row = col; row < width; ++row) {
        if (unknowns_.at(i, row) == no_index) continue;
        inner[position[col]] = unknowns_.at(i, row);
        values[position[col]++] = diagonal_[i][row * width + col];
      }
    }
    Index last = no_index;
    for (const Index e : elements_.row(i)) {
      const Index j = high_end(network_.bonds, e);
      const int rows = num_free(j);
      const ElementBlocks element(network_, e, secants_[e]);
      for (int col = 0; col < width; ++col) {
        if (position[col] == no_index) continue;
        // A second element to the same particle adds to the entries of the first.
        Index entry = j == last ? position[col] - rows : position[col];
        for (int row = 0; row < width; ++row) {
          if (unknowns_.at(j, row) == no_index) continue;
          const double value = element.coupling(row, col);
          inner[entry] = unknowns_.at(j, row);
          values[entry] = j == last ? values[entry] + value : value;
          ++entry;
        }
        position[col] = entry;
      }
      last = j;
    }
  }

  const Network& network_;
  std::span<const double> secants_;
  const Unknowns& unknowns_;
  Csr elements_;
  std::vector<Block> diagonal_;  // lower triangles
};

/// Sum of x x' over the modes of all elements and the springs of supports: for particles that
/// something carries, whose elements couple any number of unknowns.
SparseMatrix assemble_carried(const Network& network, std::span<const double> secants,
                              const Unknowns& unknowns) {
  if (network.has_states()) expect_nothing_carried(unknowns);
  std::vector<Eigen::Triplet<double, Index>> entries;
  const auto add = [&](const SparseVector& x, double factor) {
    for (int a = 0; a < x.size(); ++a) {
      for (int b = 0; b < x.size(); ++b) {
        if (x.rows[a] < x.rows[b]) continue;
        entries.emplace_back(x.rows[a], x.rows[b], factor * x.values[a] * x.values[b]);
      }
    }
  };
  for (Index e = 0; e < network.num_elements(); ++e) {
    const ElementVectors parts = element_vectors(network, unknowns, e, 1.0);
    for (int m = 0; m < parts.count; ++m) add(parts.x[m], secants[e]);
    // Modes that are taken together couple all unknowns of both ends, and the ordering asks for it.
    SparseVector all;
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      for (int a = 0; a < unknowns.width; ++a) {
        const std::size_t slot = static_cast<std::size_t>(i) * unknowns.width + a;
        unknowns.for_each(slot, [&](Index k, double) { all.add(k, 0.0); });
      }
    }
    add(all, 0.0);
  }
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    SparseVector x;
    unknowns.for_each(slot, [&](Index k, double weight) { x.add(k, weight); });
    add(x, network.support_stiffness[slot]);
  }
  SparseMatrix matrix(unknowns.count, unknowns.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SparseMatrix assemble_stiffness(const Network& network, std::span<const double> secants,
                                const Unknowns& unknowns) {
  const bool plane = network.dim() == 2;
  if (unknowns.carries()) return assemble_carried(network, secants, unknowns);
  if (network.has_states()) return assemble_state_stiffness(network, secants, unknowns);
  if (network.carries_moments()) {
    return plane ? StiffnessBuilder<FrameBlocks<2>>(network, secants, unknowns).build()
                 : StiffnessBuilder<FrameBlocks<3>>(network, secants, unknowns).build();
  }
  return plane ? StiffnessBuilder<TrussBlocks<2>>(network, secants, unknowns).build()
               : StiffnessBuilder<TrussBlocks<3>>(network, secants, unknowns).build();
}

std::vector<double> assemble_right_hand_side(const Network& network,
                                             std::span<const double> secants,
                                             const Unknowns& unknowns, const Loads& loads) {
  if (!is_driven(unknowns)) return right_hand_side(unknowns, loads, {});
  return right_hand_side(unknowns, loads,
                         internal_force(network, secants, unknowns.prescribed).forces);
}

bool is_driven(const Unknowns& unknowns) {
  return std::any_of(unknowns.prescribed.begin(), unknowns.prescribed.end(),
                     [](double u) { return u != 0.0; });
}

std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    std::span<const double> driven) {
  std::vector<double> result(static_cast<std::size_t>(unknowns.count));
  for (std::size_t slot = 0; slot < loads.forces.size(); ++slot) {
    const double force = loads.forces[slot] - (driven.empty() ? 0.0 : driven[slot]);
    unknowns.for_each(slot, [&](Index k, double weight) { result[k] += weight * force; });
  }
  return result;
}

std::vector<Index> particle_of_unknown(const Unknowns& unknowns) {
  std::vector<Index> particles;
  for (const std::size_t slot : unknowns.slots()) {
    particles.push_back(static_cast<Index>(slot / static_cast<std::size_t>(unknowns.width)));
  }
  return particles;
}

}  // namespace perilink
