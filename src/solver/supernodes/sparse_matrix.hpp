#pragma once

#include <Eigen/SparseCore>

#include "base/types.hpp"

namespace perilink {

/// Symmetric matrix; only the lower triangle is stored.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

}  // namespace perilink
