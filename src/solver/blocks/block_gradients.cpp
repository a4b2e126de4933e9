#include "solver/blocks/block_gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "base/lanes.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

constexpr int width = block_width;

/// Small matrix of products between the vectors of two blocks.
using Square = std::array<BlockRow, width>;

Square times(const Square& a, const Square& b) {
  Square result{};
  for (int i = 0; i < width; ++i) {
    for (int k = 0; k < width; ++k) {
      for (int j = 0; j < width; ++j) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

template <class Number>
using Row = LongLanes<Number, width>;

template <class Number>
const Row<Number>& at(const Number* numbers) {
  return *reinterpret_cast<const Row<Number>*>(numbers);
}
template <class Number>
Row<Number>& at(Number* numbers) {
  return *reinterpret_cast<Row<Number>*>(numbers);
}

/// Computes sum += a'b over some rows. Partial sums have the precision of the numbers, the sum of
/// the parts is in double precision.
template <class Number>
void add_gram(std::span<const Number> a, std::span<const Number> b, std::size_t begin,
              std::size_t end, Square& sum) {
  constexpr std::size_t part = 256;
  // Sums stay in registers: there are 16, or 32 of the longest ones.
  constexpr int registers = register_bytes == 64 ? 16 : 8;
  constexpr int together = registers / static_cast<int>(Row<Number>::count);
  for (std::size_t past = begin; begin < end; begin = past) {
    past = std::min(begin + part, end);
    for (int first = 0; first < width; first += together) {
      Row<Number> rows[together] = {};
      for (std::size_t k = begin * width; k < past * width; k += width) {
        const Row<Number> row = at(b.data() + k);
        for (int c = 0; c < together; ++c) rows[c] += a[k + first + c] * row;
      }
      for (int c = 0; c < together; ++c) {
        for (int d = 0; d < width; ++d) sum[first + c][d] += static_cast<double>(rows[c][d]);
      }
    }
  }
}

/// Sums over the parts of vectors.
struct PartSums {
  std::array<Square, most_parts> parts{};

  Square sum() const {
    Square result{};
    for (const Square& part : parts) {
      for (int i = 0; i < width; ++i) {
        for (int j = 0; j < width; ++j) result[i][j] += part[i][j];
      }
    }
    return result;
  }
};

/// Least numbers of a block for which threads save time.
constexpr std::size_t many_numbers = 16 * 12'000;

/// Calls work(part, begin, end) for the parts of a block.
template <class Work>
void for_each_part(std::size_t numbers, Work work) {
  const std::size_t parts = numbers < many_numbers ? 1 : most_parts, rows = numbers / width;
#pragma omp parallel for schedule(dynamic) if (parts > 1)
  for (std::size_t k = 0; k < parts; ++k) {
    work(k, rows * k / parts * width, rows * (k + 1) / parts * width);
  }
}

/// Rows of a small matrix, by which rows of blocks are multiplied.
template <class Number>
class Shares {
 public:
  explicit Shares(const Square& shares) {
    for (int c = 0; c < width; ++c) {
      std::array<Number, width> row;
      for (int d = 0; d < width; ++d) row[d] = static_cast<Number>(shares[c][d]);
      rows_[c] = at(row.data());
    }
  }
  /// Returns the row of a block times the matrix.
  Row<Number> operator()(const Number* row) const {
    Row<Number> sum = row[0] * rows_[0];
    for (int c = 1; c < width; ++c) sum += row[c] * rows_[c];
    return sum;
  }

 private:
  Row<Number> rows_[width];
};

/// Returns the inverse of p'A p for linearly independent directions p; zeros for the other
/// directions.
/// \param same   least squared remainder of a direction of unit length, below which it depends
///     linearly on others
/// \param sides  p'r, whose columns are right sides of the steps
Square inverse_of(const Square& matrix, const Square& sides, double same) {
  constexpr double negative = -1e-3;
  const auto require = [](bool positive) {
    if (!positive) throw NotPositiveDefinite("the stiffness is not positive definite");
  };
  BlockRow scale{};
  for (int c = 0; c < width; ++c) {
    require(matrix[c][c] > 0.0 || (matrix[c][c] == 0.0 && sides[c][c] == 0.0));
    if (matrix[c][c] > 0.0) scale[c] = 1.0 / std::sqrt(matrix[c][c]);
  }
  Square left;
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < width; ++j) {
      left[i][j] = 0.5 * (matrix[i][j] + matrix[j][i]) * scale[i] * scale[j];
    }
  }
  std::array<bool, width> taken{};
  for (int step = 0; step < width; ++step) {  // next: the direction most independent of those taken
    int next = -1;
    for (int c = 0; c < width; ++c) {
      require(taken[c] || left[c][c] >= negative);
      if (!taken[c] && (next < 0 || left[c][c] > left[next][next])) next = c;
    }
    const double pivot = left[next][next];
    if (pivot <= same) break;
    taken[next] = true;
    for (int i = 0; i < width; ++i) {
      for (int j = 0; i != next && j < width; ++j) {
        if (j != next) left[i][j] -= left[i][next] * left[next][j] / pivot;
      }
    }
    for (int i = 0; i < width; ++i) {
      left[i][next] /= i == next ? 1.0 : pivot;
      left[next][i] /= i == next ? 1.0 : pivot;
    }
    left[next][next] = -1.0 / pivot;
  }
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < width; ++j) {
      left[i][j] = taken[i] && taken[j] ? -left[i][j] * scale[i] * scale[j] : 0.0;
    }
  }
  return left;
}

