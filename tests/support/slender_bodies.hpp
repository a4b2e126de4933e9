#pragma once

#include <string>

#include "discretization/lattices/make_body.hpp"
#include "support/analysis_bodies.hpp"

/// \file
/// Bars so slender that strains have few digits in double precision.

namespace perilink::test {

enum class SlenderLoad { force_across, driven_across, force_along, driven_along };

/// Rectangular lattice of spacing 1 and horizon 3.1, fixed at its first four columns, with loads or
/// displacements at its last two.
struct SlenderCase {
  int columns = 600;
  int rows = 3;
  SlenderLoad load = SlenderLoad::driven_across;
  bool micropolar = false;
  double stiffness_unit = 1.0;  ///< Young's modulus over 3000
  double length_unit = 1.0;     ///< spacing
  double weak_springs = 0.0;    ///< total stiffness of elastic supports of all particles

  bool driven() const {
    return load == SlenderLoad::driven_across || load == SlenderLoad::driven_along;
  }
  int axis() const {
    return load == SlenderLoad::force_across || load == SlenderLoad::driven_across ? 1 : 0;
  }
  /// Returns the distance between the fixed and the displaced columns.
  double lever() const { return (columns - 5) * length_unit; }
};

inline std::ostream& operator<<(std::ostream& out, const SlenderCase& bar) {
  const char* loads[] = {"force_across", "driven_across", "force_along", "driven_along"};
  return out << bar.columns << "_by_" << bar.rows << "_" << loads[static_cast<int>(bar.load)]
             << (bar.micropolar ? "_micropolar" : "") << (bar.weak_springs > 0.0 ? "_springs" : "");
}

inline AnalysisBody make_slender(const SlenderCase& bar) {
  const double unit = bar.length_unit;
  LatticeInput input;
  input.spacing = unit;
  input.horizon = 3.1 * unit;
  input.thickness = unit;
  input.solid = {{{0.0, 0.0, 0.0}, {(bar.columns - 1) * unit, (bar.rows - 1) * unit, 0.0}}};
  input.material = {0};
  NetworkInput constants = network_input(input);
  const double modulus = 3000.0 * bar.stiffness_unit;
  constants.materials = {{modulus, 1e-6 * modulus * unit}};
  if (bar.micropolar) {
    constants.model = BondModel::micropolar;
    constants.materials[0].poissons_ratio = 0.2;
  }
  AnalysisBody body = free_body(build_network(make_body(input), constants));
  Network& network = body.network;
  if (bar.weak_springs > 0.0) {
    network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
    for (Index i = 0; i < network.particles.size(); ++i) {
      for (int a = 0; a < 2; ++a) {
        network.support_stiffness[slot(body, i, a)] =
            bar.weak_springs / static_cast<double>(network.particles.size());
      }
    }
  }
  const auto column = [&](Index i) { return network.particles.position(i)[0] / unit; };
  const auto loaded = [&](Index i) { return column(i) > bar.columns - 2.5; };
  double total = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (!loaded(i)) continue;
    (bar.driven() ? body.unknowns.prescribed : body.loads.forces)[slot(body, i, bar.axis())] = unit;
    total += unit;
  }
  body.reference = {bar.driven(), bar.driven() ? unit : total};
  number(body, [&](Index i, int axis) {
    return column(i) < 3.5 || (bar.driven() && axis == bar.axis() && loaded(i));
  });
  return body;
}

}  // namespace perilink::test
