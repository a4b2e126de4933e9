#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/study/study_run.hpp"

/// \file
/// The results of a study as tables. Members come as compare_members leaves them.

namespace perilink {

/// For people: one block per series with values, errors, orders and seconds, then what errors are
/// measured against, what failed and why.
std::string study_report(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members);

/// table.csv: sizes, values, references, errors and orders; nothing that depends on the clock.
std::string study_table(const StudyFile& study, std::span<const StudySeries> series,
                        std::span<const StudyMember> members);

/// timing.csv: the seconds of the same rows.
std::string study_timing(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members);

/// Value of the refinement, "0.05" or "plate_2.msh".
std::string refinement_text(const TomlValue& refinement);

}  // namespace perilink
