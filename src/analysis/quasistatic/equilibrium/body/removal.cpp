#include "analysis/quasistatic/equilibrium/body/removal.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense/decompositions.hpp"

namespace perilink {

double Removal::deformation(int mode, std::span<const double> solution) const {
  double sum = prescribed[mode];
  for (int k = 0; k < x[mode].size(); ++k) sum += x[mode].values[k] * solution[x[mode].rows[k]];
  return sum;
}

namespace {

Removal removal_of(const ElementVectors& parts, double fraction) {
  Removal removal;
  removal.rank = parts.count;
  removal.fraction = fraction;
  removal.x = parts.x;
  removal.prescribed = parts.prescribed;
  return removal;
}

}  // namespace

Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction) {
  return removal_of(element_vectors(network, unknowns, element, fraction), fraction);
}

Removal make_removal(const Network& network, const Unknowns& unknowns, Index element,
                     double fraction, double axial) {
  Removal removal = make_removal(network, unknowns, element, fraction);
  if (removal.rank == 1) return make_axial_removal(network, unknowns, element, axial);
  const double root = std::sqrt(axial / fraction);
  for (double& value : removal.x[0].values) value *= root;
  removal.prescribed[0] *= root;
  return removal;
}

Removal make_axial_removal(const Network& network, const Unknowns& unknowns, Index element,
                           double fraction) {
  return removal_of(axial_vector(network, unknowns, element, fraction), fraction);
}

void ForceOfElements::add(const SparseVector& x, double by_growing, double by_constant) {
  for (int k = 0; k < x.size(); ++k) {
    Index& place = place_[x.rows[k]];
    if (place == no_index) {
      place = growing.size();
      for (SparseVector* sum : {&growing, &constant}) {
        sum->rows.push_back(x.rows[k]);
        sum->values.push_back(0.0);
      }
    }
    growing.values[place] += by_growing * x.values[k];
    constant.values[place] += by_constant * x.values[k];
  }
}

void VariedForces::add(const SparseVector& x) {
  for (int k = 0; k < x.size(); ++k) load[x.rows[k]] += size * x.values[k];
  size = size < 1.0 ? size + 0.381966 : size - 0.618034;  // sizes do not repeat
  ++count;
}

void decouple(Removal& removal, std::span<const double> compliance) {
  const int rank = removal.rank;
  const auto [values, axes] =
      eigenvectors(Eigen::MatrixXd::Identity(rank, rank) -
                   Eigen::Map<const Eigen::MatrixXd>(compliance.data(), rank, rank).transpose());

  // The new vectors have the rows of all old ones.
  SparseVector rows;
  for (int m = 0; m < rank; ++m) {
    for (const Index row : removal.x[m].rows) rows.add(row, 0.0);
  }
  const Removal old = removal;
  for (int m = 0; m < rank; ++m) {
    removal.pivot[m] = values[m];
    removal.prescribed[m] = removal.constant[m] = 0.0;
    removal.x[m] = rows;
    for (int n = 0; n < rank; ++n) {
      const double share = axes(n, m);
      removal.prescribed[m] += share * old.prescribed[n];
      removal.constant[m] += share * old.constant[n];
      const SparseVector& x = old.x[n];
      for (int k = 0; k < x.size(); ++k) removal.x[m].add(x.rows[k], share * x.values[k]);
    }
  }
}

}  // namespace perilink