/// Returns the largest error over the square root of its size.
double largest(const BlockRow& sizes, auto error_of) {
  double result = 0.0;
  for (int c = 0; c < width; ++c) {
    if (sizes[c] > 0.0) result = std::max(result, error_of(c) / std::sqrt(sizes[c]));
  }
  return result;
}

/// Returns the largest square root of r'z over its size, an estimate of the error.
double left_by(const Square& rz, const BlockRow& sizes) {
  return largest(sizes, [&](int c) { return std::sqrt(std::max(rz[c][c], 0.0)); });
}

/// Takes a step along the directions: solution += p steps, right -= q steps. \return new p'right
template <class Number>
Square take_step(std::span<const Number> p, std::span<const Number> q, const Square& steps,
                 std::span<Number> solution, std::span<Number> right) {
  constexpr std::size_t together = 256 * width;
  const Shares<Number> share(steps);
  PartSums sides;
  for_each_part(p.size(), [&](std::size_t part, std::size_t begin, std::size_t past) {
    for (std::size_t end = begin; begin < past; begin = end) {
      end = std::min(begin + together, past);
      for (std::size_t k = begin; k < end; k += width) {
        at(solution.data() + k) += share(p.data() + k);
        at(right.data() + k) -= share(q.data() + k);
      }
      add_gram<Number>(p, right, begin / width, end / width, sides.parts[part]);
    }
  });
  return sides.sum();
}

/// Computes p <- z - p shares.
template <class Number>
void renew(std::span<Number> p, std::span<const Number> z, const Square& shares) {
  const Shares<Number> share(shares);
  for_each_part(p.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; k += width) {
      at(p.data() + k) = at(z.data() + k) - share(p.data() + k);
    }
  });
}

Square transposed(const Square& matrix) {
  Square result;
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < width; ++j) result[i][j] = matrix[j][i];
  }
  return result;
}

/// Computes a -= b.
void subtract(Square& a, const Square& b) {
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < width; ++j) a[i][j] -= b[i][j];
  }
}

/// Products of residuals r, preconditioned residuals z, directions p and their products q.
struct Products {
  Square pr, rz, qz;
};

template <class Number>
void find_products(const BlockMap<Number>& precondition, std::span<const Number> r,
                   std::span<const Number> q, std::span<Number> z, Products& products) {
  PartSums rz, qz;
  precondition(r, z, [&](std::size_t part, std::size_t begin, std::size_t end) {
    add_gram<Number>(r, z, begin, end, rz.parts[part]);
    add_gram<Number>(q, z, begin, end, qz.parts[part]);
  });
  products.rz = rz.sum();
  products.qz = qz.sum();
}

