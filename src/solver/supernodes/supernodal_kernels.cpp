#include "solver/supernodes/supernodal_kernels.hpp"

#include <cstddef>

#include "base/lanes.hpp"

namespace perilink::supernodal {
namespace {

/// Columns processed together: one pass over `local` serves all of them. Prefetchers of current
/// processors follow this number of streams.
constexpr Index width = 8;

template <class Number>
Number* column(Number* block, Index rows, Index j) {
  return block + static_cast<std::size_t>(j) * rows;
}

/// Computes local[r] -= sum of p_k l_k[r] for r >= from and `width` columns at c.
template <class Number>
void eliminate_panel(const Number* c, Index rows, Index from, const double* p, double* local) {
  const Number *c0 = c, *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
  const Number *c4 = c3 + rows, *c5 = c4 + rows, *c6 = c5 + rows, *c7 = c6 + rows;
  const double p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3];
  const double p4 = p[4], p5 = p[5], p6 = p[6], p7 = p[7];
#pragma omp simd
  for (Index r = from; r < rows; ++r) {
    local[r] -= ((p0 * c0[r] + p1 * c1[r]) + (p2 * c2[r] + p3 * c3[r])) +
                ((p4 * c4[r] + p5 * c5[r]) + (p6 * c6[r] + p7 * c7[r]));
  }
}

/// Computes sums[k] = sum over r >= from of l_k[r] local[r] for `width` columns at c.
template <class Number>
void dot_panel(const Number* c, Index rows, Index from, const double* local, double* sums) {
  const Number *c0 = c, *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
  const Number *c4 = c3 + rows, *c5 = c4 + rows, *c6 = c5 + rows, *c7 = c6 + rows;
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0;
#pragma omp simd reduction(+ : s0, s1, s2, s3, s4, s5, s6, s7)
  for (Index r = from; r < rows; ++r) {
    const double y = local[r];
    s0 += c0[r] * y, s1 += c1[r] * y, s2 += c2[r] * y, s3 += c3[r] * y;
    s4 += c4[r] * y, s5 += c5[r] * y, s6 += c6[r] * y, s7 += c7[r] * y;
  }
  sums[0] = s0, sums[1] = s1, sums[2] = s2, sums[3] = s3;
  sums[4] = s4, sums[5] = s5, sums[6] = s6, sums[7] = s7;
}

/// Adds to dot_panel() for each column, the last one first: l += beta w; w += p l (the old l).
void dot_and_change_panel(double* c, Index rows, Index from, const double* p, const double* b,
                          const double* local, double* w, double* sums) {
  double *c0 = c, *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
  double *c4 = c3 + rows, *c5 = c4 + rows, *c6 = c5 + rows, *c7 = c6 + rows;
  const double p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3];
  const double p4 = p[4], p5 = p[5], p6 = p[6], p7 = p[7];
  const double b0 = b[0], b1 = b[1], b2 = b[2], b3 = b[3];
  const double b4 = b[4], b5 = b[5], b6 = b[6], b7 = b[7];
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0;
#pragma omp simd reduction(+ : s0, s1, s2, s3, s4, s5, s6, s7)
  for (Index r = from; r < rows; ++r) {
    const double y = local[r];
    double v = w[r];
    const double l7 = c7[r], l6 = c6[r], l5 = c5[r], l4 = c4[r];
    s7 += l7 * y, c7[r] = l7 + b7 * v, v += p7 * l7;
    s6 += l6 * y, c6[r] = l6 + b6 * v, v += p6 * l6;
    s5 += l5 * y, c5[r] = l5 + b5 * v, v += p5 * l5;
    s4 += l4 * y, c4[r] = l4 + b4 * v, v += p4 * l4;
    const double l3 = c3[r], l2 = c2[r], l1 = c1[r], l0 = c0[r];
    s3 += l3 * y, c3[r] = l3 + b3 * v, v += p3 * l3;
    s2 += l2 * y, c2[r] = l2 + b2 * v, v += p2 * l2;
    s1 += l1 * y, c1[r] = l1 + b1 * v, v += p1 * l1;
    s0 += l0 * y, c0[r] = l0 + b0 * v, v += p0 * l0;
    w[r] = v;
  }
  sums[0] = s0, sums[1] = s1, sums[2] = s2, sums[3] = s3;
  sums[4] = s4, sums[5] = s5, sums[6] = s6, sums[7] = s7;
}

/// Columns that several vectors change at once, so that each vector is read once for all of them.
constexpr Index change_width = 4;

/// Coefficients of a panel's column for each vector.
struct ChangeFactors {
  double p[most_together], beta[most_together];
};

