#pragma once

#include <string>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/model/model.hpp"
#include "assembly/stress.hpp"
#include "base/csr.hpp"

namespace perilink {

/// Gauges of a case on the particles of its body: those nearest to points, or all of a region with
/// weights in proportion to their volumes.
/// \throws InputError  for points outside the body, two points with one particle, empty regions and
///                     names of columns that every history has
std::vector<Gauge> build_gauges(const CaseFile& input, const Model& model);

std::vector<std::string> names_of(const std::vector<Gauge>& gauges);

/// Their values in a state, at a load factor.
std::vector<double> gauge_values(const Model& model, const StepState& state, double load_factor);

/// What stresses at the particles of an elastic model are found from.
/// \param families  bonds of each particle; must outlive the result
StressInput stress_input(const Model& model, const Csr& families);

}  // namespace perilink
