#include "material/critical_stretch.hpp"

#include <cmath>
#include <numbers>

namespace perilink {

double continuum_critical_stretch(Problem problem, double fracture_energy, double micromodulus,
                                  double horizon, double thickness) {
  const double square = horizon * horizon;
  if (problem == Problem::three_dimensional) {
    return std::sqrt(10.0 * fracture_energy /
                     (std::numbers::pi * micromodulus * square * square * horizon));
  }
  return 2.0 / square * std::sqrt(fracture_energy / (micromodulus * thickness));
}

double mean_cosine(Problem problem) {
  return problem == Problem::three_dimensional ? 0.5 : 2.0 * std::numbers::inv_pi;
}

double fracture_sum_of_neighbourhood(Problem problem, std::span<const Vector3> offsets,
                                     std::span<const double> stiffness, double cell_volume) {
  double sum = 0.0;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const double length = std::hypot(offsets[k][0], offsets[k][1], offsets[k][2]);
    sum += stiffness[k] * length * length * length;
  }
  // The offsets list every unordered pair twice.
  return 0.5 * mean_cosine(problem) * sum / cell_volume;
}

double lattice_fracture_sum(Problem problem, std::span<const Vector3> offsets, double cell_volume,
                            double micromodulus, std::optional<Vector3> normal) {
  double sum = 0.0;
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    const double across =
        normal ? std::abs(xi[0] * (*normal)[0] + xi[1] * (*normal)[1] + xi[2] * (*normal)[2])
               : mean_cosine(problem) * length;
    sum += length * across;
  }
  // The offsets list every unordered pair twice.
  return 0.5 * micromodulus * cell_volume * sum;
}

double lattice_critical_stretch(double fracture_energy, double fracture_sum) {
  return std::sqrt(2.0 * fracture_energy / fracture_sum);
}

}  // namespace perilink
