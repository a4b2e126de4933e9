#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "app/model/loaded_places.hpp"
#include "assembly/linear_elements.hpp"
#include "discretization/facets.hpp"
#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"
#include "material/elasticity.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "network/rigid_modes.hpp"
#include "network/states/particle_network.hpp"

namespace perilink {

/// A displacement or stress of the history: weights times values at particles.
struct Gauge {
  struct Term {
    Index particle = no_index;
    double weight = 0.0;
  };
  std::string name;
  std::string place;  ///< "at (50, 20)", of the particles' positions in space
  std::vector<Term> terms;
  Vector3 direction{};                       ///< direction of the displacement that is measured
  std::optional<std::array<int, 2>> stress;  ///< axes of the component instead of a displacement
};

/// A case turned into particles, bonds, unknowns and loads. With method = "linear_elements" its
/// network holds the particles, and the edges of the cells as bonds: used only for connectivity,
/// their stiffness means nothing.
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
  std::vector<LoadRegion> load_regions;           ///< by forces, where nothing is driven
  std::vector<PrescribedRegion> prescribed_regions;
  std::vector<Gauge> gauges;
  /// Whether, per particle, a displacement of it is prescribed by a support or driven (planes of
  /// symmetry grip nothing: a crack may run into them).
  std::vector<std::uint8_t> gripped;
  std::vector<HookeConstants> hooke;  ///< elastic constants per material
  LoadResultant resultant;
  std::vector<std::size_t> entry_of_bar;  ///< in [[rebar]], by Bars::bar
  std::vector<std::string> notes;  ///< what the user should know: pinned modes, unbalanced moments
};

}  // namespace perilink