/// Computes q = A p. \return p'A p
template <class Number>
Square find_energies(const BlockMap<Number>& product, std::span<const Number> p,
                     std::span<Number> q) {
  PartSums sums;
  product(p, q, [&](std::size_t part, std::size_t begin, std::size_t end) {
    add_gram<Number>(p, q, begin, end, sums.parts[part]);
  });
  return sums.sum();
}

/// Records the energy that a step adds to every solution.
void add_gains(const Square& sides, const Square& steps, std::array<EnergyGains, width>& gains) {
  for (int c = 0; c < width; ++c) {
    double gained = 0.0;
    for (int d = 0; d < width; ++d) gained += sides[d][c] * steps[d][c];
    gains[c].add(std::max(gained, 0.0));
  }
}

/// Least estimated error over the allowed one; smaller residuals count as zero, also in soft
/// bodies.
constexpr double gone = 1e-3;

}  // namespace

template <class Number>
GradientsReport block_conjugate_gradients(
    const BlockMap<Number>& product, const BlockMap<Number>& precondition, std::span<Number> right,
    std::span<Number> solution, const BlockRow& sizes, double enough, int most_iterations,
    const std::function<void(std::span<const Number> solution, std::span<Number> right)>& correct,
    const SumOverParts& sum, BlockSpace<Number>* space) {
  constexpr double epsilon = std::numeric_limits<Number>::epsilon();
  constexpr double same = std::max(10.0 * epsilon, 1e-12);
  BlockSpace<Number> own;
  auto& [p, q, z] = space != nullptr ? *space : own;
  for (BlockVector<Number>* vectors : {&p, &q, &z}) vectors->resize(right.size());
  std::ranges::fill(solution, Number{0});
  std::array<EnergyGains, width> gains;
  Products now{};
  const auto sum_up = [&](auto& squares) {
    if (sum) sum({reinterpret_cast<double*>(&squares), sizeof(squares) / sizeof(double)});
  };
  const auto find_z = [&] {
    find_products<Number>(precondition, right, q, z, now);
    sum_up(now);
  };
  find_z();
  std::ranges::copy(z, p.begin());
  Square sides = transposed(now.rz);  // p'r
  double corrected_at = left_by(now.rz, sizes);
  GradientsReport report;
  while (report.iterations < most_iterations) {
    Square energies = find_energies<Number>(product, p, q);
    sum_up(energies);
    const Square inverse = inverse_of(energies, sides, same);
    const Square steps = times(inverse, sides);
    add_gains(sides, steps, gains);
    now.pr = take_step<Number>(p, q, steps, solution, right);
    ++report.iterations;
    report.error = largest(sizes, [&](int c) { return gains[c].error(); });
    const bool is_exact = !correct || 0.1 * digits_between_corrections * corrected_at <= enough;
    report.converged = report.error <= enough && is_exact;
    if (report.converged) break;
    find_z();
    const double left = left_by(now.rz, sizes);
    report.converged = left <= gone * enough && is_exact;
    if (report.converged) report.error = left;
    if (report.converged) break;
    if (correct && (left < digits_between_corrections * corrected_at || report.error <= enough)) {
      correct(solution, right);
      std::ranges::fill(solution, Number{0});
      add_gram<Number>(p, right, 0, right.size() / width, now.pr = {});
      find_z();
      const double before = std::exchange(corrected_at, left_by(now.rz, sizes));
      if (!(corrected_at < least_gain_of_digits * before)) break;
    }
    const Square shares = times(inverse, now.qz);
    renew<Number>(p, z, shares);
    sides = transposed(now.rz);
    subtract(sides, times(transposed(shares), now.pr));
  }
  return report;
}

template GradientsReport block_conjugate_gradients<double>(
    const BlockMap<double>&, const BlockMap<double>&, std::span<double>, std::span<double>,
    const BlockRow&, double, int,
    const std::function<void(std::span<const double>, std::span<double>)>&, const SumOverParts&,
    BlockSpace<double>*);
template GradientsReport block_conjugate_gradients<float>(
    const BlockMap<float>&, const BlockMap<float>&, std::span<float>, std::span<float>,
    const BlockRow&, double, int,
    const std::function<void(std::span<const float>, std::span<float>)>&, const SumOverParts&,
    BlockSpace<float>*);

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
