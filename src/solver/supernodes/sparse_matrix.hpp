#pragma once

#include <functional>
#include <span>

#include <Eigen/SparseCore>

#include "base/types.hpp"

namespace perilink {

/// Symmetric matrix, stored as its lower triangle.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Adds a column of the matrix's lower triangle to `values`, which hold zeros: the number of row r
/// to values[place[r]]. Several threads may call it at once.
using AddColumn =
    std::function<void(Index column, std::span<const Index> place, std::span<double> values)>;

/// Returns a function that adds columns of a stored matrix.
inline AddColumn columns_of(const SparseMatrix& lower) {
  return [&lower](Index column, std::span<const Index> place, std::span<double> values) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      values[place[entry.row()]] += entry.value();
    }
  };
}

}  // namespace perilink
