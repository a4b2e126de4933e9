#include "solver/block_gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

/// One number for each of the right sides.
using Row = std::array<double, block_width>;

Row dots(std::span<const double> a, std::span<const double> b) {
  Row sums{};
  for (std::size_t begin = 0; begin < a.size(); begin += block_width) {
    for (int c = 0; c < block_width; ++c) sums[c] += a[begin + c] * b[begin + c];
  }
  return sums;
}

/// How far each right side has got.
struct Progress {
  std::array<EnergyGains, block_width> gains;
  Row energy{}, error{};

  void add(int c, double gain) {
    gains[c].add(gain);
    energy[c] += gain;
  }
  /// The largest error over the root of the energy.
  double largest_error(const Row& first) {
    double largest = 0.0;
    for (int c = 0; c < block_width; ++c) {
      error[c] = first[c] > 0.0 ? gains[c].error() : 0.0;
      if (error[c] > 0.0) largest = std::max(largest, error[c] / std::sqrt(energy[c]));
    }
    return largest;
  }
};

}  // namespace

GradientsReport block_conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                          std::span<double> right, std::span<double> solution,
                                          double enough, int most_iterations) {
  const std::size_t size = right.size();
  std::vector<double> z(size), q(size);
  precondition(right, z);
  std::vector<double> p = z;
  std::fill(solution.begin(), solution.end(), 0.0);
  Row rz = dots(right, z);
  const Row first = rz;
  Progress progress;
  GradientsReport report;
  report.converged = std::none_of(first.begin(), first.end(), [](double s) { return s > 0.0; });
  while (!report.converged && report.iterations < most_iterations) {
    product(p, q);
    const Row curvature = dots(p, q);
    Row step{};
    for (int c = 0; c < block_width; ++c) {
      if (!(rz[c] > 0.0)) continue;
      if (!(curvature[c] > 0.0)) {
        throw NotPositiveDefinite("the stiffness is not positive definite");
      }
      step[c] = rz[c] / curvature[c];
      progress.add(c, step[c] * rz[c]);
    }
    for (std::size_t begin = 0; begin < size; begin += block_width) {
      for (int c = 0; c < block_width; ++c) {
        solution[begin + c] += step[c] * p[begin + c];
        right[begin + c] -= step[c] * q[begin + c];
      }
    }
    ++report.iterations;
    report.error = progress.largest_error(first);
    report.converged = report.error <= enough;
    if (report.converged) break;
    precondition(right, z);
    const Row next = dots(right, z);
    Row share{};
    for (int c = 0; c < block_width; ++c) share[c] = rz[c] > 0.0 ? next[c] / rz[c] : 0.0;
    for (std::size_t begin = 0; begin < size; begin += block_width) {
      for (int c = 0; c < block_width; ++c) p[begin + c] = z[begin + c] + share[c] * p[begin + c];
    }
    rz = next;
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
