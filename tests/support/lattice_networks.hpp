#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "discretization/bonds.hpp"
#include "support/lattice_models.hpp"

/// \file
/// Lattice bodies of all kinds as networks.

namespace perilink::testing_support {

struct StateLatticeCase {
  Problem problem = Problem::plane_stress;
  double degrees = 0.0;
  double poissons_ratio = 0.2;
};

inline std::ostream& operator<<(std::ostream& out, const StateLatticeCase& lattice) {
  const char* problem = lattice.problem == Problem::plane_stress   ? "plane_stress"
                        : lattice.problem == Problem::plane_strain ? "plane_strain"
                                                                   : "space";
  return out << problem << "_" << std::lround(lattice.degrees) << "_degrees_ratio_"
             << std::lround(100.0 * lattice.poissons_ratio) << "_percent";
}

inline std::vector<StateLatticeCase> state_lattice_cases() {
  std::vector<StateLatticeCase> cases;
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    for (const double degrees : {0.0, 15.0, 30.0}) cases.push_back({problem, degrees, 0.2});
    cases.push_back({problem, 15.0, 0.45});  // the state-based term increases the stiffness
  }
  return cases;
}

/// Returns a block of `half` spacings on either side of the origin.
inline ExplicitModel state_block(const StateLatticeCase& lattice, double half) {
  const double spacing = 0.01;
  LatticeCut cut = rectangle(half * spacing, half * spacing, spacing, lattice.degrees,
                             lattice.problem == Problem::three_dimensional ? 1.0 : 0.15);
  const LatticeMaterial material = elastic_concrete(lattice.poissons_ratio);
  if (lattice.problem != Problem::three_dimensional) {
    return plane_model(cut, material, LatticeRules::consistent, lattice.problem);
  }
  cut.lower[2] = -half * spacing;
  cut.upper[2] = half * spacing;
  return make_explicit_model(lattice.problem, LatticeRules::consistent, face_centred_rows(cut),
                             material, 1.0);
}

/// Returns the number of bonds from each particle to the nearest one with missing bonds, at most
/// three.
inline std::vector<int> depths(const Network& network) {
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  const std::size_t full = network.dim() == 2 ? 6 : 18;
  std::vector<int> depth;
  for (Index i = 0; i < neighbourhoods.rows(); ++i) {
    depth.push_back(neighbourhoods.row(i).size() == full ? 3 : 0);
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      const Index i = network.bonds.first[e], j = network.bonds.second[e];
      depth[i] = std::min(depth[i], depth[j] + 1);
      depth[j] = std::min(depth[j], depth[i] + 1);
    }
  }
  return depth;
}

inline std::vector<double> random_values(std::size_t size, unsigned seed, double from, double to) {
  std::mt19937 random(seed);
  std::vector<double> values(size);
  for (double& value : values) {
    value = from + (to - from) * (static_cast<double>(random()) / std::mt19937::max());
  }
  return values;
}

}  // namespace perilink::testing_support
