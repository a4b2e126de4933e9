#pragma once

#include <Eigen/Core>
#include <span>

#include "base/types.hpp"

namespace perilink {

/// Returns a view of the components of particle `number` in an array of shape (particles, Dim).
template <int Dim>
Eigen::Map<const Eigen::Matrix<double, Dim, 1>> vector_at(std::span<const double> values,
                                                          Index number) {
  return Eigen::Map<const Eigen::Matrix<double, Dim, 1>>(values.data() +
                                                         static_cast<std::size_t>(number) * Dim);
}

}  // namespace perilink