/// For each vector and one column after another: w -= p l; l += beta w. Rows from `from`.
void change_panel(double* c, Index rows, Index from, const ChangeFactors* factors, Index count,
                  double* w) {
  constexpr Index in_register = lanes_of<double>(8);
  using Row = LanesInMemory<double, in_register>;
  double *c0 = c, *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
  const auto at = [](double* numbers) -> Row& { return *reinterpret_cast<Row*>(numbers); };
  Index r = from;
  for (; r + in_register <= rows; r += in_register) {
    Row l0 = at(c0 + r), l1 = at(c1 + r), l2 = at(c2 + r), l3 = at(c3 + r);
    double* place = w + r;
    for (Index m = 0; m < count; ++m, place += rows) {
      Row v = at(place);
      v -= factors[0].p[m] * l0, l0 += factors[0].beta[m] * v;
      v -= factors[1].p[m] * l1, l1 += factors[1].beta[m] * v;
      v -= factors[2].p[m] * l2, l2 += factors[2].beta[m] * v;
      v -= factors[3].p[m] * l3, l3 += factors[3].beta[m] * v;
      at(place) = v;
    }
    at(c0 + r) = l0, at(c1 + r) = l1, at(c2 + r) = l2, at(c3 + r) = l3;
  }
  for (; r < rows; ++r) {
    for (Index m = 0; m < count; ++m) {
      double& v = w[static_cast<std::size_t>(m) * rows + r];
      for (Index k = 0; k < change_width; ++k) {
        double& l = c[static_cast<std::size_t>(k) * rows + r];
        v -= factors[k].p[m] * l;
        l += factors[k].beta[m] * v;
      }
    }
  }
}

/// Changes column j by one vector, in rows up to `end`. \return false if d does not stay positive
bool change_column(double* l, Index j, Index end, double* w, double& sigma, double& p,
                   double& beta) {
  p = w[j];
  const double changed = l[j] + sigma * p * p;
  if (!(changed > 0.0)) return false;
  beta = sigma * p / changed;
  sigma *= l[j] / changed;
  l[j] = changed;
#pragma omp simd
  for (Index r = j + 1; r < end; ++r) {
    w[r] -= p * l[r];
    l[r] += beta * w[r];
  }
  return true;
}

}  // namespace

bool change_together(double* block, Index rows, Index columns, Index count, double* w,
                     double* sigma) {
  ChangeFactors factors[change_width];
  for (Index begin = 0; begin < columns; begin += change_width) {
    const bool whole = begin + change_width <= columns;
    const Index end = whole ? begin + change_width : columns;
    for (Index j = begin; j < end; ++j) {
      ChangeFactors& column_factors = factors[j - begin];
      for (Index m = 0; m < count; ++m) {
        if (!change_column(column(block, rows, j), j, whole ? end : rows,
                           w + static_cast<std::size_t>(m) * rows, sigma[m], column_factors.p[m],
                           column_factors.beta[m])) {
          return false;
        }
      }
    }
    if (whole) change_panel(column(block, rows, begin), rows, end, factors, count, w);
  }
  return true;
}

template <class Number>
void forward(const Number* block, Index rows, Index columns, Index start, double* local) {
  Index j = start;
  while (j < columns) {
    const Index count = columns - j < width ? columns - j : width;
    for (Index k = j; k < j + count; ++k) {
      const Number* l = column(block, rows, k);
      for (Index r = k + 1; r < j + count; ++r) local[r] -= local[k] * l[r];
    }
    if (count == width) {
      eliminate_panel(column(block, rows, j), rows, j + width, local + j, local);
    } else {
      for (Index k = j; k < j + count; ++k) {
        const Number* l = column(block, rows, k);
        const double p = local[k];
#pragma omp simd
        for (Index r = j + count; r < rows; ++r) local[r] -= p * l[r];
      }
    }
    j += count;
  }
}

template <class Number>
void backward(const Number* block, Index rows, Index columns, double* local) {
  Index end = columns;
  while (end > 0) {
    const Index count = end < width ? end : width;
    const Index j = end - count;
    double sums[width];
    if (count == width) {
      dot_panel(column(block, rows, j), rows, end, local, sums);
    } else {
      for (Index k = 0; k < count; ++k) {
        const Number* l = column(block, rows, j + k);
        double sum = 0.0;
#pragma omp simd reduction(+ : sum)
        for (Index r = end; r < rows; ++r) sum += l[r] * local[r];
        sums[k] = sum;
      }
    }
    for (Index k = end - 1; k >= j; --k) {
      const Number* l = column(block, rows, k);
      double y = local[k] - sums[k - j];
      for (Index r = k + 1; r < end; ++r) y -= l[r] * local[r];
      local[k] = y;
    }
    end = j;
  }
}

template void forward(const double*, Index, Index, Index, double*);
template void forward(const float*, Index, Index, Index, double*);
template void backward(const double*, Index, Index, double*);
template void backward(const float*, Index, Index, double*);

void backward_and_change(double* block, Index rows, Index columns, const double* p,
                         const double* beta, double* local, double* w) {
  Index end = columns;
  while (end > 0) {
    const Index count = end < width ? end : width;
    const Index j = end - count;
    double sums[width];
    if (count == width) {
      dot_and_change_panel(column(block, rows, j), rows, end, p + j, beta + j, local, w, sums);
    } else {
      for (Index k = end - 1; k >= j; --k) {
        double* l = column(block, rows, k);
        double sum = 0.0;
#pragma omp simd reduction(+ : sum)
        for (Index r = end; r < rows; ++r) {
          const double old = l[r];
          sum += old * local[r];
          l[r] = old + beta[k] * w[r];
          w[r] += p[k] * old;
        }
        sums[k - j] = sum;
      }
    }
    for (Index k = end - 1; k >= j; --k) {
      double* l = column(block, rows, k);
      double y = local[k] - sums[k - j];
      for (Index r = k + 1; r < end; ++r) {
        const double old = l[r];
        y -= old * local[r];
        l[r] = old + beta[k] * w[r];
        w[r] += p[k] * old;
      }
      local[k] = y;
    }
    end = j;
  }
}

}  // namespace perilink::supernodal
