#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "calibration/bounded_least_squares/normal_equations.hpp"
#include "calibration/bounded_least_squares/system_product.hpp"

namespace perilink {

/// NormalEquations with a fixed number of equations per point, so that loops are unrolled.
/// \tparam Rows  equations per point
/// \tparam Odd  the first of them, of opposite sign at the two ends of a variable
/// \tparam Grouped  whether the last equation of a point is shared by its group
template <int Rows, int Odd, bool Grouped>
class FixedNormalEquations final : public NormalEquations {
 public:
  using NormalEquations::NormalEquations;

  void apply_transpose(const Vector& y, std::vector<double>& result) override;

 private:
  using Block = Eigen::Matrix<double, Rows, Rows>;
  static constexpr int own = Grouped ? Rows - 1 : Rows;  // rows per point, without the group row

  template <class Values>
  auto& last_row(Values& values, Index point) const {
    return values[static_cast<std::size_t>(equations_.group[point]) * Rows + own];
  }
  void add_forces(const std::vector<double>& w, std::size_t begin, std::size_t end,
                  Vector& result) const override;
  void add_product(const Vector& y, Vector& result) const override {
    add_system_product<Rows, Odd, Grouped>(equations_, active_weight, y, result);
  }
  void set_blocks(const std::vector<double>& blocks) override;
  void apply_blocks(const Vector& residual, Vector& result) const override;

  std::vector<Block> inverse_blocks_;
};

/// Computes result_v = a_v . (s y at the first end -+ s y at the second).
template <int Rows, int Odd, bool Grouped>
void FixedNormalEquations<Rows, Odd, Grouped>::apply_transpose(const Vector& y,
                                                               std::vector<double>& result) {
  for (std::size_t k = 0; k < size_; ++k) scaled_[k] = y[k] * equations_.scale[k];
  const auto ends = [&](std::size_t v) {
    return std::pair(scaled_.data() + static_cast<std::size_t>(equations_.first[v]) * Rows,
                     scaled_.data() + static_cast<std::size_t>(equations_.second[v]) * Rows);
  };
#pragma omp parallel for schedule(static) if (threads_share())
  for (std::size_t v = 0; v < num_paired_; ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    const auto [p, q] = ends(v);
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (p[r] - q[r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * (p[r] + q[r]);
    if constexpr (Grouped)
      sum += a[own] *
             (last_row(scaled_, equations_.first[v]) + last_row(scaled_, equations_.second[v]));
    result[v] = sum;
  }
  for (std::size_t v = num_paired_; v < result.size(); ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    const auto [p, q] = ends(v);
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (p[r] - q[r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * p[r];
    result[v] = sum;
  }
}

/// Adds the forces of a range of variables, times their weights.
template <int Rows, int Odd, bool Grouped>
void FixedNormalEquations<Rows, Odd, Grouped>::add_forces(const std::vector<double>& w,
                                                          std::size_t begin, std::size_t end,
                                                          Vector& result) const {
  for (std::size_t v = begin; v < end; ++v) {
    const double* a = equations_.coefficients.data() + v * Rows;
    double* p = result.data() + static_cast<std::size_t>(equations_.first[v]) * Rows;
    double* q = result.data() + static_cast<std::size_t>(equations_.second[v]) * Rows;
    const double weight = w[v];
    for (int r = 0; r < Odd; ++r) {
      const double term = a[r] * weight;
      p[r] += term;
      q[r] -= term;
    }
    for (int r = Odd; r < own; ++r) p[r] += a[r] * weight;
    if (v >= num_paired_) continue;
    for (int r = Odd; r < own; ++r) q[r] += a[r] * weight;
    if constexpr (Grouped) {
      last_row(result, equations_.first[v]) += a[own] * weight;
      last_row(result, equations_.second[v]) += a[own] * weight;
    }
  }
}

template <int Rows, int Odd, bool Grouped>
void FixedNormalEquations<Rows, Odd, Grouped>::set_blocks(const std::vector<double>& blocks) {
  inverse_blocks_.resize(size_ / Rows);
  for (std::size_t p = 0; p < inverse_blocks_.size(); ++p) {
    inverse_blocks_[p] = Eigen::Map<const Block>(blocks.data() + p * Rows * Rows);
  }
}

template <int Rows, int Odd, bool Grouped>
void FixedNormalEquations<Rows, Odd, Grouped>::apply_blocks(const Vector& residual,
                                                            Vector& result) const {
  using Column = Eigen::Matrix<double, Rows, 1>;
#pragma omp parallel for schedule(static) if (threads_share())
  for (std::size_t p = 0; p < inverse_blocks_.size(); ++p) {
    Eigen::Map<Column>(result.data() + p * Rows).noalias() =
        inverse_blocks_[p] * Eigen::Map<const Column>(residual.data() + p * Rows);
  }
}

}  // namespace perilink
