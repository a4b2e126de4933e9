#pragma once

#include <span>

#include "app/plot/plot_convergence.hpp"
#include "app/study/study_run.hpp"

namespace perilink {

/// Quantity on the horizontal axis of a study plot.
enum class Cost { unknowns, seconds };

/// Returns the plot of one error of a study, one line per series. Members must be in the order of
/// compare_members().
/// \param error  index of the error in the study
ConvergencePlot study_picture(const StudyFile& study, std::span<const StudySeries> series,
                              std::span<const StudyMember> members, std::size_t error, Cost cost);

}  // namespace perilink
