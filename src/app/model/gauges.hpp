#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/model/model.hpp"
#include "app/model/model_state.hpp"
#include "assembly/results/stress.hpp"
#include "base/csr.hpp"

namespace perilink {

/// Gauges of a case on the particles of its body: those at points, or by a linear field through
/// those around a point, or all of a region with weights in proportion to their volumes.
/// \param notes  gets a sentence for each point at which no particle lies
/// \throws InputError  for points outside the body, two points with one particle, empty regions and
///                     names of columns that every history has
std::vector<Gauge> build_gauges(const CaseFile& input, const Model& model,
                                std::vector<std::string>& notes);

/// What a gauge of displacements measures.
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

/// Values of all gauges.
/// \param families  bonds of each particle; filled when a gauge needs them, for the next call
std::vector<double> gauge_values(const Model& model, const ModelState& state, Csr& neighbourhoods);

/// What stresses at the particles of a model are found from.
/// \param families  bonds of each particle; must outlive the result
StressInput stress_input(const Model& model, const Csr& neighbourhoods, Secants secants = {});

}  // namespace perilink
