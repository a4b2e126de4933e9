#include "comparison.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "base/timer.hpp"

namespace perilink::verification {
namespace {}  // namespace

Solution solve(const Specimen& specimen) {
  const Model& model = specimen.model;
  const Timer timer;
  ElasticResult result = model.elements
                             ? run_elastic_analysis(*model.elements, model.unknowns, model.loads, 1)
                             : run_elastic_analysis(model);
  Solution solution;
  solution.seconds = timer.seconds();
  solution.deflection = deflection(specimen, result.displacement);
  solution.displacement = std::move(result.displacement);
  return solution;
}

Solution relax(const Specimen& specimen, Strain strain, double tolerance, int threads) {
  const Model& model = specimen.model;
  RelaxationOptions options;
  options.tolerance = tolerance;
  options.strain = strain;
  options.threads = threads;
  BondRunObserver observer;
  const Timer timer;
  RelaxationResult result = run_dynamic_relaxation(model, options, observer);
  Solution solution;
  solution.seconds = timer.seconds();
  solution.deflection = deflection(specimen, result.displacement);
  solution.iterations = result.iterations;
  solution.termination = result.termination;
  solution.displacement = std::move(result.displacement);
  return solution;
}

double largest_difference(const Solution& a, const Solution& b) {
  double difference = 0.0, largest = 0.0;
  for (std::size_t slot = 0; slot < b.displacement.size(); ++slot) {
    difference = std::max(difference, std::abs(a.displacement[slot] - b.displacement[slot]));
    largest = std::max(largest, std::abs(b.displacement[slot]));
  }
  return difference / largest;
}

double normalized_shape_error(const Specimen& specimen, const Solution& solution) {
  const Shape found = shape(specimen, solution.displacement);
  std::vector<double> expected;
  for (const double x : found.x) {
    expected.push_back(bernoulli(specimen.structure, specimen.sizes, x));
  }
  const double largest = *std::max_element(found.deflection.begin(), found.deflection.end());
  const double largest_expected = *std::max_element(expected.begin(), expected.end());
  double error = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    error =
        std::max(error, std::abs(found.deflection[k] / largest - expected[k] / largest_expected));
  }
  return error;
}

double plate_reference() {
  const Sizes coarse = sizes_of(Structure::plate);
  const Sizes fine{coarse.length * 3 / 2, coarse.height * 3 / 2, coarse.depth * 3 / 2,
                   coarse.cell * 2.0 / 3.0};
  const double w = solve(make_specimen(Structure::plate, coarse, "linear elements")).deflection;
  const double w_fine = solve(make_specimen(Structure::plate, fine, "linear elements")).deflection;
  return w_fine + (w_fine - w) / (1.5 * 1.5 - 1.0);
}

}  // namespace perilink::verification
