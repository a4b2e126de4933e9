#pragma once

#include <span>

#include "app/plot/plot_convergence.hpp"
#include "app/study/study_run.hpp"

namespace perilink {

/// What stands on the lower axis of a picture of a study.
enum class Cost { unknowns, seconds };

/// The picture of one error of a study, one line per series. Members come as compare_members leaves
/// them.
/// \param error  its number in the study
ConvergencePlot study_picture(const StudyFile& study, std::span<const StudySeries> series,
                              std::span<const StudyMember> members, std::size_t error, Cost cost);

}  // namespace perilink
