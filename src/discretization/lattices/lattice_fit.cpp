#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

using Faces = std::array<std::vector<double>, 3>;

struct Misfit {
  int axis;
  double coordinate;
};

/// Returns the first face of the body that is not a plane of the lattice.
std::optional<Misfit> find_misfit(const Lattice& lattice, const Box& bounds, const Faces& faces,
                                  double tolerance) {
  for (int axis = 0; axis < lattice.dim; ++axis) {
    for (const double coordinate : faces[axis]) {
      const double steps = (coordinate - bounds.lower[axis]) / lattice.step[axis];
      if (std::abs(steps - std::round(steps)) * lattice.step[axis] > tolerance) {
        return Misfit{axis, coordinate};
      }
    }
  }
  return std::nullopt;
}

/// Returns the spacings of the next larger and next smaller numbers of columns that fit all faces.
std::vector<double> fitting_spacings(const LatticeInput& input, const Lattice& lattice,
                                     const Box& bounds, const Faces& faces, double tolerance) {
  const double extent = bounds.upper[0] - bounds.lower[0];
  const double spacing_per_step = lattice.spacing / lattice.step[0];
  const Index columns = count_steps(lattice, bounds)[0];
  const auto spacing_of = [&](Index n) { return extent / n * spacing_per_step; };
  const auto fits = [&](Index n) {
    const Lattice candidate = conforming_lattice(input, bounds, spacing_of(n));
    return !find_misfit(candidate, bounds, faces, tolerance);
  };
  std::vector<double> found;
  for (Index n = columns + 1; n <= 4 * columns + 8; ++n) {
    if (!fits(n)) continue;
    found.push_back(spacing_of(n));
    break;
  }
  for (Index n = columns - 1; n >= 1; --n) {
    if (!fits(n)) continue;
    found.push_back(spacing_of(n));
    break;
  }
  return found;
}

}  // namespace

void check_fit(const LatticeInput& input, const Lattice& lattice, const Outline& outline) {
  const double tolerance = input.boundary_tolerance * input.spacing;
  const Faces all = {faces(outline, 0), faces(outline, 1),
                     outline.dim == 3 ? faces(outline, 2) : std::vector<double>{}};
  const auto misfit = find_misfit(lattice, outline.bounds, all, tolerance);
  if (!misfit) return;

  std::ostringstream message;
  message.precision(12);
  message << "the outline of the body misses the lattice: its face at "
          << "xyz"[misfit->axis] << " = " << misfit->coordinate << " lies between planes that are "
          << lattice.step[misfit->axis] << " apart";
  const double start = outline.bounds.lower[misfit->axis];
  const double below = std::floor((misfit->coordinate - start) / lattice.step[misfit->axis]);
  message << ": move it to " << start + below * lattice.step[misfit->axis] << " or "
          << start + (below + 1.0) * lattice.step[misfit->axis];
  const auto spacings = fitting_spacings(input, lattice, outline.bounds, all, tolerance);
  if (spacings.empty()) {
    message << " (no spacing nearby fits all faces as they are)";
  } else {
    message << ", or choose the spacing " << spacings.front();
    if (spacings.size() > 1) message << " or " << spacings.back();
  }
  throw std::invalid_argument(message.str());
}

}  // namespace perilink
