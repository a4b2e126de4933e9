#pragma once

#include <functional>
#include <span>

#include <Eigen/SparseCore>

#include "base/types.hpp"

namespace perilink {

/// Symmetric matrix; only the lower triangle is stored.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Adds the numbers of a column of the lower triangle of a matrix to zeros: that of row r to
/// values[place[r]]. May be called by several threads at once.
using AddColumn =
    std::function<void(Index column, std::span<const Index> place, std::span<double> values)>;

/// The columns of a matrix that is stored.
inline AddColumn columns_of(const SparseMatrix& lower) {
  return [&lower](Index column, std::span<const Index> place, std::span<double> values) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      values[place[entry.row()]] += entry.value();
    }
  };
}

}  // namespace perilink
