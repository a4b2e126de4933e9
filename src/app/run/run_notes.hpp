#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/model/from_case/configure.hpp"

namespace perilink {

/// Where bonds broke at particles that supports or driven displacements hold: nothing of the body
/// may be wrong with that, but often the grips are.
/// \param broken  elements that broke
std::optional<std::string> note_of_clamps(const Model& model, std::span<const Index> broken);

/// Where the load climbed above its first peak after the body had failed: which peak is which. A
/// doubt, with bars a note.
/// \param bars  reinforce the body: the larger load is its peak
std::optional<std::string> text_of_peaks(const PeakWatch& peaks, bool bars);

/// The peaks of a damage run, and how many of the bonds that broke after the first one end at
/// grips.
/// \param broken  elements in the order in which they broke
std::optional<std::string> text_of_peaks(const DamageResult& result, const Model& model,
                                         std::span<const Index> broken);

}  // namespace perilink
