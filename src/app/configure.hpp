#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/damage_analysis.hpp"
#include "app/loaded_places.hpp"
#include "assembly/linear_elements.hpp"
#include "assembly/network.hpp"
#include "assembly/particle_network.hpp"
#include "assembly/rigid_modes.hpp"
#include "assembly/unknowns.hpp"
#include "discretization/calibration.hpp"
#include "discretization/lattice.hpp"
#include "io/case_file.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// A displacement or stress of the history: weights times values at particles.
struct Gauge {
  struct Term {
    Index particle = no_index;
    double weight = 0.0;
  };
  std::string name;
  std::vector<Term> terms;
  Vector3 direction{};                       ///< of the displacement that is measured
  std::optional<std::array<int, 2>> stress;  ///< axes of the component instead of a displacement
};

/// A case turned into particles, bonds, unknowns and loads.
struct Model {
  Problem problem = Problem::plane_stress;
  Lattice lattice;
  Facets facets;              ///< of the body; corners are particles of the network
  Simplices cells;            ///< of a mesh
  std::vector<Group> groups;  ///< of a mesh
  double horizon = 0.0;       ///< [length]
  /// crack_cost() of each material, where critical_stretch = "dissipated" [-].
  std::vector<double> crack_cost;
  /// Where elements are linear: their particles, and as bonds the edges of the cells, which stand
  /// for them in all questions of what holds what; their stiffness means nothing.
  Network network;
  std::optional<LinearElements> elements;         ///< with method = "linear_elements"
  std::optional<ParticleFitReport> particle_fit;  ///< with model = "particles"
  Unknowns unknowns;
  Loads loads;
  ReferenceLoad reference;
  std::vector<LoadedPlace> loaded_places;  ///< by forces, where nothing is driven
  std::vector<DrivenPlace> driven_places;
  std::vector<Gauge> gauges;
  /// Whether, per particle, a displacement of it is prescribed by a support or driven (planes of
  /// symmetry grip nothing: a crack may run into them).
  std::vector<std::uint8_t> gripped;
  std::vector<HookeConstants> hooke;  ///< elastic constants per material
  LoadResultant resultant;
  std::vector<std::string> notes;  ///< what the user should know: pinned modes, unbalanced moments
};

Problem problem_of(const CaseFile& input);

/// Builds the model of a case.
/// \param on_search  told how the calibration of the bonds comes along; may be empty
/// \throws InputError where the case makes no sense for its body: empty regions, particles that
/// nothing holds, free rigid-body modes, contradictory supports
Model build_model(const CaseFile& input, const CalibrationObserver& on_search = {});

/// The same with bonds as they are before calibration, in a small part of its time: sizes, notes,
/// supports, loads and gauges are those of the model, refusals too.
Model draft_model(const CaseFile& input);

/// Options of the damage analysis that a case asks for.
DamageOptions damage_options(const CaseFile& input, int threads);

}  // namespace perilink
