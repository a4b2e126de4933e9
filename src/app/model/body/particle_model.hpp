#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "app/model/model.hpp"

namespace perilink {

/// State-based particles of the body, their neighbours and constants, with a note on how well these
/// fit. Without a mesh the vertices of the linear triangles or tetrahedra of the lattice count.
void build_particles(const CaseFile& input, Body& body, Model& model);

/// What the particles of an explicit run are made of.
StateBody state_body_of(const CaseFile& input);

/// \throws InputError where particles are too far apart for the softening (check_bands)
void refuse_wide_bands(const CaseFile& input, const Particles& particles, const StateBody& body);

/// How the constants were found, for people and for summary.json.
std::string fit_text(const ParticleFitReport& report, const Particles& particles);
nlohmann::ordered_json fit_json(const ParticleFitReport& report);

}  // namespace perilink
