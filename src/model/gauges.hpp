#pragma once

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

/// Returns the values of all gauges [length] or [force/length^2].
/// \param neighbourhoods  bonds of each particle; filled once a gauge needs them
std::vector<double> gauge_values(const Model& model, const ModelState& state, Csr& neighbourhoods);

/// Returns the input for stresses at the particles of a model.
/// \param neighbourhoods  bonds of each particle; must outlive the result
StressInput stress_input(const Model& model, const Csr& neighbourhoods, Secants secants = {});

}  // namespace perilink
