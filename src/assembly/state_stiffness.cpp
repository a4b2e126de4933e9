#include "assembly/state_stiffness.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/csr.hpp"

namespace perilink {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// For every particle itself and all particles of higher number that a bond or a common neighbour
/// couples it with, ascending.
Csr coupled_particles(const Bonds& bonds, const Csr& families) {
  Csr coupled;
  std::vector<Index> seen(static_cast<std::size_t>(families.rows()), no_index);
  std::vector<Index> own;
  const auto other_end = [&](Index e, Index i) {
    return bonds.first[e] == i ? bonds.second[e] : bonds.first[e];
  };
  for (Index i = 0; i < families.rows(); ++i) {
    own.clear();
    const auto note = [&](Index j) {
      if (j < i || seen[j] == i) return;
      seen[j] = i;
      own.push_back(j);
    };
    note(i);
    for (const Index e : families.row(i)) {
      const Index center = other_end(e, i);
      note(center);
      for (const Index far : families.row(center)) note(other_end(far, center));
    }
    std::sort(own.begin(), own.end());
    coupled.values.insert(coupled.values.end(), own.begin(), own.end());
    coupled.offsets.push_back(static_cast<Index>(coupled.values.size()));
  }
  return coupled;
}

template <int Dim>
class StateStiffness {
 public:
  StateStiffness(const Network& network, std::span<const double> secants, const Unknowns& unknowns)
      : network_(network),
        secants_(secants),
        unknowns_(unknowns),
        families_(bonds_of_particles(network.bonds, network.particles.size())),
        coupled_(coupled_particles(network.bonds, families_)),
        own_(static_cast<std::size_t>(network.particles.size()), Vector::Zero()) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (network.counts_for(e, first_end)) {
        own_[network.bonds.first[e]] -= secants[e] * direction(e);
      }
      if (network.counts_for(e, second_end)) {
        own_[network.bonds.second[e]] += secants[e] * direction(e);
      }
    }
  }

  SparseMatrix build() {
    SparseMatrix matrix(unknowns_.count, unknowns_.count);
    lay_out(matrix);
    const Index num_particles = network_.particles.size();
#pragma omp parallel
    {
      std::vector<Index> place(static_cast<std::size_t>(num_particles), no_index);
      std::vector<Block> blocks;
#pragma omp for schedule(static)
      for (Index i = 0; i < num_particles; ++i) {
        sum_blocks(i, place, blocks);
        write_columns(i, blocks, matrix);
      }
    }
    return matrix;
  }

 private:
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Block = Eigen::Matrix<double, Dim, Dim>;

  Vector direction(Index e) const {
    return Eigen::Map<const Vector>(network_.bonds.direction(e).data());
  }

  int num_free(Index particle) const {
    int count = 0;
    for (int axis = 0; axis < Dim; ++axis) count += unknowns_.at(particle, axis) != no_index;
    return count;
  }

  void lay_out(SparseMatrix& matrix) const {
    Index* outer = matrix.outerIndexPtr();
    std::size_t total = 0;
    outer[0] = 0;
    for (Index i = 0; i < network_.particles.size(); ++i) {
      std::size_t below = 0;
      for (const Index j : coupled_.row(i).subspan(1)) below += num_free(j);
      int own = num_free(i);
      for (int axis = 0; axis < Dim; ++axis) {
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

  /// Blocks of rows of the coupled particles and columns of particle i.
  /// \param place  per particle: place among the coupled ones; no_index all over between calls
  void sum_blocks(Index i, std::vector<Index>& place, std::vector<Block>& blocks) const {
    const Bonds& bonds = network_.bonds;
    const std::span<const Index> coupled = coupled_.row(i);
    for (std::size_t k = 0; k < coupled.size(); ++k) place[coupled[k]] = static_cast<Index>(k);
    blocks.assign(coupled.size(), Block::Zero());
    /// The derivative of a particle's sum of extensions by the motion of i is `by_i`.
    const auto add_state = [&](Index center, const Vector& by_i) {
      const Vector column = network_.state_stiffness[center] * by_i;
      if (center >= i) blocks[place[center]] += own_[center] * column.transpose();
      for (const Index e : families_.row(center)) {
        const bool outward = bonds.first[e] == center;
        if (!network_.counts_for(e, outward ? first_end : second_end)) continue;
        const Index j = outward ? bonds.second[e] : bonds.first[e];
        if (j < i) continue;
        const double sign = outward ? secants_[e] : -secants_[e];
        blocks[place[j]] += sign * direction(e) * column.transpose();
      }
    };
    add_state(i, own_[i]);
    for (const Index e : families_.row(i)) {
      const bool outward = bonds.first[e] == i;
      const Index j = outward ? bonds.second[e] : bonds.first[e];
      const Vector n = direction(e);
      const Block truss = secants_[e] * network_.stiffness[e] * n * n.transpose();
      blocks[0] += truss;
      if (j > i) blocks[place[j]] -= truss;
      if (!network_.counts_for(e, outward ? second_end : first_end)) continue;
      add_state(j, (outward ? -secants_[e] : secants_[e]) * n);
    }
    for (const Index j : coupled) place[j] = no_index;
  }

  /// Numbers of unknowns rise with those of the particles, so rows come out sorted.
  void write_columns(Index i, std::vector<Block>& blocks, SparseMatrix& matrix) const {
    const std::span<const Index> coupled = coupled_.row(i);
    if (!network_.support_stiffness.empty()) {
      blocks[0] +=
          Eigen::Map<const Vector>(network_.support_stiffness.data() + i * std::size_t{Dim})
              .asDiagonal();
    }
    for (int col = 0; col < Dim; ++col) {
      const Index column = unknowns_.at(i, col);
      if (column == no_index) continue;
      Index entry = matrix.outerIndexPtr()[column];
      for (std::size_t k = 0; k < coupled.size(); ++k) {
        for (int row = k == 0 ? col : 0; row < Dim; ++row) {
          const Index number = unknowns_.at(coupled[k], row);
          if (number == no_index) continue;
          matrix.innerIndexPtr()[entry] = number;
          matrix.valuePtr()[entry++] = blocks[k](row, col);
        }
      }
    }
  }

  const Network& network_;
  std::span<const double> secants_;
  const Unknowns& unknowns_;
  Csr families_;
  Csr coupled_;
  std::vector<Vector> own_;  ///< derivative of the sum of extensions by the particle's own motion
};

}  // namespace

SparseMatrix assemble_state_stiffness(const Network& network, std::span<const double> secants,
                                      const Unknowns& unknowns) {
  return network.dim() == 2 ? StateStiffness<2>(network, secants, unknowns).build()
                            : StateStiffness<3>(network, secants, unknowns).build();
}

}  // namespace perilink
