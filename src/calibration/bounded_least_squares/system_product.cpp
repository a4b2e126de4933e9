#include "calibration/bounded_least_squares/system_product.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Adds variables that act at both ends in all rows, with the last row at the points of `group`.
template <int Rows, int Odd, bool Grouped>
void add_paired(const PointEquations& equations, std::span<const double> active_weight, Index end,
                const double* y, double* result) {
  constexpr int own = Grouped ? Rows - 1 : Rows;
  for (Index v = 0; v < end; ++v) {
    if (active_weight[v] == 0.0) continue;
    const double* a = equations.coefficients.data() + static_cast<std::size_t>(v) * Rows;
    const std::size_t first = static_cast<std::size_t>(equations.first[v]) * Rows;
    const std::size_t second = static_cast<std::size_t>(equations.second[v]) * Rows;
    const double *p = y + first, *q = y + second;
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int r = 0; r < own; ++r) sum += a[r] * (r < Odd ? p[r] - q[r] : p[r] + q[r]);
    std::size_t at_first = 0, at_second = 0;
    if constexpr (Grouped) {
      at_first = static_cast<std::size_t>(equations.group[equations.first[v]]) * Rows + own;
      at_second = static_cast<std::size_t>(equations.group[equations.second[v]]) * Rows + own;
      sum += a[own] * (y[at_first] + y[at_second]);
    }
    sum *= active_weight[v];
    double *to_first = result + first, *to_second = result + second;
#pragma omp simd
    for (int r = 0; r < own; ++r) to_first[r] += a[r] * sum;
#pragma omp simd
    for (int r = 0; r < own; ++r) to_second[r] += r < Odd ? -a[r] * sum : a[r] * sum;
    if constexpr (Grouped) {
      result[at_first] += a[own] * sum;
      result[at_second] += a[own] * sum;
    }
  }
}

/// Adds variables that act on rows that are not odd only at their first end.
template <int Rows, int Odd, bool Grouped>
void add_one_ended(const PointEquations& equations, std::span<const double> active_weight,
                   Index begin, const double* y, double* result) {
  constexpr int own = Grouped ? Rows - 1 : Rows;
  for (Index v = begin; v < equations.num_variables(); ++v) {
    if (active_weight[v] == 0.0) continue;
    const double* a = equations.coefficients.data() + static_cast<std::size_t>(v) * Rows;
    const std::size_t first = static_cast<std::size_t>(equations.first[v]) * Rows;
    const std::size_t second = static_cast<std::size_t>(equations.second[v]) * Rows;
    double sum = 0.0;
    for (int r = 0; r < Odd; ++r) sum += a[r] * (y[first + r] - y[second + r]);
    for (int r = Odd; r < own; ++r) sum += a[r] * y[first + r];
    sum *= active_weight[v];
    for (int r = 0; r < own; ++r) result[first + r] += a[r] * sum;
    for (int r = 0; r < Odd; ++r) result[second + r] -= a[r] * sum;
  }
}

}  // namespace

template <int Rows, int Odd, bool Grouped>
void add_system_product(const PointEquations& equations, std::span<const double> active_weight,
                        std::span<const double> y, std::span<double> result) {
  const Index paired = std::min(equations.num_variables(), equations.one_ended);
  add_paired<Rows, Odd, Grouped>(equations, active_weight, paired, y.data(), result.data());
  add_one_ended<Rows, Odd, Grouped>(equations, active_weight, paired, y.data(), result.data());
}

#define PERILINK_PRODUCT(Rows, Odd, Grouped)            \
  template void add_system_product<Rows, Odd, Grouped>( \
      const PointEquations&, std::span<const double>, std::span<const double>, std::span<double>);
PERILINK_PRODUCT(5, 0, false)
PERILINK_PRODUCT(8, 0, false)
PERILINK_PRODUCT(15, 0, false)
PERILINK_PRODUCT(26, 0, false)
PERILINK_PRODUCT(4, 4, false)
PERILINK_PRODUCT(5, 4, true)
PERILINK_PRODUCT(8, 6, false)
PERILINK_PRODUCT(9, 6, true)
PERILINK_PRODUCT(10, 10, false)
PERILINK_PRODUCT(11, 10, true)
PERILINK_PRODUCT(18, 13, false)
PERILINK_PRODUCT(19, 13, true)
#undef PERILINK_PRODUCT

}  // namespace perilink
