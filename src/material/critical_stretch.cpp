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

double lattice_fracture_sum(Problem problem, std::span<const Vector3> offsets, double cell_volume,
                            double micromodulus, std::optional<Vector3> normal) {
  const double mean_cosine =
      problem == Problem::three_dimensional ? 0.5 : 2.0 * std::numbers::inv_pi;
  double sum = 0.0;
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    const double across =
        normal ? std::abs(xi[0] * (*normal)[0] + xi[1] * (*normal)[1] + xi[2] * (*normal)[2])
               : mean_cosine * length;
    sum += length * across;
  }
  // The offsets list every unordered pair twice.
  return 0.5 * micromodulus * cell_volume * sum;
}

double lattice_critical_stretch(double fracture_energy, double fracture_sum) {
  return std::sqrt(2.0 * fracture_energy / fracture_sum);
}

}  // namespace perilink
