#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "network/unknowns.hpp"

/// \file
/// Assembles a symmetric matrix from blocks of elements. The blocks come from a class with
///
///   static constexpr int width;                       components of a particle
///   Index num_particles() const;
///   void visit(Index particle, auto&& sink) const;    calls sink(other, block) for every block of
///                                                     the rows of `other` and the columns of
///                                                     `particle`, in one order
///
/// where `block(row, col)` returns an entry, computed only on request. Blocks between the same
/// particles are summed; zeros stay in the pattern. Several threads may call visit() concurrently.

namespace perilink {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Particles of equal or higher number that blocks couple to each particle, ascending.
class CoupledParticles {
 public:
  template <class Blocks>
  explicit CoupledParticles(const Blocks& blocks) {
    const Index count = blocks.num_particles();
    chunks_.resize((static_cast<std::size_t>(count) + chunk_size - 1) / chunk_size);
#pragma omp parallel
    {
      std::vector<Index> seen(static_cast<std::size_t>(count), no_index);
      std::vector<Index> found(static_cast<std::size_t>(count));
#pragma omp for schedule(static)
      for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        Csr& rows = chunks_[chunk];
        const Index begin = static_cast<Index>(chunk) * chunk_size;
        for (Index i = begin; i < std::min(count, begin + chunk_size); ++i) {
          Index* end = found.data();
          *end++ = i;
          blocks.visit(i, [&](Index j, const auto&) {
            if (j <= i || seen[j] == i) return;
            seen[j] = i;
            *end++ = j;
          });
          if (!std::is_sorted(found.data(), end)) std::sort(found.data(), end);
          rows.values.insert(rows.values.end(), found.data(), end);
          rows.offsets.push_back(static_cast<Index>(rows.values.size()));
        }
      }
    }
  }

  std::span<const Index> row(Index particle) const {
    return chunks_[particle / chunk_size].row(particle % chunk_size);
  }

 private:
  static constexpr Index chunk_size = 1024;
  std::vector<Csr> chunks_;
};

/// Assembles an Eigen matrix between unknowns without embedded particles.
template <class Blocks>
class LowerTriangle {
 public:
  static constexpr int width = Blocks::width;

  LowerTriangle(const Blocks& blocks, const Unknowns& unknowns)
      : blocks_(blocks),
        unknowns_(unknowns),
        coupled_(blocks),
        free_(static_cast<std::size_t>(blocks.num_particles())) {
    for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
      if (unknowns.number[slot] != no_index) free_[slot / width].set(slot % width);
    }
  }

  /// One thread computes all columns of a particle, so that sums do not depend on the number of
  /// threads.
  SparseMatrix build() const {
    SparseMatrix matrix(unknowns_.count, unknowns_.count);
    lay_out(matrix);
#pragma omp parallel
    {
      std::vector<Index> place(free_.size());
#pragma omp for schedule(static)
      for (Index i = 0; i < blocks_.num_particles(); ++i) {
        if (free_[i].any()) fill_columns(i, place, matrix);
      }
    }
    return matrix;
  }

 private:
  void lay_out(SparseMatrix& matrix) const {
    std::vector<std::uint8_t> num_free;
    for (const auto& free : free_) num_free.push_back(static_cast<std::uint8_t>(free.count()));
    Index* outer = matrix.outerIndexPtr();
    std::size_t total = 0;
    for (Index i = 0; i < blocks_.num_particles(); ++i) {
      std::size_t rows = 0;
      for (const Index j : coupled_.row(i)) rows += num_free[j];
      for (int axis = 0; axis < width; ++axis) {
        const Index column = unknowns_.at(i, axis);
        if (column == no_index) continue;
        total += rows--;
        if (total > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
          throw std::length_error("the stiffness matrix has more than 2^31 - 1 entries");
        }
        outer[column + 1] = static_cast<Index>(total);
      }
    }
    matrix.resizeNonZeros(static_cast<Index>(total));
  }

  /// Unknowns are numbered in the order of the particles. So rows come out sorted, and the columns
  /// of a particle are contiguous, each without the first row of the one before.
  /// \param place  scratch, per particle: number of rows above its own, or -1 minus it if the
  ///               particle or i has a prescribed component
  void fill_columns(Index i, std::vector<Index>& place, SparseMatrix& matrix) const {
    std::array<double*, width> values{};  // columns as if they had all rows; null: prescribed
    Index first = no_index, end = 0, skipped = 0;
    for (int col = 0; col < width; ++col) {
      const Index column = unknowns_.at(i, col);
      if (column == no_index) continue;
      const Index begin = matrix.outerIndexPtr()[column];
      end = matrix.outerIndexPtr()[column + 1];
      if (first == no_index) first = begin;
      values[col] = matrix.valuePtr() + begin - skipped++;
    }
    std::fill(matrix.valuePtr() + first, matrix.valuePtr() + end, 0.0);
    Index* rows = matrix.innerIndexPtr() + first;
    Index count = 0;
    for (const Index j : coupled_.row(i)) {
      place[j] = (free_[i] & free_[j]).all() ? count : -1 - count;
      for (int row = 0; row < width; ++row) {
        if (free_[j][row]) rows[count++] = unknowns_.at(j, row);
      }
    }
    Index* next = rows + count;
    for (Index k = 1; k < skipped; ++k) next = std::copy(rows + k, rows + count, next);
    std::array<double, width * width> own{};
    blocks_.visit(i, [&](Index j, const auto& block) {
      if (j < i) return;
      if (j == i) {
        for (int row = 0; row < width; ++row) {
          for (int col = 0; col <= row; ++col) own[row * width + col] += block(row, col);
        }
        return;
      }
      const Index above = place[j];
      if (above >= 0) {
        for (int col = 0; col < width; ++col) {
          for (int row = 0; row < width; ++row) values[col][above + row] += block(row, col);
        }
        return;
      }
      for (int col = 0; col < width; ++col) {
        if (values[col] == nullptr) continue;
        double* value = values[col] - 1 - above;
        for (int row = 0; row < width; ++row) {
          if (free_[j][row]) *value++ += block(row, col);
        }
      }
    });
    for (int col = 0; col < width; ++col) {
      if (values[col] == nullptr) continue;
      double* value = matrix.valuePtr() + matrix.outerIndexPtr()[unknowns_.at(i, col)];
      for (int row = col; row < width; ++row) {
        if (free_[i][row]) *value++ = own[row * width + col];
      }
    }
  }

  const Blocks& blocks_;
  const Unknowns& unknowns_;
  CoupledParticles coupled_;
  std::vector<std::bitset<width>> free_;
};

}  // namespace perilink
