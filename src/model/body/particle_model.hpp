#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "model/model.hpp"

namespace perilink {

/// Builds state-based particles, their neighbours and constants, with a note on the fit of the
/// constants. Without a mesh the particles are the vertices of the linear triangles or tetrahedra
/// of the lattice.
void build_particles(const CaseFile& input, Body& body, Model& model);

/// Returns the state-based material of an explicit run.
StateBody state_body_of(const CaseFile& input);

/// \throws InputError where particles are too far apart for the softening (check_bands)
void refuse_wide_bands(const CaseFile& input, const Particles& particles, const StateBody& body);

/// Describes the fit of the constants as text and for summary.json.
std::string fit_text(const ParticleFitReport& report, const Particles& particles);
nlohmann::ordered_json fit_json(const ParticleFitReport& report);

}  // namespace perilink
