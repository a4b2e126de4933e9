#include "network/builder/graded_stiffness.hpp"

#include <cstddef>
#include <numeric>
#include <vector>

namespace perilink {

void scale_stiffness(const NetworkInput& input, Network& network) {
  const std::vector<double> factors =
      modulus_between(input.fields, network.particles.positions, network.dim(), network.bonds.first,
                      network.bonds.second);
  for (std::size_t b = 0; b < factors.size(); ++b) {
    network.stiffness[b] *= factors[b];
    if (network.carries_moments()) network.bending[b] *= factors[b];
  }
}

void scale_stiffness(std::span<const PropertyField> fields, std::span<const double> positions,
                     LinearElements& elements) {
  if (fields.empty()) return;
  const int dim = elements.dim();
  std::vector<double> centroids;
  std::vector<Index> numbers(static_cast<std::size_t>(elements.cells.size()));
  std::iota(numbers.begin(), numbers.end(), 0);
  for (const Index cell : numbers) {
    for (int a = 0; a < dim; ++a) {
      double sum = 0.0;
      for (const Index i : elements.cells.cell(cell)) {
        sum += positions[static_cast<std::size_t>(i) * dim + a];
      }
      centroids.push_back(sum / (dim + 1.0));
    }
  }
  const std::vector<double> factors = modulus_between(fields, centroids, dim, numbers, numbers);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    elements.lambda[k] *= factors[k];
    elements.mu[k] *= factors[k];
  }
}

}  // namespace perilink
