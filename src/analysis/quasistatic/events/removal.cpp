#include "analysis/quasistatic/events/removal.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace perilink {
namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                             Removal::capacity, Removal::capacity>;

}  // namespace

double Removal::deformation(int mode, std::span<const double> solution) const {
  double sum = prescribed[mode];
  for (int k = 0; k < x[mode].size; ++k) sum += x[mode].values[k] * solution[x[mode].rows[k]];
  return sum;
}

Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction) {
  const ElementVectors parts = element_vectors(network, unknowns, element, fraction);
  Removal removal;
  removal.rank = parts.count;
  removal.x = parts.x;
  removal.prescribed = parts.prescribed;
  return removal;
}

void decouple(Removal& removal, std::span<const double> compliance) {
  const int rank = removal.rank;
  Square rest = Square::Identity(rank, rank);
  rest -= Eigen::Map<const Square>(compliance.data(), rank, rank);
  const Eigen::SelfAdjointEigenSolver<Square> axes(rest);  // eigenvalues ascend

  // All new vectors live on the rows of all old ones.
  SparseVector rows;
  Eigen::Matrix<double, SparseVector::capacity, Removal::capacity> old;
  old.setZero();
  for (int m = 0; m < rank; ++m) {
    for (int k = 0; k < removal.x[m].size; ++k) {
      const Index row = removal.x[m].rows[k];
      const auto end = rows.rows.begin() + rows.size;
      const auto place =
          static_cast<int>(std::find(rows.rows.begin(), end, row) - rows.rows.begin());
      if (place == rows.size) rows.rows[rows.size++] = row;
      old(place, m) = removal.x[m].values[k];
    }
  }
  const auto prescribed = removal.prescribed;
  for (int m = 0; m < rank; ++m) {
    removal.pivot[m] = axes.eigenvalues()[m];
    removal.prescribed[m] = 0.0;
    removal.x[m] = rows;
    std::fill_n(removal.x[m].values.begin(), rows.size, 0.0);
    for (int n = 0; n < rank; ++n) {
      const double share = axes.eigenvectors()(n, m);
      removal.prescribed[m] += share * prescribed[n];
      for (int k = 0; k < rows.size; ++k) removal.x[m].values[k] += share * old(k, n);
    }
  }
}

}  // namespace perilink
