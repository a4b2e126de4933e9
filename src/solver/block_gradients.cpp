#include "solver/block_gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// What r'z of a right side falls to where it is solved for exactly, as in bodies of few unknowns:
/// steps from there on would divide by nothing.
constexpr double all_gone = 1e-40;

BlockRow dots(std::span<const double> a, std::span<const double> b, const SumOverParts& sum) {
  BlockRow sums{};
  for (std::size_t begin = 0; begin < a.size(); begin += block_width) {
    for (int c = 0; c < block_width; ++c) sums[c] += a[begin + c] * b[begin + c];
  }
  if (sum) sum(sums);
  return sums;
}

/// The largest error of those that go on, as it counts.
double largest_error(const std::array<EnergyGains, block_width>& gains, const BlockRow& sizes,
                     const std::array<bool, block_width>& goes_on) {
  double largest = 0.0;
  for (int c = 0; c < block_width; ++c) {
    if (goes_on[c]) largest = std::max(largest, gains[c].error() / std::sqrt(sizes[c]));
  }
  return largest;
}

}  // namespace

GradientsReport block_conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                          std::span<double> right, std::span<double> solution,
                                          const BlockRow& sizes, double enough, int most_iterations,
                                          const SumOverParts& sum) {
  const std::size_t size = right.size();
  std::vector<double> z(size), q(size);
  precondition(right, z);
  std::vector<double> p = z;
  std::fill(solution.begin(), solution.end(), 0.0);
  BlockRow rz = dots(right, z, sum);
  const BlockRow first = rz;
  std::array<EnergyGains, block_width> gains;
  std::array<bool, block_width> goes_on{};
  const auto stop_where_all_is_gone = [&] {
    // Written so that what is not a number goes on, up to the limit.
    for (int c = 0; c < block_width; ++c) goes_on[c] = !(rz[c] <= all_gone * first[c]);
    return std::ranges::none_of(goes_on, std::identity());
  };
  GradientsReport report;
  report.converged = stop_where_all_is_gone();
  while (!report.converged && report.iterations < most_iterations) {
    product(p, q);
    const BlockRow curvature = dots(p, q, sum);
    BlockRow step{}, share{};
    for (int c = 0; c < block_width; ++c) {
      if (!goes_on[c]) continue;
      if (!(curvature[c] > 0.0)) {
        throw NotPositiveDefinite("the stiffness is not positive definite");
      }
      step[c] = rz[c] / curvature[c];
      gains[c].add(step[c] * rz[c]);
    }
    for (std::size_t begin = 0; begin < size; begin += block_width) {
      for (int c = 0; c < block_width; ++c) {
        solution[begin + c] += step[c] * p[begin + c];
        right[begin + c] -= step[c] * q[begin + c];
      }
    }
    ++report.iterations;
    report.error = largest_error(gains, sizes, goes_on);
    report.converged = report.error <= enough;
    if (report.converged) break;
    precondition(right, z);
    const BlockRow next = dots(right, z, sum);
    for (int c = 0; c < block_width; ++c) share[c] = goes_on[c] ? next[c] / rz[c] : 0.0;
    for (std::size_t begin = 0; begin < size; begin += block_width) {
      for (int c = 0; c < block_width; ++c) p[begin + c] = z[begin + c] + share[c] * p[begin + c];
    }
    rz = next;
    report.converged = stop_where_all_is_gone();
  }
  return report;
}

void recombine(std::vector<std::vector<double>>& blocks, std::span<const double> shares) {
  const std::size_t old = blocks.size() * block_width, fewer = shares.size() / old;
  std::vector<double> row(fewer);
  for (std::size_t begin = 0; begin < blocks.front().size(); begin += block_width) {
    for (std::size_t first = 0; first < fewer; first += block_width) {
      std::array<double, block_width> sums{};
      const double* share = shares.data() + first;
      for (std::vector<double>& block : blocks) {
        for (int c = 0; c < block_width; ++c, share += fewer) {
          const double value = block[begin + c];
          for (int k = 0; k < block_width; ++k) sums[k] += value * share[k];
        }
      }
      std::copy(sums.begin(), sums.end(), row.begin() + static_cast<std::ptrdiff_t>(first));
    }
    for (std::size_t first = 0; first < fewer; first += block_width) {
      std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(first), block_width,
                  blocks[first / block_width].begin() + static_cast<std::ptrdiff_t>(begin));
    }
  }
  blocks.resize(fewer / block_width);
}

void add_combination(std::span<const double> columns, std::span<const double> weights,
                     std::span<double> result) {
  const double* column = columns.data();
  const double* weight = weights.data();
  for (double& sum : result) {
    double part[8] = {};
    for (int c = 0; c < block_width; c += 8) {
      for (int k = 0; k < 8; ++k) part[k] += column[c + k] * weight[c + k];
    }
    sum +=
        ((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7]));
    column += block_width;
  }
}

}  // namespace perilink
