#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/quasistatic/load_curve.hpp"
#include "model/from_case/configure.hpp"

namespace perilink {

/// Returns a note on bonds that broke at particles with supports or prescribed displacements. Such
/// breaks may be physical, but often the clamps cause them.
/// \param broken  broken elements
std::optional<std::string> note_of_clamps(const Model& model, std::span<const Index> broken);

/// Returns a note where contact springs keep a large body in space from conjugate gradients.
std::optional<std::string> text_of_contacts(const Model& model, const EquilibriumOptions& options);

/// Returns a text on the peaks where the load rose above its first peak after the body had failed.
/// It is a warning; with bars a note.
/// \param bars  whether bars reinforce the body, so that the larger load is its peak
std::optional<std::string> text_of_peaks(const PeakWatch& peaks, bool bars);

/// Returns this text for a damage run, with the number of bonds that broke at clamps after the
/// first peak.
/// \param broken  elements in the order in which they broke
std::optional<std::string> text_of_peaks(const DamageResult& result, const Model& model,
                                         std::span<const Index> broken);

}  // namespace perilink
