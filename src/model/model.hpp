#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "assembly/linear_elements.hpp"
#include "assembly/results/surface_conditions.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/facets.hpp"
#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"
#include "material/elasticity.hpp"
#include "model/loaded_places.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "network/rigid_modes.hpp"
#include "network/states/particle_network.hpp"

namespace perilink {

/// A displacement or stress in the history, a weighted sum of particle values; a force or moment on
/// particles; or the size of cracks.
struct Gauge {
  struct Term {
    Index particle = no_index;
    double weight = 0.0;
  };
  std::string name;
  std::string place;  ///< "at (50, 20)", from particle positions in space
  std::vector<Term> terms;
  Vector3 direction{};                       ///< direction of the measured displacement
  std::optional<std::array<int, 2>> stress;  ///< axes of the stress component

  /// Measured force: of supports, or of loads.
  enum class Force { none, reaction, load };
  Force force = Force::none;     ///< along `direction`, on the particles of the terms
  std::optional<Vector3> about;  ///< measures the moment about this point, around `direction`

  struct CrackShare {
    Index bond = no_index;
    double size = 0.0;  ///< over energy_until() of its law [length] or [length^2]
  };
  std::vector<CrackShare> cracks;  ///< of crack_shares(); empty: measures no cracks
};

/// Particles, bonds, unknowns and loads of a case. With method = "linear_elements" the network
/// holds the particles and the cell edges as bonds, used for connectivity only.
struct Model : LoadedNetwork {
  Problem problem = Problem::plane_stress;
  Lattice lattice;
  Facets facets;              ///< faces of the body; corners are particles of the network
  Simplices cells;            ///< meshes only
  std::vector<Group> groups;  ///< meshes only
  double horizon = 0.0;       ///< [length]
  /// crack_cost() of each material, where critical_stretch = "dissipated" [-].
  std::vector<double> crack_cost;
  std::optional<LinearElements> elements;         ///< with method = "linear_elements"
  std::optional<ParticleFitReport> particle_fit;  ///< with model = "particles"
  std::vector<LoadRegion> load_regions;  ///< with forces, where no displacement is prescribed
  std::vector<PrescribedRegion> prescribed_regions;
  std::vector<Gauge> gauges;
  /// Per particle, whether a support or prescribed displacement acts on it. Planes of symmetry do
  /// not count, since cracks may reach them.
  std::vector<std::uint8_t> gripped;
  std::vector<HookeConstants> hooke;  ///< elastic constants per material
  std::vector<double> modulus;  ///< Young's modulus over that of the material [-], per particle;
                                ///< empty: 1
  SurfaceConditions surface_conditions;  ///< for stresses; empty: unknown
  LoadResultant resultant;
  std::vector<std::size_t> entry_of_bar;  ///< in [[rebar]], by Bars::bar
  std::vector<Crack> cracks;              ///< of [[cracks]]; surfaces of a mesh by their triangles
  std::vector<std::size_t> entry_of_crack;  ///< in [[cracks]]
  std::vector<std::string> notes;           ///< for the user: pinned modes, unbalanced moments
};

}  // namespace perilink
