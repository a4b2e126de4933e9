#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/results/stress.hpp"
#include "base/csr.hpp"
#include "model/model.hpp"
#include "model/model_state.hpp"

namespace perilink {

/// Builds the gauges of a case: at a particle, interpolated between particles around a point, or
/// averaged over a region. Weights of a region are in proportion to volumes.
/// \param notes  receives a note for each point without a particle
/// \throws InputError  for points outside the body, two points with one particle, empty regions and
///                     names of columns of every history
std::vector<Gauge> build_gauges(const CaseFile& input, const Model& model,
                                std::vector<std::string>& notes);

/// Returns the value of a displacement gauge [length].
/// \param displacement  takes a particle and an axis [length]
template <class Displacement>
double gauge_value(const Gauge& gauge, int dim, Displacement displacement) {
  double value = 0.0;
  for (const Gauge::Term& term : gauge.terms) {
    for (int a = 0; a < dim; ++a) {
      value += term.weight * gauge.direction[a] * displacement(term.particle, a);
    }
  }
  return value;
}

/// Whether a gauge needs the reactions on the body.
bool measures_reactions(std::span<const Gauge> gauges);

/// Returns the values of all gauges [length], [length^2], [force/length^2], [force] or [force
/// length].
/// \param neighbourhoods  bonds of each particle; filled once a gauge needs them
/// \param holding         holding_forces() where they are known, as for bodies in motion
std::vector<double> gauge_values(const Model& model, const ModelState& state, Csr& neighbourhoods,
                                 std::vector<double> holding = {});

/// Returns the force or moment that a gauge measures.
/// \param holding  holding_forces()
double gauge_force(const Model& model, const Gauge& gauge, const ModelState& state,
                   std::span<const double> holding);

/// Returns how a row has met a rule by a gauge, "the gauge \"opening\" is 0.51, above 0.5"; empty
/// if it has not.
/// \param values  of all gauges of the case in this row
std::optional<std::string> met_rule(const CaseFile& input, const StopSection& stop,
                                    std::span<const double> values);

/// Returns the input for stresses at the particles of a model.
/// \param neighbourhoods  bonds of each particle; must outlive the result
StressInput stress_input(const Model& model, const Csr& neighbourhoods, Secants secants = {});

}  // namespace perilink
